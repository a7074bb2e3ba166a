using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>Faces that a ball touches or may meet in a step, and that no contact knows of.</summary>
internal sealed class NearSurfaceList() : ContactList(NearSurfaceList.Capacity)
{
    /// <summary>Maximum number of faces.</summary>
    public const int Capacity = 4;

    // Cosine between normals from which on two surfaces near a ball count as one.
    private const double SameNormal = 0.999;

    /// <summary>Adds a face, unless it is known or there is no room.</summary>
    /// <param name="surface">The face.</param>
    /// <param name="normal">Unit normal towards the ball.</param>
    /// <param name="contacts">What the ball touches.</param>
    /// <param name="centre">Centre of the ball, world space.</param>
    public void Add(in Contact surface, Vector normal, ContactSet contacts, Vector centre)
    {
        var isKnown = Count == Capacity;
        for (var i = 0; i < Count; i++)
        {
            isKnown |= _contacts[i].Kinematic == surface.Kinematic && Vector.Dot(_contacts[i].CachedNormal, normal) > SameNormal;
        }

        for (var i = 0; i < contacts.Count; i++)
        {
            isKnown |= !contacts[i].IsBody && contacts[i].Kinematic == surface.Kinematic
                && Vector.Dot(contacts[i].Normal(centre), normal) > SameNormal;
        }

        if (!isKnown)
        {
            _contacts[Count++] = surface with { CachedNormal = normal };
        }
    }
}
