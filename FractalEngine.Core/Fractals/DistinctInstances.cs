using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using BigInteger = System.Numerics.BigInteger;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// Counts the distinct instances of a fractal. The identity in a set, and some sets without it, produce the same instance over and over.
/// </summary>
/// <remarks>Whether a given fractal does so is undecidable in general, so the number is proved, enumerated, or unknown.</remarks>
public static class DistinctInstances
{
    // A proof visits every round until the boxes converge: those of sponges do so at once, others within a hundred rounds.
    private const int MaxProvedRounds = 1500;

    // Numbers of deeper fractals have thousands of digits.
    internal const int MaxCountedLevels = 1000;

    /// <summary>Number of places whose enumeration takes no more than some tenths of a second.</summary>
    public const long MaxCountedPlaces = 50_000;

    // Images that touch overlap by the rounding of their coordinates.
    private const double TouchTolerance = 64 * 2.220446049250313e-16;

    /// <summary>Counts the distinct instances of a fractal.</summary>
    /// <param name="fractal">Fractal of any composition and depth.</param>
    /// <param name="budget">
    /// Maximum number of chains that are expanded, and where there are more, of distinct instances of a level; null for
    /// <see cref="FractalLimits.CountedInstances"/> and <see cref="FractalLimits.EnumeratedInstances"/>.
    /// </param>
    /// <returns>The exact number; null for an infinite fractal, or if there are too many to enumerate and no proof succeeds.</returns>
    public static BigInteger? Count(Fractal fractal, long? budget = null)
    {
        if (fractal.Description.IsInfinite)
        {
            return null;
        }

        if (fractal.Description.CountsWays)
        {
            return fractal.CountRange(budget)?.Exact;
        }

        var maxInstances = budget ?? FractalLimits.EnumeratedInstances.Value;
        var maxChains = budget ?? FractalLimits.CountedInstances.Value;
        if (AreProvedDistinct(fractal))
        {
            return fractal.InstanceCount;
        }

        try
        {
            return fractal.Description.Composition == Composition.Affine
                && fractal.Description.Counts.HasAtMostInstances(maxChains)
                ? fractal.ByMesh.Sum(part => (long)FractalGenerator.Expand(part, maxChains).Length)
                : fractal.ByMesh.Sum(part => (long)FractalGenerator.ExpandDistinct(part, maxInstances).Length);
        }
        catch (FractalLimitException)
        {
            // More instances than are enumerated: their number is unknown.
            return null;
        }
    }

    /// <summary>
    /// Finds an upper bound of the number of distinct instances, soon: those that no identity in a set repeats. It is exact where nothing
    /// else coincides, and where so few are left that they are expanded.
    /// </summary>
    /// <param name="fractal">Fractal of any composition and depth.</param>
    /// <param name="budget">Maximum number of instances that are expanded.</param>
    /// <returns>At most the number of chains; null for an infinite fractal.</returns>
    public static BigInteger? CountAtMost(Fractal fractal, long budget = 1000)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        if (fractal.Description.CountsWays)
        {
            return fractal.CountRange(Math.Max(budget, MaxCountedPlaces)) is { } range ? range.Exact ?? range.Most : fractal.InstanceCount;
        }

        if (fractal.InstanceCount is not { } chains)
        {
            return null;
        }

