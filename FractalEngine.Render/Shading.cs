namespace FractalEngine.Render;

/// <summary>Where the lights act on a surface.</summary>
public enum Shading
{
    /// <summary>At the vertices; between them the colour is interpolated. Fast where triangles are small.</summary>
    PerVertex,

    /// <summary>At every pixel, with the normal interpolated: round highlights and edges of light also on large triangles.</summary>
    PerPixel,
}
