namespace FractalEngine.Core.Scenes;

/// <summary>The colliders that a scene can name.</summary>
public enum ColliderKind
{
    /// <summary>The exact fractal collider for fractals, the hierarchy for meshes.</summary>
    Exact,

    /// <summary>The paper's greedy descent (§4.4.3): approximate.</summary>
    Fractal,

    /// <summary>A bounding volume hierarchy over faces: exact.</summary>
    Hierarchy,

    /// <summary>The paper's octree (§5.4): approximate.</summary>
    BoundingBox,

    /// <summary>Every face (§4.4.2): exact, the reference.</summary>
    Simple,
}
