namespace FractalEngine.Render.Tracing;

/// <summary>What an image tells of each pixel, each in channels of its own.</summary>
public enum FrameLayer
{
    /// <summary>Linear light before exposure and tone curve: <c>R</c>, <c>G</c>, <c>B</c>, and <c>A</c> where there is one.</summary>
    Colour,

    /// <summary>The part of light that surfaces reflect, 0 for the background: <c>albedo.R</c>, <c>.G</c>, <c>.B</c>.</summary>
    Albedo,

    /// <summary>Mean of the normals for shading, in world axes: <c>normal.X</c>, <c>.Y</c>, <c>.Z</c>; 0 for the background.</summary>
    Normal,

    /// <summary>Distance of the surface from the camera's plane, scene units: <c>Z</c>; infinite for the background.</summary>
    Depth,

    /// <summary>The point of the surface in world space: <c>position.X</c>, <c>.Y</c>, <c>.Z</c>; 0 for the background.</summary>
    Position,

    /// <summary>Number of maps that lead to the part of a fractal: <c>level.X</c>; 0 for a mesh, −1 for the background.</summary>
    Level,

    /// <summary>Number of traced samples: <c>samples.X</c>.</summary>
    Samples,
}
