using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>The contacts of one body, kept from step to step so that they need not be found again.</summary>
internal sealed class ContactSet() : ContactList(HalfSpaces.Capacity)
{
    // Squared difference of unit normals below which two contacts are the same.
    private const double SameNormalToleranceSquared = 1e-12;

    // Relative to the speed: what rounding leaves of a velocity along the normal.
    private const double RelativeTolerance = 1e-13;

    // Squared sine of the angle below which two normals count as parallel.
    private const double MinSineSquared = 1e-10;

    // Radians: by how much a path over another body may turn before its acceleration is computed anew.
    private const double MaxTurnAngle = 1.0 / 64;

    /// <summary>Adds a contact. It replaces one with the same obstacle and normal, or the oldest one where there is no room.</summary>
    /// <param name="contact">Contact of the body.</param>
    /// <param name="position">Position of the body, world space.</param>
    public void Add(in Contact contact, Vector position)
    {
        var normal = contact.Normal(position);
        var index = IndexOfSame(in contact, normal, position, Count);
        if (index < 0)
        {
            if (Count == _contacts.Length)
            {
                RemoveAt(0);
            }

            index = Count++;
        }

        _contacts[index] = contact with { CachedNormal = normal };
    }

    /// <summary>Finds the first of some contacts with the same obstacle and normal; negative where there is none.</summary>
    private int IndexOfSame(in Contact contact, Vector normal, Vector position, int count)
    {
        for (var i = 0; i < count; i++)
        {
            if (_contacts[i].BodyIndex == contact.BodyIndex
                && (_contacts[i].Normal(position) - normal).LengthSquared() < SameNormalToleranceSquared)
            {
                return i;
            }
        }

        return -1;
    }

    /// <summary>True where another body is touched.</summary>
    public bool HasBody => SurfaceCount < Count;

    /// <summary>Number of surfaces among the contacts.</summary>
    public int SurfaceCount
    {
        get
        {
            var count = 0;
            for (var i = 0; i < Count; i++)
            {
                count += _contacts[i].IsBody ? 0 : 1;
            }

            return count;
        }
    }

    /// <summary>Velocity of the surfaces that carry a body: of the first one that moves.</summary>
    /// <param name="position">Position of the body, world space.</param>
    /// <param name="acceleration">Receives how it changes for a body that goes along, units per second².</param>
    public Vector CarryingVelocity(Vector position, out Vector acceleration)
    {
        for (var i = 0; i < Count; i++)
        {
            if (_contacts[i].Kinematic is { IsCarrying: true } kinematic)
            {
                var velocity = _contacts[i].SurfaceVelocity(position);
                acceleration = Vector.Cross(kinematic.AngularVelocity, velocity - kinematic.Velocity);
                return velocity;
            }
        }

        acceleration = Vector.Zero;
        return Vector.Zero;
    }

