using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility;

/// <summary>An object of a scene, reduced to what decides about its visible instances.</summary>
/// <param name="Hierarchy">Level-of-detail hierarchy of the object's fractal or mesh.</param>
/// <param name="ObjectToWorld">Map from the frame of the fractal to world space.</param>
/// <param name="VertexOrigin">Point of the base mesh's frame that the drawn vertices are relative to.</param>
/// <param name="WindingSign">
/// 1 where the base mesh is a closed solid wound outwards, −1 inwards, so that its back faces are never visible; 0 where that is unknown.
/// </param>
/// <param name="IsOpaque">Whether the object occludes what lies behind it.</param>
public sealed record CulledObject(LodHierarchy Hierarchy, AffineMap ObjectToWorld, Vector VertexOrigin, int WindingSign,
    bool IsOpaque = true)
{
    /// <summary>The sub-fractals to draw instead of the whole fractal under <see cref="ObjectToWorld"/>.</summary>
    /// <remarks>
    /// For a camera whose position is given relative to a sub-fractal (<c>FractalAddress</c>). The camera position of the view is
    /// then not used.
    /// </remarks>
    public ImmutableArray<LodRoot>? Roots { get; init; }

    /// <summary>The kind of the object's gradient; unless it is none, each instance has a gradient factor from 0 to 1.</summary>
    public GradientKind GradientKind { get; init; }

    /// <summary>
    /// What tells gradient factors that paths of maps alone do not, and colours of palettes; null where <see cref="GradientKind"/> does.
    /// </summary>
    public InstanceGradient? Shading { get; init; }

    /// <summary>Whether the hierarchy's <see cref="LodHierarchy.HasSkyMasks"/> was true before culling began.</summary>
    public bool HasSkyMasks { get; init; }
}
