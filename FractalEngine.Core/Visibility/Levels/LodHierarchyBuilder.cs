using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>Builds the <see cref="LodHierarchy"/> of a fractal.</summary>
internal static class LodHierarchyBuilder
{
    // A box counts as holding another one if their union is no larger than this multiple of it.
    private const double ContainmentFactor = 1.001;

    /// <summary>Builds the hierarchy of a fractal of either composition, see <see cref="LodHierarchy.Build(Fractal)"/>.</summary>
    public static LodHierarchy Build(Fractal fractal) =>
        fractal.Description.Composition == Composition.Componentwise ? BuildComponentwise(fractal) : BuildAffine(fractal);

    private static LodHierarchy BuildAffine(Fractal fractal)
    {
        var hierarchy = fractal.HierarchyBySets;
        // The first levels are the base meshes. Where there are several, nothing stands for a sub-fractal.
        var mesh = fractal.HasSeveralMeshes ? Mesh.Empty : fractal.BaseMesh;
        var baseBox = fractal.HasSeveralMeshes ? BoundingBox.Empty
            : hierarchy.AllLevels.Items[fractal.BaseMeshes.IndexOf(mesh)].Box;
        var hasColours = fractal.HasColours;
        var means = hasColours ? MeanTints.Compute(hierarchy).Zip(hierarchy.AllLevels.Items.ToArray()).ToDictionary(
            static pair => pair.Second, static pair => pair.First) : null;
        var nodes = hierarchy.AllLevels.Select(level => BuildNode(level, baseBox, hierarchy.HasPicks, means?[level]));
        return new(nodes, hierarchy.Top.Level, mesh)
        {
            HasCoveredSides = !hierarchy.HasPicks && CoveredSides.TryMark(nodes.Items, mesh),
            Source = fractal,
            HasColours = hasColours,
            HasPicks = hierarchy.HasPicks,
            ColourLevels = fractal.LevelCount ?? hierarchy.Top.Level,
        };
    }

    private static LodNode BuildNode(HierarchyLevel level, BoundingBox baseBox, bool hasPicks, Tint? mean)
    {
        // A pick knows the alternatives by their numbers: none is left out, except where all are empty.
        var pick = level.Set?.Pick;
        var keepsAll = pick is not null && !level.Box.IsEmpty;
        var children = level.Edges.Zip(level.GetEdgeBoxes()).Where(child => keepsAll || !child.Second.IsEmpty);
        LodChild[] all = [.. children.Select(child => CreateChild(child.First, child.Second, hasPicks, mean is not null))];
        return new(level.Box, ComputeProxyMap(baseBox, level.Box), all, level.Set?.Maps.Length ?? 0, pick)
        {
            MeanTint = (mean ?? Tint.None).ToSingle(),
        };
    }

    private static LodChild CreateChild(ChildEdge edge, BoundingBox box, bool hasPicks, bool hasColours) => new(
        edge.Map, box, edge.LevelStep, edge.Map == AffineMap.Identity ? -1 : edge.MapIndex)
    {
        Edge = hasPicks ? edge : null,
        Tint = hasColours ? Tint.Of(edge.Set.ColourOf(edge.MapIndex)) : null,
    };

    /// <summary>Computes the map under which the base mesh is the proxy of what a box holds.</summary>
    /// <remarks>
    /// It is the identity where the base mesh lies within the box. Otherwise the maps have carried the base mesh away, and the proxy is
    /// stretched to fill the box.
    /// </remarks>
    private static AffineMap ComputeProxyMap(BoundingBox baseBox, BoundingBox box) =>
        box.IsEmpty || BoundingBox.Union(box, baseBox).Diagonal <= ContainmentFactor * box.Diagonal
        ? AffineMap.Identity
        : BoundingBox.MapBoxToBox(baseBox, box);

    /// <summary>Builds the hierarchy of componentwise sums, which have no levels: an <see cref="InstanceBvh"/> groups them.</summary>
    private static LodHierarchy BuildComponentwise(Fractal fractal)
    {
        var mesh = fractal.BaseMesh;
        var maps = mesh.FaceCount == 0 ? [] : FractalGenerator.Expand(fractal, FractalLimits.ComponentwiseSums.Value);
        var bvh = new InstanceBvh(mesh.Bounds, [.. maps]);
        return new(new(bvh.Nodes, [new(0, bvh.Nodes.Length, 0, bvh.Nodes.Length)]), bvh.RootIndex, mesh);
    }
}
