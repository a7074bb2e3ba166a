namespace FractalEngine.Core.Colliders;

/// <summary>The kinds of collider that a scene or a command can name.</summary>
public enum ColliderKind
{
    /// <summary>The exact fractal collider for fractals, the hierarchy for meshes.</summary>
    Exact,

    /// <summary>The paper's greedy descent (§4.4.3): approximate.</summary>
    Fractal,

    /// <summary>A bounding volume hierarchy over faces: exact.</summary>
    Hierarchy,

    /// <summary>The paper's octree over faces (§5.4): approximate.</summary>
    BoundingBox,

    /// <summary>A test of every face (§4.4.2): exact, the reference.</summary>
    Simple,
}
