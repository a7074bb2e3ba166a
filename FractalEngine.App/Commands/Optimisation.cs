namespace FractalEngine.App.Commands;

/// <summary>What can be left out without being missed, for <c>--without</c>.</summary>
internal enum Optimisation
{
    /// <summary>The backs of closed meshes.</summary>
    BackFaceCulling,

    /// <summary>What lies beside the picture.</summary>
    FrustumCulling,

    /// <summary>What is hidden behind nearer things.</summary>
    OcclusionCulling,

    /// <summary>Faces without area.</summary>
    DegenerateRemoval,

    /// <summary>GL state that holds already.</summary>
    StateFiltering,

    /// <summary>Uploads of what has not changed.</summary>
    BufferReuse,

    /// <summary>Reading and decoding a file that another object shows already.</summary>
    MeshSharing,

    /// <summary>Preparing what has not been in sight.</summary>
    LazyLoading,

    /// <summary>Pictures like the one before.</summary>
    Idle,
}
