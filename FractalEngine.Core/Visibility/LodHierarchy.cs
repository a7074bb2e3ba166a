using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility;

/// <summary>
/// The level-of-detail hierarchy of a fractal: one node for each number of remaining levels, with the bounding boxes that exact search
/// has found. It takes kilobytes at any depth.
/// </summary>
public sealed class LodHierarchy
{
    private readonly LodNode[] _nodes;
    private readonly LevelRegion[] _regions;

    internal LodHierarchy(LodNode[] nodes, LevelRegion[] regions, long levelCount, Mesh mesh)
    {
        _nodes = nodes;
        _regions = regions;
        LevelCount = levelCount;
        Mesh = mesh;
        Occluder = new(mesh);
    }

    /// <summary>The base mesh that every instance draws.</summary>
    public Mesh Mesh { get; }

    /// <summary>The base mesh in the form that an <see cref="OcclusionBuffer"/> rasterizes.</summary>
    internal OccluderMesh Occluder { get; }

    /// <summary>Number of levels of the whole fractal; a huge number where they are infinitely many.</summary>
    internal long LevelCount { get; }

    /// <summary>Builds the hierarchy of a fractal.</summary>
    /// <param name="fractal">Fractal of any composition and depth.</param>
    /// <exception cref="FractalLimitException">
    /// Bounds overflow a double or don't converge, as those of an infinite fractal that grows; or there are more than
    /// <see cref="FractalLimits.MaxComponentwiseSums"/> sums in componentwise composition.
    /// </exception>
    /// <exception cref="SingularMatrixException">A map of the fractal flattens space.</exception>
    public static LodHierarchy Build(Fractal fractal) => LodHierarchyBuilder.Build(fractal);

    /// <summary>Builds the hierarchy of a mesh that is drawn once.</summary>
    public static LodHierarchy Build(Mesh mesh) =>
        new([new(mesh.FaceCount == 0 ? BoundingBox.Empty : mesh.Bounds, AffineMap.Identity, [])], [new(0, 1, 0, 1)], 0, mesh);

    /// <summary>Finds the node of a number of remaining levels.</summary>
    internal LodNode NodeAt(long remainingLevels) => _nodes[LevelRegion.FindIndex(_regions, remainingLevels)];
}
