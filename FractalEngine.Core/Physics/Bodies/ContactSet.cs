using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>The contacts of one body, kept from step to step so that they need not be found again.</summary>
internal sealed partial class ContactSet() : ContactList(HalfSpaces.Capacity)
{
    // Squared difference of unit normals below which two contacts are the same.
    private const double SameNormalToleranceSquared = 1e-12;

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
        for (var i = index + 1; i < Count; i++)
        {
            _contacts[i - 1] = _contacts[i];
        }

        Count--;
    }
}
