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

    /// <summary>Counts the distinct instances of a fractal.</summary>
    /// <param name="fractal">Fractal of any composition and depth.</param>
    /// <param name="budget">
    /// Maximum number of chains that are expanded, and where there are more, of distinct instances of a level; null for
    /// <see cref="FractalLimits.MaxCountedInstances"/> and <see cref="FractalLimits.MaxEnumeratedInstances"/>.
    /// </param>
    /// <returns>The exact number; null for an infinite fractal, or if there are too many to enumerate and no proof succeeds.</returns>
    public static BigInteger? Count(Fractal fractal, long? budget = null)
    {
        if (fractal.Description.IsInfinite)
        {
            return null;
        }

        var maxInstances = budget ?? FractalLimits.MaxEnumeratedInstances;
        var maxChains = budget ?? FractalLimits.MaxCountedInstances;
        if (fractal.Description.Composition == Composition.Affine)
        {
            return AreProvedDistinct(fractal) ? fractal.InstanceCount
                : FractalSteps.HasAtMostInstances(fractal.Description.Steps, maxChains)
                    ? FractalGenerator.ExpandAffine(fractal, maxChains).Length
                : FractalGenerator.TryExpandLevels(fractal, maxInstances)?.Length;
        }

        try
        {
            return FractalGenerator.ExpandComponentwise(fractal, maxInstances).Length;
        }
        catch (FractalLimitException)
        {
            // More sums than are enumerated: their number is unknown.
            return null;
        }
    }

    /// <summary>
    /// Tests whether different chains certainly give different instances. False proves nothing.
    /// </summary>
    /// <remarks>
    /// At every level the images of the next level's box must lie side by side: equal maps would have equal images, which overlap entirely.
    /// Boxes are exact bounds for maps that scale and permute the axes (scales, mirrors, quarter turns), so only those are tested. Images
    /// that touch may overlap by rounding.
    /// </remarks>
    public static bool AreProvedDistinct(Fractal fractal)
    {
        if (fractal.Description.Composition != Composition.Affine || fractal.LevelCount is null || fractal.BaseMesh.FaceCount == 0)
        {
            return false;
        }

        var boxes = new LevelBoxes(fractal.BaseMesh, MaxProvedRounds);
        return boxes.Ascend(fractal.Description.Steps).All(set => HasExactDisjointImages(set, boxes.Volume.Box)) && boxes.Volume.IsFinite();
    }

    private static bool HasExactDisjointImages(TransformationSet set, BoundingBox box) =>
        set.Maps.Length > 0 && set.Maps.All(map => map.Linear.IsScaledAxisPermutation()) && HasDisjointImages(set, box);

    /// <summary>Tests whether all images of a box lie side by side, in O(n log n) for n images that hardly overlap.</summary>
    internal static bool HasDisjointImages(TransformationSet set, BoundingBox box)
    {
        BoundingBox[] images = [.. set.Maps.Select(box.Transform)];
        if (images.Length <= 1)
        {
            return true;
        }

        var extents = ExtentsOf(images);
        var bvh = ObjectBvh.Build([.. extents.Select((extent, index) => new ObjectBvhLeaf(index, extent))]);
        for (var i = 0; i < images.Length; i++)
        {
            if (OverlapsAnother(bvh.Root, images, i, extents[i]))
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>
    /// Extends each box that is flat along an axis over the whole of that axis, where nothing counts as disjoint from it. Boxes that are
    /// not disjoint then have extents with common inner points.
    /// </summary>
    private static BoundingBox[] ExtentsOf(BoundingBox[] boxes)
    {
        var whole = boxes.Aggregate(BoundingBox.Union);
        if (whole.IsEmpty || !whole.Size.IsFinite())
        {
            // Boxes without numbers are compared with all others.
            whole = new(double.NegativeInfinity * Vector.One, double.PositiveInfinity * Vector.One);
            return [.. Enumerable.Repeat(whole, boxes.Length)];
        }

        // Wider than any box, so that flat ones have common inner points with all, and with each other.
        var margin = (1 + (1e-6 * Vector.Max(whole.Minimum.Absolute(), whole.Maximum.Absolute()).MaxAbsComponent())) * Vector.One;
        whole = new(whole.Minimum - margin, whole.Maximum + margin);
        return [.. boxes.Select(Extend)];

        BoundingBox Extend(BoundingBox box)
        {
            var (minimum, maximum) = box;
            var (width, height, depth) = box.Size;
            return new(
                new(
                    width > 0 ? minimum.X : whole.Minimum.X, height > 0 ? minimum.Y : whole.Minimum.Y,
                    depth > 0 ? minimum.Z : whole.Minimum.Z),
                new(
                    width > 0 ? maximum.X : whole.Maximum.X, height > 0 ? maximum.Y : whole.Maximum.Y,
                    depth > 0 ? maximum.Z : whole.Maximum.Z));
        }
    }

    /// <summary>Tests whether a box is not disjoint from one with a smaller index below a node.</summary>
    private static bool OverlapsAnother(ObjectBvhNode node, BoundingBox[] boxes, int index, BoundingBox extent)
    {
        for (var slot = 0; slot < node.ChildCount; slot++)
        {
            if (!HaveCommonInnerPoints(extent, node.BoxOf(slot)))
            {
                continue;
            }

            var overlaps = node[slot] is ObjectBvhNode child
                ? OverlapsAnother(child, boxes, index, extent)
                : node[slot] is ObjectBvhLeaf { Index: var other } && other < index && !AreDisjoint(boxes[index], boxes[other]);
            if (overlaps)
            {
                return true;
            }
        }

        return false;
    }

    private static bool HaveCommonInnerPoints(BoundingBox box1, BoundingBox box2) =>
        box1.Minimum.X < box2.Maximum.X && box2.Minimum.X < box1.Maximum.X
        && box1.Minimum.Y < box2.Maximum.Y && box2.Minimum.Y < box1.Maximum.Y
        && box1.Minimum.Z < box2.Maximum.Z && box2.Minimum.Z < box1.Maximum.Z;

    /// <summary>Tests whether two boxes lie side by side along an axis, where a little overlap counts as rounding.</summary>
    internal static bool AreDisjoint(BoundingBox box1, BoundingBox box2)
    {
        var overlap = Vector.Min(box1.Maximum, box2.Maximum) - Vector.Max(box1.Minimum, box2.Minimum);
        var size1 = box1.Size;
        var size2 = box2.Size;
        return AreIntervalsDisjoint(overlap.X, size1.X, size2.X) || AreIntervalsDisjoint(overlap.Y, size1.Y, size2.Y)
            || AreIntervalsDisjoint(overlap.Z, size1.Z, size2.Z);
    }

    private static bool AreIntervalsDisjoint(double overlap, double size1, double size2) =>
        size1 > 0 && size2 > 0 && overlap <= 1e-9 * Math.Min(size1, size2);
}
