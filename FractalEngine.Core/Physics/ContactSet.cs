using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>What a body touches, so that it need not be found again while it stays so.</summary>
internal sealed class ContactSet
{
    // Relative to the speed: what rounding leaves of a velocity along the normal.
    private const double RelativeTolerance = 1e-13;

    // Squared sine of the angle below which two surfaces are one.
    private const double MinSineSquared = 1e-10;

    // Of the reach: a gap that differs by less needs no other point.
    private const double GapTolerance = 1e-13;

    // Radians: by how much a way over another body turns before it is looked at anew.
    private const double MaxTurnAngle = 1.0 / 64;

    // Contacts whose directions differ by less are the same.
    private const double SameNormalToleranceSquared = 1e-12;

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
            if (_contacts[i].BodyIndex == contact.BodyIndex
                && (_contacts[i].Normal(position) - normal).LengthSquared() < SameNormalToleranceSquared)
            {
                _contacts[i] = contact with { CachedNormal = normal };
                return;
            }
        }

        if (Count == _contacts.Length)
        {
            RemoveAt(0);
        }

        _contacts[Count++] = contact with { CachedNormal = normal };
    }

    /// <summary>True where a body is touched that does not sleep.</summary>
    public bool HasAwakeBody(List<Body> bodies)
    {
        for (var i = 0; i < Count; i++)
        {
            if (_contacts[i].BodyIndex >= 0 && !bodies[_contacts[i].BodyIndex].IsAsleep)
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Forgets those that are not touched any more, and those with other bodies, which move.</summary>
    /// <param name="position">Of the body.</param>
    /// <param name="contactSlop">See <see cref="Obstacles.ContactSlop"/>.</param>
    /// <param name="radius">Of the body, which may have shrunk.</param>
    public void Refresh(Vector position, double contactSlop, double radius)
    {
        for (var i = Count - 1; i >= 0; i--)
        {
            _contacts[i] = _contacts[i] with { CombinedRadius = radius };
            if (_contacts[i].BodyIndex >= 0 || _contacts[i].Gap(position) > contactSlop)
            {
                RemoveAt(i);
            }
        }
    }

    /// <summary>After a move: keeps those surfaces that are still touched, perhaps at another point, and forgets the others.</summary>
    public void UpdateAfterMove(Vector position, double contactSlop, Obstacles obstacles)
    {
        for (var i = Count - 1; i >= 0; i--)
        {
            if (_contacts[i].BodyIndex < 0 && _contacts[i].Gap(position) is var gap
                && Math.Abs(gap) > GapTolerance * _contacts[i].CombinedRadius
                && obstacles.TryUpdateContact(position, in _contacts[i], out var updated))
            {
                _contacts[i] = updated;
            }

            if (_contacts[i].Gap(position) > contactSlop)
            {
                RemoveAt(i);
            }
        }
    }

    /// <summary>Forgets those that a velocity leads away from.</summary>
    /// <param name="position">Of the body.</param>
    /// <param name="velocity">Of the body.</param>
    /// <param name="bodies">The others.</param>
    /// <param name="negligibleSpeed">
    /// What leaves a surface more slowly does not leave: it would be back at once, and several edges could pass a body to and fro. It loses
    /// that speed, since gravity would have taken it.
    /// </param>
    /// <param name="treatBodiesAsStatic">Bodies are left, too, only by what moves away from where they are.</param>
    /// <returns>The velocity without what was too slow.</returns>
    public Vector RemoveSeparating(Vector position, Vector velocity, List<Body> bodies, double negligibleSpeed, bool treatBodiesAsStatic)
    {
        var isSeparatingSlowly = false;
        for (var i = Count - 1; i >= 0; i--)
        {
            var isSurface = _contacts[i].BodyIndex < 0;
            var relative = isSurface ? velocity : velocity - bodies[_contacts[i].BodyIndex].Velocity;
            var normal = _contacts[i].Normal(position);
            var (separationSpeed, rounding) = (Vector.Dot(relative, normal), RelativeTolerance * relative.MaxAbsComponent());
            separationSpeed = treatBodiesAsStatic ? Math.Min(separationSpeed, Vector.Dot(velocity, normal)) : separationSpeed;
            if (separationSpeed > negligibleSpeed + rounding)
            {
                RemoveAt(i);
            }
            else
            {
                isSeparatingSlowly |= isSurface && separationSpeed > rounding;
            }
        }

        return isSeparatingSlowly ? ProjectOntoSurfaces(velocity, position) : velocity;
    }

    /// <summary>The part of a velocity along all surfaces at once: none where there are three.</summary>
    private Vector ProjectOntoSurfaces(Vector velocity, Vector position)
    {
        var (firstAxis, secondAxis) = (Vector.Zero, Vector.Zero);
        for (var i = 0; i < Count; i++)
        {
            if (_contacts[i].BodyIndex >= 0)
            {
                continue;
            }

            var normal = _contacts[i].Normal(position);
            normal -= (Vector.Dot(normal, firstAxis) * firstAxis) + (Vector.Dot(normal, secondAxis) * secondAxis);
            if (normal.LengthSquared() <= MinSineSquared)
            {
                continue;
            }

            var direction = normal.UnitVector();
            velocity -= Vector.Dot(velocity, direction) * direction;
            (firstAxis, secondAxis) = firstAxis == Vector.Zero ? (direction, secondAxis) : (firstAxis, direction);
        }

        return velocity;
    }

    /// <summary>The part of a velocity that leads into none of the contacts: zero where they leave no direction free.</summary>
    /// <param name="velocity">World space.</param>
    /// <param name="position">Of the body.</param>
    /// <param name="planes">Lends memory.</param>
    /// <param name="onlySurfaces">Leaves other bodies out.</param>
    public Vector ProjectVelocity(Vector velocity, Vector position, HalfSpaces planes, bool onlySurfaces = false)
    {
        planes.Clear();
        for (var i = 0; i < Count; i++)
        {
            if (!onlySurfaces || _contacts[i].BodyIndex < 0)
            {
                planes.Add(_contacts[i].Normal(position), 0);
            }
        }

        return ProjectOrZero(velocity, planes);
    }

    /// <summary>
    /// The part of an acceleration that leads into none of the contacts. Other bodies give way by their own, and who slides over one is
    /// held to its sphere: a = −v²/r along the normal.
    /// </summary>
    /// <param name="acceleration">World space.</param>
    /// <param name="position">Of the body.</param>
    /// <param name="velocity">Of the body.</param>
    /// <param name="bodies">The others.</param>
    /// <param name="planes">Lends memory.</param>
    /// <param name="treatBodiesAsStatic">Other bodies do not give way.</param>
    /// <param name="validDuration">How long it holds: until the way over another body has turned by 1/64.</param>
    public Vector ProjectAcceleration(Vector acceleration, Vector position, Vector velocity, List<Body> bodies, HalfSpaces planes,
        bool treatBodiesAsStatic, out double validDuration)
    {
        validDuration = double.PositiveInfinity;
        planes.Clear();
        for (var i = 0; i < Count; i++)
        {
            var normal = _contacts[i].Normal(position);
            var minNormalAcceleration = 0.0;
            if (_contacts[i].BodyIndex >= 0)
            {
                var other = bodies[_contacts[i].BodyIndex];
                var relative = treatBodiesAsStatic ? velocity : velocity - other.Velocity;
                var tangentialVelocity = relative - (Vector.Dot(relative, normal) * normal);
                minNormalAcceleration = (treatBodiesAsStatic ? 0 : Vector.Dot(normal, other.NetAcceleration))
                    - (tangentialVelocity.LengthSquared() / _contacts[i].CombinedRadius);
                validDuration = Math.Min(validDuration, MaxTurnAngle * _contacts[i].CombinedRadius / tangentialVelocity.Length());
            }

            planes.Add(normal, minNormalAcceleration);
        }

        return ProjectOrZero(acceleration, planes);
    }

    private static Vector ProjectOrZero(Vector vector, HalfSpaces planes)
    {
        if (!planes.TryProject(vector, out var projected))
        {
            return Vector.Zero;
        }

        // What rounding leaves of a vector is nothing: a body in a corner rests.
        return projected.MaxAbsComponent() <= RelativeTolerance * vector.MaxAbsComponent() ? Vector.Zero : projected;
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
