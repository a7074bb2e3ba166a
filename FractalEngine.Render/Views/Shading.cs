namespace FractalEngine.Render.Views;

/// <summary>Selects the points of a surface at which lighting is computed.</summary>
public enum Shading
{
    /// <summary>Lighting at the vertices, interpolated between them. Fast where triangles are small.</summary>
    PerVertex,

    /// <summary>Lighting at every pixel with an interpolated normal. Highlights and light edges stay round on large triangles.</summary>
    PerPixel,
}
