using System.Collections.Immutable;
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
    private const int MaxProvedRounds = 1000;

    /// <summary>Counts the distinct instances of a fractal.</summary>
    /// <param name="fractal">Fractal of any composition and depth.</param>
    /// <param name="budget">Maximum number of instances that are enumerated.</param>
    /// <returns>The exact number; null for an infinite fractal, or if there are too many to enumerate and no proof succeeds.</returns>
    public static BigInteger? Count(Fractal fractal, long budget = FractalLimits.MaxEnumeratedInstances)
    {
        if (fractal.Description.IsInfinite)
        {
            return null;
        }

        if (fractal.Description.Composition == Composition.Affine)
        {
            return AreProvedDistinct(fractal) ? fractal.InstanceCount
                : FractalSteps.HasAtMostInstances(fractal.Description.Steps, budget) ? FractalGenerator.Expand(fractal, budget).Length
                : null;
        }

        try
        {
            return FractalGenerator.ExpandComponentwise(fractal, budget).Length;
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

        var box = fractal.BaseMesh.Bounds;
        return TryProveSteps(fractal.Description.Steps, ref box);
    }

    /// <summary>Tries to prove that the chains of some steps give distinct instances, from the innermost step outwards.</summary>
    /// <param name="steps">Steps, outermost first.</param>
    /// <param name="box">Box of the child instances; becomes that of the whole.</param>
    private static bool TryProveSteps(ImmutableArray<FractalStep> steps, ref BoundingBox box)
    {
        foreach (var step in steps.Reverse())
        {
            var isProved = step switch
            {
                TransformationSet set => TryProveSet(set, ref box),
                Repetition repetition => TryProveRepetition(repetition, ref box),
                _ => throw new InvalidOperationException($"unknown step {step}"),
            };
            if (!isProved)
            {
                return false;
            }
        }

        return true;
    }

    private static bool TryProveRepetition(Repetition repetition, ref BoundingBox box)
    {
        for (var round = 0; round < repetition.Count; round++)
        {
            var previousBox = box;
            if (round == MaxProvedRounds || !TryProveSteps(repetition.Body, ref box))
            {
                return false;
            }

            // Once the boxes no longer change, every further round is the same.
            if (AreNearlyEqual(previousBox, box))
            {
                return true;
            }
        }

        return true;
    }

    private static bool TryProveSet(TransformationSet set, ref BoundingBox box)
    {
        if (set.Maps.Length == 0 || !set.Maps.All(map => map.Linear.IsScaledAxisPermutation()) || !HasDisjointImages(set, box))
        {
            return false;
        }

        box = set.Maps.Select(box.Transform).Aggregate(BoundingBox.Union);
        return true;
    }

    private static bool AreNearlyEqual(BoundingBox box1, BoundingBox box2) =>
        Math.Max((box1.Minimum - box2.Minimum).MaxAbsComponent(), (box1.Maximum - box2.Maximum).MaxAbsComponent())
        <= 1e-12 * box1.Diagonal;

    private static bool HasDisjointImages(TransformationSet set, BoundingBox box)
    {
        var images = set.Maps.Select(box.Transform).ToArray();
        for (var i = 0; i < images.Length; i++)
        {
            for (var j = 0; j < i; j++)
            {
                if (!AreDisjoint(images[i], images[j]))
                {
                    return false;
                }
            }
        }

        return true;
    }

    private static bool AreDisjoint(BoundingBox box1, BoundingBox box2)
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
