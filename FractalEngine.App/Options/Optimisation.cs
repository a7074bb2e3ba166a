namespace FractalEngine.App.Options;

/// <summary>The optimisations that <c>--without</c> can disable. They change the cost of a frame, but hardly the frame itself.</summary>
internal enum Optimisation
{
    /// <summary>Skips the back faces of closed meshes.</summary>
    BackFaceCulling,

    /// <summary>Skips sub-fractals and objects outside the view frustum.</summary>
    FrustumCulling,

    /// <summary>Skips sub-fractals that are hidden behind closer ones or cover no sample.</summary>
    OcclusionCulling,

    /// <summary>Removes triangles without area when a mesh is prepared.</summary>
    DegenerateRemoval,

    /// <summary>Draws no depth maps of lights that are dark, or light nothing visible.</summary>
    LightCulling,

    /// <summary>Draws no objects into depth maps whose shadow falls on nothing visible.</summary>
    CasterCulling,

    /// <summary>Computes no ambient occlusion of fractals that certainly have none.</summary>
    BakeSkipping,

    /// <summary>Skips OpenGL calls that would not change the state.</summary>
    StateFiltering,

    /// <summary>Keeps unchanged buffers on the GPU, and the culling result of an unchanged view.</summary>
    BufferReuse,

    /// <summary>Loads each mesh and decodes each texture once, however many objects show it.</summary>
    MeshSharing,

    /// <summary>Prepares a model only when one of its objects first becomes visible.</summary>
    LazyLoading,

    /// <summary>Draws no frame while nothing has changed.</summary>
    Idle,
}
