using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Visibility;

/// <summary>An object of a scene, as far as it matters for what is drawn of it.</summary>
/// <param name="Hierarchy">Of its fractal or mesh.</param>
/// <param name="ObjectToWorld">From the frame of the fractal to world space.</param>
/// <param name="VertexOrigin">The point of the base mesh that drawn vertices are relative to.</param>
/// <param name="WindingSign">
/// 1 where the base mesh is a solid wound outwards, −1 inwards, so that its back is never seen; 0 where that is not known.
/// </param>
/// <param name="IsOpaque">Whether it hides what lies behind.</param>
public sealed record CulledObject(LodHierarchy Hierarchy, AffineMap ObjectToWorld, Vector VertexOrigin, int WindingSign,
    bool IsOpaque = true)
{
    /// <summary>
    /// What drawing begins with, in the place of the whole fractal under <see cref="ObjectToWorld"/>: for a camera that is told relative to
    /// a sub-fractal (<see cref="FractalAddress"/>). The camera's position in the view is then not used.
    /// </summary>
    public ImmutableArray<LodRoot>? Roots { get; init; }

    /// <summary>What the instances' colours differ by: each then has a number from 0 to 1.</summary>
    public GradientKind GradientKind { get; init; }
}
