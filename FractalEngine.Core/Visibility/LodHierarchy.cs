using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility;

/// <summary>
/// The levels of a fractal as they are drawn: one state for each number of levels left, with the boxes that exact search has found, and
/// without copies that would be drawn twice. Kilobytes at any depth.
/// </summary>
public sealed class LodHierarchy
{
    // Of a box that holds another, beside which it is not counted that the other reaches out.
    private const double ContainmentFactor = 1.001;

    private readonly LodNode[] _nodes;
    private readonly LevelRegion[] _regions;

    private LodHierarchy(LodNode[] nodes, LevelRegion[] regions, long levelCount, Mesh mesh) =>
        (_nodes, _regions, LevelCount, Mesh, Occluder) = (nodes, regions, levelCount, mesh, new(mesh));

    /// <summary>What every instance is a copy of.</summary>
    public Mesh Mesh { get; }

    /// <summary>The same, for drawing it into a <see cref="OcclusionBuffer"/>.</summary>
    internal OccluderMesh Occluder { get; }

    /// <summary>The levels of the whole fractal; a huge number where they are infinitely many.</summary>
    internal long LevelCount { get; }

    /// <summary>The table of any fractal.</summary>
    /// <exception cref="FractalLimitException">
    /// Bounds overflow a double or don't settle, as those of an infinite fractal that grows; or there are more than
    /// <see cref="FractalLimits.MaxComponentwiseSums"/> sums in componentwise composition.
    /// </exception>
    /// <exception cref="SingularMatrixException">A map flattens what it maps.</exception>
    public static LodHierarchy Build(Fractal fractal) =>
        fractal.Description.Composition == Composition.Componentwise ? BuildComponentwise(fractal) : BuildAffine(fractal);

    /// <summary>The table of a mesh that is drawn once.</summary>
    public static LodHierarchy Build(Mesh mesh) =>
        new([new(mesh.FaceCount == 0 ? BoundingBox.Empty : mesh.Bounds, AffineMap.Identity, [])], [new(0, 1, 0, 1)], 0, mesh);

    /// <summary>The state with so many levels left.</summary>
    internal LodNode NodeAt(long remainingLevels) => _nodes[LevelRegion.FindIndex(_regions, remainingLevels)];

    private static LodHierarchy BuildAffine(Fractal fractal)
    {
        var builder = new SubFractalBuilder(fractal);
        builder.AddAllSteps();
        var regions = builder.Regions.ToArray();
        var nodes = new LodNode[builder.SubFractals.Count];
        foreach (var region in regions)
        {
            for (var i = 0; i < region.Period; i++)
            {
                nodes[region.FirstIndex + i] = BuildNode(builder, region.FirstLevel + i);
            }
        }

        return new(nodes, regions, builder.Levels, fractal.BaseMesh);
    }

    private static LodNode BuildNode(SubFractalBuilder builder, long remainingLevels)
    {
        var children = builder.EdgesAt(remainingLevels)
            .Select(step => (Step: step, Below: builder.VolumeAt(step.RemainingLevels(remainingLevels))))
            .Where(child => !child.Below.Box.IsEmpty)
            .Select(child => new LodChild(
                child.Step.Map,
                child.Below.TransformedBox(child.Step.Map, child.Step.OperatorNormBound),
                child.Step.LevelStep,
                child.Step.Map == AffineMap.Identity ? -1 : child.Step.MapIndex));
        var (baseBox, box) = (builder.VolumeAt(0).Box, builder.VolumeAt(remainingLevels).Box);
        return new(box, ComputeProxyMap(baseBox, box), [.. children]);
    }

    /// <summary>
    /// How the base mesh stands for what a box holds: as it is, where it lies within; else its maps have carried it away, and it is
    /// stretched to fill the box.
    /// </summary>
    private static AffineMap ComputeProxyMap(BoundingBox baseBox, BoundingBox box) =>
        box.IsEmpty || BoundingBox.Union(box, baseBox).Diagonal <= ContainmentFactor * box.Diagonal
        ? AffineMap.Identity
        : InstanceBvh.MapBoxToBox(baseBox, box);

    /// <summary>Sums have no levels: they are sorted into a tree of groups by their places.</summary>
    private static LodHierarchy BuildComponentwise(Fractal fractal)
    {
        var mesh = fractal.BaseMesh;
        var maps = mesh.FaceCount == 0 ? [] : FractalGenerator.Expand(fractal, FractalLimits.MaxComponentwiseSums);
        var tree = new InstanceBvh(mesh.Bounds, [.. maps]);
        return new(tree.Nodes, [new(0, tree.Nodes.Length, 0, tree.Nodes.Length)], tree.RootIndex, mesh);
    }
}