    /// <summary>True where another body is touched that does not sleep.</summary>
    public bool HasAwakeBody(List<Body> bodies)
    {
        for (var i = 0; i < Count; i++)
        {
            if (_contacts[i].IsBody && !bodies[_contacts[i].BodyIndex].IsAsleep)
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Removes surfaces that are not touched any more, and all other bodies, since those move.</summary>
    /// <param name="position">Position of the body, world space.</param>
    /// <param name="contactSlop">See <see cref="ContactTolerances.Slop"/>.</param>
    /// <param name="radius">Radius of the body, which may have shrunk.</param>
    public void Refresh(Vector position, double contactSlop, double radius)
    {
        for (var i = Count - 1; i >= 0; i--)
        {
            _contacts[i] = _contacts[i] with { CombinedRadius = radius };
            if (_contacts[i].IsBody || _contacts[i].Gap(position) > contactSlop)
            {
                RemoveAt(i);
            }
        }
    }

    /// <summary>Replaces a contact by what has become of it.</summary>
    public void Replace(int index, in Contact contact) => _contacts[index] = contact;

    /// <summary>Removes contacts that have become the same one.</summary>
    public void RemoveDuplicates(Vector position)
    {
        for (var i = Count - 1; i > 0; i--)
        {
            if (IndexOfSame(in _contacts[i], _contacts[i].Normal(position), position, i) >= 0)
            {
                RemoveAt(i);
            }
        }
    }

    /// <summary>Removes the contact at an index.</summary>
    public void RemoveAt(int index)
    {
        Count--;
        Array.Copy(_contacts, index + 1, _contacts, index, Count - index);
    }

    /// <summary>Removes the contacts from which a velocity leads away.</summary>
    /// <param name="position">Position of the body, world space.</param>
    /// <param name="velocity">Velocity of the body.</param>
    /// <param name="bodies">All bodies.</param>
    /// <param name="negligibleSpeed">
    /// Speed below which a body does not leave a surface: gravity would return it at once, and several edges could pass it back and forth.
    /// </param>
    /// <returns>The velocity; where it leaves a surface too slowly, only its part along all surfaces.</returns>
    /// <remarks>Other bodies count as left only by a velocity away from where they are.</remarks>
    public Vector RemoveSeparating(Vector position, Vector velocity, List<Body> bodies, double negligibleSpeed)
    {
        var isSeparatingSlowly = false;
        for (var i = Count - 1; i >= 0; i--)
        {
            var isSurface = !_contacts[i].IsBody;
            var relative = velocity
                - (isSurface ? _contacts[i].SurfaceVelocity(position) : _contacts[i].VelocityOf(bodies[_contacts[i].BodyIndex]));
            var normal = _contacts[i].Normal(position);
            var rounding = RelativeTolerance * Math.Max(relative.MaxAbsComponent(), velocity.MaxAbsComponent());
            var separationSpeed = Vector.Dot(relative, normal);
            separationSpeed = isSurface ? separationSpeed : Math.Min(separationSpeed, Vector.Dot(velocity, normal));
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

    /// <summary>The part of a velocity along all surfaces at once, relative to them: zero where there are three.</summary>
    private Vector ProjectOntoSurfaces(Vector velocity, Vector position)
    {
        var firstAxis = Vector.Zero;
        var secondAxis = Vector.Zero;
        var target = Vector.Zero;
        for (var i = 0; i < Count; i++)
        {
            if (_contacts[i].IsBody)
            {
                continue;
            }

            var normal = _contacts[i].Normal(position);
            var speed = Vector.Dot(normal, _contacts[i].SurfaceVelocity(position) - target);
            normal -= (Vector.Dot(normal, firstAxis) * firstAxis) + (Vector.Dot(normal, secondAxis) * secondAxis);
            if (normal.LengthSquared() <= MinSineSquared)
            {
                continue;
            }

            var direction = normal.UnitVector();
            speed /= normal.Length();
            target += speed * direction;
            velocity -= (Vector.Dot(velocity, direction) - speed) * direction;
            if (firstAxis == Vector.Zero)
            {
                firstAxis = direction;
            }
            else
            {
                secondAxis = direction;
            }
        }

        return velocity;
    }

    /// <summary>Projects a velocity onto those that lead into no contact; zero where these leave no direction free.</summary>
    /// <param name="velocity">World space.</param>
    /// <param name="position">Position of the body, world space.</param>
    /// <param name="planes">Scratch memory, overwritten.</param>
    /// <param name="onlySurfaces">Ignores other bodies.</param>
    public Vector ProjectVelocity(Vector velocity, Vector position, HalfSpaces planes, bool onlySurfaces = false)
    {
        planes.Clear();
        for (var i = 0; i < Count; i++)
        {
            if (!onlySurfaces || !_contacts[i].IsBody)
            {
                var normal = _contacts[i].Normal(position);
                planes.Add(normal, Vector.Dot(normal, _contacts[i].SurfaceVelocity(position)));
            }
        }

        return ProjectWithoutRounding(velocity, planes);
    }

    /// <summary>
    /// Projects an acceleration onto those that lead into no contact. Other bodies do not give way, and a body that slides over another
    /// follows its sphere: a = −v²/r along the normal.
    /// </summary>
    /// <param name="acceleration">World space.</param>
    /// <param name="position">Position of the body, world space.</param>
    /// <param name="velocity">Velocity of the body.</param>
    /// <param name="planes">Scratch memory, overwritten.</param>
    /// <param name="validDuration">Seconds for which the result holds: until the path over another body has turned by 1/64.</param>
    public Vector ProjectAcceleration(
        Vector acceleration, Vector position, Vector velocity, HalfSpaces planes, out double validDuration)
    {
        validDuration = double.PositiveInfinity;
        planes.Clear();
        for (var i = 0; i < Count; i++)
        {
            var normal = _contacts[i].Normal(position);
            var minNormalAcceleration = 0.0;
            if (_contacts[i].IsBody)
            {
                var tangentialVelocity = velocity - (Vector.Dot(velocity, normal) * normal);
                minNormalAcceleration -= tangentialVelocity.LengthSquared() / _contacts[i].CombinedRadius;
                validDuration = Math.Min(validDuration, MaxTurnAngle * _contacts[i].CombinedRadius / tangentialVelocity.Length());
            }
            else if (_contacts[i].Kinematic is { } kinematic && kinematic.AngularVelocity != Vector.Zero)
            {
                minNormalAcceleration = kinematic.NormalAccelerationAt(position, normal, velocity);
                validDuration = Math.Min(validDuration, MaxTurnAngle / kinematic.AngularVelocity.Length());
            }

            planes.Add(normal, minNormalAcceleration);
        }

        return ProjectWithoutRounding(acceleration, planes);
    }

    private static Vector ProjectWithoutRounding(Vector vector, HalfSpaces planes)
    {
        var projected = planes.ProjectOrZero(vector);
        // What rounding leaves of a vector counts as nothing: a body in a corner rests.
        return projected.MaxAbsComponent() <= RelativeTolerance * vector.MaxAbsComponent() ? Vector.Zero : projected;
    }
}
