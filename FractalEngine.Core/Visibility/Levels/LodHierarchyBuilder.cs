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

    // What maps flatten further has no inverse in double precision.
    private const double MinDeterminant = 1e-100;

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
        var carried = fractal.HasSeveralMeshes ? null : CarriedBases(hierarchy);
        var nodes = hierarchy.AllLevels.Select(level => BuildNode(
            level, baseBox, carried?[level] ?? (AffineMap.Identity, baseBox), hierarchy.HasPicks, means?[level]));
        return new(nodes, hierarchy.Top.Level, mesh)
        {
            HasCoveredSides = !hierarchy.HasPicks && CoveredSides.TryMark(nodes.Items, mesh),
            Source = fractal,
            HasColours = hasColours,
            HasPicks = hierarchy.HasPicks,
            ColourLevels = fractal.LevelCount ?? hierarchy.Top.Level,
        };
    }

    private static LodNode BuildNode(
        HierarchyLevel level, BoundingBox baseBox, (AffineMap Map, BoundingBox Box) carried, bool hasPicks, Tint? mean)
    {
        // A pick knows the alternatives by their numbers: none is left out, except where all are empty.
        var pick = level.Set?.Pick;
        var keepsAll = pick is not null && !level.Box.IsEmpty;
        var children = level.Edges.Zip(level.GetEdgeBoxes()).Where(child => keepsAll || !child.Second.IsEmpty);
        LodChild[] all = [.. children.Select(child => CreateChild(child.First, child.Second, hasPicks, mean is not null))];
        return new(level.Box, ComputeProxyMap(baseBox, level.Box, carried), all, level.Set?.Maps.Length ?? 0, pick)
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

    /// <summary>
    /// Composes for each level the maps under which the base mesh begins, as in <c>x. [thin.] box</c>: those of the sets of one map. Sets
    /// of several are left out, as at depth 0.
    /// </summary>
    private static Dictionary<HierarchyLevel, (AffineMap Map, BoundingBox Box)> CarriedBases(FractalHierarchy hierarchy)
    {
        Dictionary<HierarchyLevel, (AffineMap Map, BoundingBox Box)> carried = [];
        foreach (var region in hierarchy.AllLevels.Regions)
        {
            for (var level = region.FirstLevel; level - region.FirstLevel < Math.Min(region.LevelCount, region.Period); level++)
            {
                var parent = hierarchy.AllLevels.At(level);
                var remaining = level;
                var children = parent.Edges.Select(edge => (edge.Map, Level: hierarchy.AllLevels.At(edge.RemainingLevels(remaining))))
                    .Where(static child => !child.Level.Box.IsEmpty).Take(2).ToArray();
                var below = children.Length > 0 && carried.TryGetValue(children[0].Level, out var found)
                    ? found : (Map: AffineMap.Identity, parent.Box);
                var map = children.Length == 1 ? children[0].Map * below.Map : below.Map;
                // The box of a single instance is tighter than that of a box under its map.
                carried[parent] = children.Length != 1 || !(Math.Abs(map.Linear.Determinant()) > MinDeterminant) ? below
                    : (map, below.Box == children[0].Level.Box ? parent.Box : below.Box.Transform(children[0].Map));
            }
        }

        return carried;
    }

    /// <summary>Computes the map under which the base mesh is the proxy of what a box holds.</summary>
    /// <remarks>
    /// It is that under which the base mesh begins, where this lies within the box. Otherwise the maps have carried the base mesh away, and
    /// the proxy is stretched to fill the box.
    /// </remarks>
    private static AffineMap ComputeProxyMap(BoundingBox baseBox, BoundingBox box, (AffineMap Map, BoundingBox Box) carried) =>
        box.IsEmpty || BoundingBox.Union(box, carried.Box).Diagonal <= ContainmentFactor * box.Diagonal
        ? carried.Map
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