        // What calls itself without end may leave no instance of one mesh.
        var count = fractal.Description.IsInfinite ? chains : CountWithoutIdentities(fractal) ?? chains;
        return count <= budget ? Count(fractal, budget) ?? count : count;
    }

    private static BigInteger? CountWithoutIdentities(Fractal fractal)
    {
        if (fractal.Description.Composition != Composition.Affine || !(fractal.LevelCount <= MaxCountedLevels))
        {
            return null;
        }

        try
        {
            return new InstanceCounts(fractal.Hierarchy, index => fractal.CountsMesh(index) ? 1 : 0).SumAt(fractal.Hierarchy.Levels);
        }
        catch (Exception exception) when (exception is FractalLimitException or SingularMatrixException)
        {
            // Without a hierarchy, only chains are known.
            return null;
        }
    }

    /// <summary>
    /// Tests whether different chains certainly give different instances. False proves nothing.
    /// </summary>
    /// <remarks>
    /// At every level the images of the next level's box must lie side by side: equal instances would lie in the overlap of two images.
    /// Boxes are exact bounds for maps that scale and permute the axes (scales, mirrors, quarter turns), so only those are tested. Images
    /// that touch may overlap by rounding along an axis where no instance is as thin as that, and must be apart along others. Once the
    /// boxes have converged, images are taken to touch on all levels above as they do there.
    /// </remarks>
    public static bool AreProvedDistinct(Fractal fractal)
    {
        if (fractal.Description is not { Composition: Composition.Affine, Parts.IsEmpty: true } || fractal.LevelCount is null
            || fractal.BaseMesh.FaceCount == 0)
        {
            return false;
        }

        var boxes = new LevelBoxes(fractal.BaseMesh, MaxProvedRounds);
        var thinnest = fractal.BaseMesh.UsedBounds.Size;
        foreach (var set in boxes.Ascend(fractal.Description.Steps))
        {
            if (set.Maps.IsEmpty || !set.Maps.All(map => map.Linear.IsScaledAxisPermutation()))
            {
                return false;
            }

            var size = thinnest;
            thinnest = set.Maps.Select(map => map.Linear.Absolute() * size).Aggregate(Vector.Min);
            if (!HasDisjointImages(set, boxes.Volume.Box, thinnest))
            {
                return false;
            }
        }

        return boxes.Volume.IsFinite();
    }

    /// <summary>Tests whether all images of a box lie side by side, in O(n log n) for n images that hardly overlap.</summary>
    /// <param name="set">The maps.</param>
    /// <param name="box">The box.</param>
    /// <param name="thinnest">Along each axis, the size of the thinnest instance in an image.</param>
    internal static bool HasDisjointImages(TransformationSet set, BoundingBox box, Vector thinnest)
    {
        BoundingBox[] images = [.. set.Maps.Select(box.Transform)];
        if (images.Length <= 1)
        {
            return true;
        }

        // Images that overlap by no more than rounding become disjoint, or those that are not apart by more than that overlap.
        var whole = images.Aggregate(BoundingBox.Union);
        var rounding = TouchTolerance * Math.Max(whole.Minimum.MaxAbsComponent(), whole.Maximum.MaxAbsComponent());
        var inset = new Vector(Inset(thinnest.X), Inset(thinnest.Y), Inset(thinnest.Z));
        var cores = Array.ConvertAll(images, image => new BoundingBox(image.Minimum + inset, image.Maximum - inset));
        if (!cores.All(static core => core.Minimum.IsFinite() && core.Maximum.IsFinite()))
        {
            return false;
        }

        var bvh = ObjectBvh.Build([.. cores.Select((core, index) => new ObjectBvhLeaf(index, core))]);
        return !cores.Index().Any(core => OverlapsAnother(bvh.Root, cores, core.Index));

        double Inset(double thickness) => (thickness > 4 * rounding ? 0.5 : -0.5) * rounding;
    }

    /// <summary>Tests whether a box has common points with one of a smaller index below a node.</summary>
    private static bool OverlapsAnother(ObjectBvhNode node, BoundingBox[] boxes, int index)
    {
        for (var slot = 0; slot < node.ChildCount; slot++)
        {
            if (!HaveCommonPoints(boxes[index], node.BoxOf(slot)))
            {
                continue;
            }

            if (node[slot] is ObjectBvhNode child
                ? OverlapsAnother(child, boxes, index)
                : node[slot] is ObjectBvhLeaf { Index: var other } && other < index
                    && HaveCommonPoints(boxes[index], boxes[other]))
            {
                return true;
            }
        }

        return false;
    }

    private static bool HaveCommonPoints(BoundingBox box1, BoundingBox box2) =>
        !new BoundingBox(Vector.Max(box1.Minimum, box2.Minimum), Vector.Min(box1.Maximum, box2.Maximum)).IsEmpty;
}
