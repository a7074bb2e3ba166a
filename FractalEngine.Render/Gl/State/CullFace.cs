namespace FractalEngine.Render.Gl.State;

/// <summary>Selects the face of triangles that is not drawn.</summary>
internal enum CullFace
{
    /// <summary>Both faces are drawn.</summary>
    None,

    /// <summary>Front faces are not drawn.</summary>
    Front,

    /// <summary>Back faces are not drawn.</summary>
    Back,
}
