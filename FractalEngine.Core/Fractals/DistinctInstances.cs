using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using BigInteger = System.Numerics.BigInteger;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// How many different instances a fractal has. The identity in a set, and some sets without it, produce the same instance over
/// and over; whether a given fractal does is undecidable in general, so the answer is proved, enumerated, or unknown.
/// </summary>
public static class DistinctInstances
{
    // A proof looks at every round until the boxes settle; sponges settle at once, others within a hundred.
    private const int MaxProvedRounds = 1000;

    /// <summary>The exact number, or null where it is unknown (infinite, or too many to enumerate and not proved).</summary>
    /// <param name="fractal">Any fractal.</param>
    /// <param name="budget">The most instances that are enumerated.</param>
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
            // The limit is the answer here: more sums than are enumerated means that their number is not known.
            return null;
        }
    }

    /// <summary>
    /// True when different chains certainly give different instances: at every level the images of what stands below lie side
    /// by side. Two equal maps would have equal images, and those would overlap entirely. False proves nothing.
    /// </summary>
    /// <remarks>
    /// Boxes are exact bounds for maps that send axes to axes (scales, mirrors, quarter turns), so the test is made for those
    /// only. Images that touch may overlap by rounding.
    /// </remarks>
    public static bool AreProvedDistinct(Fractal fractal)
    {
        if (fractal.Description.Composition != Composition.Affine || fractal.LevelCount is null || fractal.BaseMesh.FaceCount == 0)
        {
            return false;
        }

        var box = fractal.BaseMesh.Bounds;
        return AreProvedDistinct(fractal.Description.Steps, ref box);
    }

    /// <summary>Goes through the steps from the innermost; <paramref name="box"/> holds what stands below, then the whole.</summary>
    private static bool AreProvedDistinct(ImmutableArray<FractalStep> steps, ref BoundingBox box)
    {
        foreach (var step in steps.Reverse())
        {
            if (!(step switch
            {
                TransformationSet set => AreProvedDistinct(set, ref box),
                Repetition repetition => AreProvedDistinct(repetition, ref box),
                _ => throw new InvalidOperationException($"unknown step {step}"),
            }))
            {
                return false;
            }
        }

        return true;
    }

    private static bool AreProvedDistinct(Repetition repetition, ref BoundingBox box)
    {
        for (var round = 0; round < repetition.Count; round++)
        {
            var previousBox = box;
            if (round == MaxProvedRounds || !AreProvedDistinct(repetition.Body, ref box))
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

    private static bool AreProvedDistinct(TransformationSet set, ref BoundingBox box)
    {
        if (set.Maps.Length == 0 || !set.Maps.All(IsScaledAxisPermutation) || !AreDisjoint(set, box))
        {
            return false;
        }

        box = set.Maps.Select(box.Transform).Aggregate(BoundingBox.Union);
        return true;
    }

    private static bool AreNearlyEqual(BoundingBox box1, BoundingBox box2) =>
        Math.Max((box1.Minimum - box2.Minimum).MaxAbsComponent(), (box1.Maximum - box2.Maximum).MaxAbsComponent())
        <= 1e-12 * box1.Diagonal;

    private static bool IsScaledAxisPermutation(AffineMap map) =>
        HasExactlyOneNonzero(map.Linear.V1) && HasExactlyOneNonzero(map.Linear.V2) && HasExactlyOneNonzero(map.Linear.V3)
        && map.Linear.Determinant() != 0;

    private static bool HasExactlyOneNonzero(Vector v) => (v.X != 0 ? 1 : 0) + (v.Y != 0 ? 1 : 0) + (v.Z != 0 ? 1 : 0) == 1;

    private static bool AreDisjoint(TransformationSet set, BoundingBox box)
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
        var (size1, size2) = (box1.Size, box2.Size);
        return AreIntervalsDisjoint(overlap.X, size1.X, size2.X) || AreIntervalsDisjoint(overlap.Y, size1.Y, size2.Y)
            || AreIntervalsDisjoint(overlap.Z, size1.Z, size2.Z);
    }

    private static bool AreIntervalsDisjoint(double overlap, double size1, double size2) =>
        size1 > 0 && size2 > 0 && overlap <= 1e-9 * Math.Min(size1, size2);
}
