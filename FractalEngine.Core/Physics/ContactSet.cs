using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>What a body touches, so that it need not be found again while it stays so.</summary>
internal sealed class ContactSet
{
    // Relative to the speed: what rounding leaves of a velocity along the normal.
    private const double Rounding = 1e-13;

    // Squared sine of the angle below which two surfaces are one.
    private const double Parallel = 1e-10;

    // Of the reach: a gap that differs by less needs no other point.
    private const double Unmoved = 1e-13;

    // Contacts whose directions differ by less are the same.
    private const double SameDirection = 1e-12;

    private readonly Contact[] _contacts = new Contact[HalfSpaces.Capacity];

    /// <summary>How many there are.</summary>
    public int Count { get; private set; }

    /// <summary>One of them.</summary>
    public Contact this[int index] => _contacts[index];

    /// <summary>Forgets all.</summary>
    public void Clear() => Count = 0;

    /// <summary>Adds a contact, in the place of one in the same direction if there is one.</summary>
    public void Add(in Contact contact, Vector position)
    {
        var normal = contact.Normal(position);
        for (var i = 0; i < Count; i++)
        {
            if (_contacts[i].Body == contact.Body && (_contacts[i].Normal(position) - normal).LengthSquared() < SameDirection)
            {
                _contacts[i] = contact with { Direction = normal };
                return;
            }
        }

        if (Count == _contacts.Length)
        {
            RemoveAt(0);
        }

        _contacts[Count++] = contact with { Direction = normal };
    }

    /// <summary>Forgets those that are not touched any more, and those with other bodies, which move.</summary>
    /// <param name="position">Of the body.</param>
    /// <param name="hold">See <see cref="Obstacles.Hold"/>.</param>
    /// <param name="radius">Of the body, which may have shrunk.</param>
    public void Refresh(Vector position, double hold, double radius)
    {
        for (var i = Count - 1; i >= 0; i--)
        {
            _contacts[i] = _contacts[i] with { Reach = radius };
            if (_contacts[i].Body >= 0 || _contacts[i].Gap(position) > hold)
            {
                RemoveAt(i);
            }
        }
    }

    /// <summary>After a move: keeps those surfaces that are still touched, perhaps at another point, and forgets the others.</summary>
    public void Follow(Vector position, double hold, Obstacles obstacles)
    {
        for (var i = Count - 1; i >= 0; i--)
        {
            if (_contacts[i].Body < 0 && _contacts[i].Gap(position) is var gap && Math.Abs(gap) > Unmoved * _contacts[i].Reach
                && obstacles.TryFollow(position, in _contacts[i], out var followed))
            {
                _contacts[i] = followed;
            }

            if (_contacts[i].Gap(position) > hold)
            {
                RemoveAt(i);
            }
        }
    }

    /// <summary>Forgets those that a velocity leads away from.</summary>
    /// <param name="position">Of the body.</param>
    /// <param name="velocity">Of the body.</param>
    /// <param name="bodies">The others.</param>
    /// <param name="slow">
    /// What leaves a surface more slowly does not leave: it would be back at once, and several edges could pass a body to and fro. It loses that speed, since
    /// gravity would have taken it.
    /// </param>
    /// <returns>The velocity without what was too slow.</returns>
    public Vector RemoveSeparating(Vector position, Vector velocity, List<Body> bodies, double slow)
    {
        var leavesSlowly = false;
        for (var i = Count - 1; i >= 0; i--)
        {
            var isSurface = _contacts[i].Body < 0;
            var relative = isSurface ? velocity : velocity - bodies[_contacts[i].Body].Velocity;
            var (speed, rounding) = (Vector.Dot(relative, _contacts[i].Normal(position)), Rounding * relative.MaximumComponent());
            if (speed > slow + rounding)
            {
                RemoveAt(i);
            }
            else
            {
                leavesSlowly |= isSurface && speed > rounding;
            }
        }

        return leavesSlowly ? Along(velocity, position) : velocity;
    }

    /// <summary>The part of a velocity along all surfaces at once: none where there are three.</summary>
    private Vector Along(Vector velocity, Vector position)
    {
        var (first, second) = (Vector.Zero, Vector.Zero);
        for (var i = 0; i < Count; i++)
        {
            if (_contacts[i].Body >= 0)
            {
                continue;
            }

            var normal = _contacts[i].Normal(position);
            normal -= (Vector.Dot(normal, first) * first) + (Vector.Dot(normal, second) * second);
            if (normal.LengthSquared() <= Parallel)
            {
                continue;
            }

            var direction = normal.UnitVector();
            velocity -= Vector.Dot(velocity, direction) * direction;
            (first, second) = first == Vector.Zero ? (direction, second) : (first, direction);
        }

        return velocity;
    }

    /// <summary>The part of a velocity or an acceleration that leads into none of the contacts: zero where they leave no direction free.</summary>
    /// <param name="vector">World space.</param>
    /// <param name="position">Of the body.</param>
    /// <param name="planes">Lends memory.</param>
    /// <param name="onlySurfaces">Leaves other bodies out.</param>
    /// <param name="accelerated">For accelerations: the other bodies, which give way by their own; null for velocities that they stop.</param>
    public Vector Allow(Vector vector, Vector position, HalfSpaces planes, bool onlySurfaces = false, List<Body>? accelerated = null)
    {
        planes.Clear();
        for (var i = 0; i < Count; i++)
        {
            if (!onlySurfaces || _contacts[i].Body < 0)
            {
                var normal = _contacts[i].Normal(position);
                planes.Add(normal, _contacts[i].Body >= 0 && accelerated is not null ? Vector.Dot(normal, accelerated[_contacts[i].Body].FreeAcceleration) : 0);
            }
        }

        if (!planes.TryNearest(vector, out var allowed))
        {
            return Vector.Zero;
        }

        // What rounding leaves of a vector is nothing: a body in a corner rests.
        return allowed.MaximumComponent() <= Rounding * vector.MaximumComponent() ? Vector.Zero : allowed;
    }

    private void RemoveAt(int index)
    {
        for (var i = index + 1; i < Count; i++)
        {
            _contacts[i - 1] = _contacts[i];
        }

        Count--;
    }
}
