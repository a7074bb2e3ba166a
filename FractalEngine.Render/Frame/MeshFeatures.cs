namespace FractalEngine.Render.Frame;

/// <summary>
/// Features of the surface shader. Each combination is a program of its own, so that no vertex or pixel pays for a feature it lacks.
/// </summary>
[Flags]
internal enum MeshFeatures
{
    /// <summary>One colour, lit at the vertices.</summary>
    None = 0,

    /// <summary>Lighting at every pixel.</summary>
    PerPixel = 1,

    /// <summary>A texture on the surface.</summary>
    Textured = 2,

    /// <summary>Specular highlights on the surface.</summary>
    Glossy = 4,

    /// <summary>Instances map to world axes about the camera, with the object's own map included.</summary>
    CameraRelative = 8,

    /// <summary>Back faces are culled and need no lighting.</summary>
    FrontFacesOnly = 16,

    /// <summary>Colours of the vertices, which multiply that of the surface.</summary>
    VertexColours = 32,

    /// <summary>Holes where the texture has less than half the opacity, opaque elsewhere.</summary>
    CutOut = 64,

    /// <summary>Light that the surface emits.</summary>
    Emissive = 128,

    /// <summary>Haze, exposure or a tone curve between the surface and the screen.</summary>
    Atmosphere = 256,

    /// <summary>Shadows of the lights, at every pixel.</summary>
    Shadows = 512,

    /// <summary>Shadows of lights that have a position are among them.</summary>
    PointShadows = 1024,

    /// <summary>A plane beyond which nothing is drawn, and which shows solids filled where it cuts them.</summary>
    Section = 2048,

    /// <summary>Instances come with the parts of the sky that they see.</summary>
    SkyParts = 4096,

    /// <summary>Shadows of lights that have several depth maps, for slices of the view, are among them.</summary>
    ShadowSlices = 8192,

    /// <summary>A texture of normals or heights that bends the surface, where pixels are lit.</summary>
    Detailed = 16384,

    /// <summary>A gradient over the instances of a fractal decides about roughness, metal and glow.</summary>
    Graded = 32768,

    /// <summary>Instances come with the sides that neighbours cover, which are not drawn.</summary>
    CoveredSides = 65536,
}
