using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Prepares sub-fractals for searches from their bounds, while a <see cref="FractalHierarchy"/> is built.</summary>
/// <param name="baseMeshes">The base meshes.</param>
/// <param name="hasOnlySimilarities">True when all maps of the fractal are similarities.</param>
internal sealed class SubFractalFactory(Mesh[] baseMeshes, bool hasOnlySimilarities)
{
    // A hull that fills its box bounds no better than the box.
    private const double MaxHullFillRatio = 0.95;

    // A hull that fills all of its box is the box.
    private const double MaxSolidFillRatio = 1 - 1e-6;

    /// <summary>The bounds of the base meshes.</summary>
    public BoundingVolume[] BaseVolumes { get; } = Array.ConvertAll(baseMeshes, BoundingVolume.FromMesh);

    /// <summary>Creates a sub-fractal without levels: a base mesh.</summary>
    /// <param name="baseIndex">Its index.</param>
    public SubFractal CreateBase(int baseIndex)
    {
        var volume = BaseVolumes[baseIndex];
        return new(
            set: null, children: [], childBoxes: [], childHull: null, volume.Box, baseBox: volume.Box, CreateHullBound(volume),
            CreateSolid(volume), clusters: null, hasOnlySimilarities, baseIndex);
    }

    /// <summary>Creates the sub-fractal of a level.</summary>
    /// <param name="set">The set of the level.</param>
    /// <param name="children">The children.</param>
    /// <param name="childVolumes">The bounds of the children, in their frames.</param>
    /// <param name="volume">The bounds of the sub-fractal.</param>
    /// <param name="baseIndex">See <see cref="SubFractal.BaseIndex"/>.</param>
    public SubFractal Create(
        MapSet set, ChildInstance[] children, BoundingVolume[] childVolumes, BoundingVolume volume, int baseIndex)
    {
        var baseBox = BaseVolumes[baseIndex].Box;
        BoundingBox[] childBoxes =
            [.. children.Zip(childVolumes, (child, bounds) => bounds.TransformedBox(child.Map, child.OperatorNormBound))];
        var childHull = childVolumes.Length > 0 ? CreateHullBound(childVolumes[0]) : null;
        if (children.Length > SubFractal.MaxUngroupedChildren)
        {
            var parentBox = BoundingBox.Union(volume.Box, baseBox);
            (children, childBoxes) = ChildGroups.Create(set, children, childBoxes, parentBox, childHull, hasOnlySimilarities, baseIndex);
            childHull = null;
        }

        return new(
            set, children, childBoxes, childHull, volume.Box, baseBox, CreateHullBound(volume), CreateSolid(volume),
            CreateClusters(volume), hasOnlySimilarities, baseIndex);
    }

    private static ClusterBounds? CreateClusters(BoundingVolume volume) => volume.Clusters.Length > 1 ? new(volume.Clusters) : null;

    private static ConvexSolid? CreateSolid(BoundingVolume volume) => volume switch
    {
        { Box.IsEmpty: true } => null,
        { Hull: { } hull } when !FillsBox(volume, MaxSolidFillRatio) => new(hull.Vertices.AsSpan(), volume.Margin),
        _ => ConvexSolid.FromBox(volume.Box),
    };

    /// <summary>Tells whether a hull fills more than a part of its box; a flat one fills none.</summary>
    private static bool FillsBox(BoundingVolume volume, double ratio)
    {
        var (x, y, z) = volume.Box.Size;
        return volume.Hull!.Volume() > ratio * x * y * z;
    }

    private HullBound? CreateHullBound(BoundingVolume volume) => volume.Hull is null || FillsBox(volume, MaxHullFillRatio)
        ? null
        : new(volume.Hull, volume.Box, volume.Margin, includeAxisPlanes: !hasOnlySimilarities);
}
