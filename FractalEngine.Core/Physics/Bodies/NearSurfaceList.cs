using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>Faces that a ball touches or may meet in a step, and that no contact knows of.</summary>
internal sealed class NearSurfaceList
{
    /// <summary>Maximum number of faces.</summary>
    public const int Capacity = 4;

    // Cosine between normals from which on two surfaces near a ball count as one.
    private const double SameNormal = 0.999;

    private readonly Contact[] _surfaces = new Contact[Capacity];

    /// <summary>Number of faces at present.</summary>
    public int Count { get; private set; }

    /// <summary>The face at an index from 0 to <see cref="Count"/> − 1, with its normal.</summary>
    public ref readonly Contact this[int index] => ref _surfaces[index];

    /// <summary>True where one of them moves.</summary>
    public bool HasMovingSurface
    {
        get
        {
            var hasMoving = false;
            for (var i = 0; i < Count; i++)
            {
                hasMoving |= _surfaces[i].Kinematic is { IsCarrying: true };
            }

            return hasMoving;
        }
    }

    /// <summary>Removes all faces of the list.</summary>
    public void Clear() => Count = 0;

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
            isKnown |= _surfaces[i].Kinematic == surface.Kinematic && Vector.Dot(_surfaces[i].CachedNormal, normal) > SameNormal;
        }

        for (var i = 0; i < contacts.Count; i++)
        {
            isKnown |= !contacts[i].IsBody && contacts[i].Kinematic == surface.Kinematic
                && Vector.Dot(contacts[i].Normal(centre), normal) > SameNormal;
        }

        if (!isKnown)
        {
            _surfaces[Count++] = surface with { CachedNormal = normal };
        }
    }
}
