using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Visibility;

namespace FractalEngine.Render;

/// <summary>How a scene is prepared and drawn, apart from what the scene itself says.</summary>
public sealed record RenderSettings
{
    /// <summary>
    /// What is left out of a picture because it would not be seen; null to draw every instance of every fractal in every picture.
    /// </summary>
    public CullingSettings? Culling { get; init; } = new();

    /// <summary>
    /// Without <see cref="Culling"/>, the most instances of one fractal that are drawn; deeper fractals are drawn at a smaller depth, with
    /// a notice.
    /// </summary>
    public int InstanceBudget { get; init; } = FractalLimits.MaxDrawnInstances;

    /// <summary>
    /// Without <see cref="Culling"/>, the most triangles of one fractal that are drawn: limits instances of large meshes further.
    /// </summary>
    public long TriangleBudget { get; init; } = 200_000_000;

    /// <summary>Where faces meet at a larger angle, generated normals make an edge. Degrees.</summary>
    public double CreaseAngle { get; init; } = NormalGenerator.DefaultCreaseAngle;

    /// <summary>Samples a pixel; 0 switches multisampling off. More than the driver has means as many as it has.</summary>
    public int Samples { get; init; } = 4;

    /// <summary>Leaves out the backs of closed meshes, where only fronts can be seen.</summary>
    public bool BackFaceCulling { get; init; } = true;

    /// <summary>Leaves out faces without area, when a mesh is prepared.</summary>
    public bool RemoveDegenerateTriangles { get; init; } = true;

    /// <summary>Decodes and keeps each picture once, however many models show it.</summary>
    public bool ShareTextures { get; init; } = true;

    /// <summary>
    /// In a window, prepares a model when one of its objects is first in sight, and not before; where false, all of them before the first
    /// picture.
    /// </summary>
    public bool LazyLoading { get; init; } = true;

    /// <summary>Does not bind what is bound already, nor set uniforms to what they are.</summary>
    public bool FilterRedundantState { get; init; } = true;

    /// <summary>
    /// Keeps what is on the GPU where it has not changed: chosen instances, objects and lights. Where false, all are chosen and uploaded
    /// for each picture.
    /// </summary>
    public bool ReuseBuffers { get; init; } = true;

    /// <summary>Where the lights act.</summary>
    public Shading Shading { get; init; }

    /// <summary>Draws the edges of the triangles only.</summary>
    public bool Wireframe { get; init; }

    /// <summary>Draws a grid on the plane y = 0.</summary>
    public bool Grid { get; init; }

    /// <summary>Draws the x axis red, the y axis green and the z axis blue.</summary>
    public bool Axes { get; init; }

    /// <summary>Behind everything, where the scene does not say.</summary>
    public Colour Background { get; init; } = DefaultBackground;

    /// <summary>A dark blue grey that lets both light and saturated surfaces stand out.</summary>
    public static Colour DefaultBackground => new(0.118, 0.133, 0.161);
}
