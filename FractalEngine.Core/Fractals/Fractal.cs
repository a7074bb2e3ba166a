using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Fractals;

/// <summary>A fractal: a description together with its base mesh. Counts are exact; nothing is expanded.</summary>
public sealed class Fractal
{
    private readonly Lazy<BigInteger?> _instanceCount;
    private readonly Lazy<BoundingBox> _bounds;

    /// <summary>The fractal that a description makes of a base mesh.</summary>
    public Fractal(FractalDescription description, Mesh baseMesh)
    {
        (Description, BaseMesh) = (description, baseMesh);
        _instanceCount = new(() => FractalSteps.InstanceCount(description.Steps));
        _bounds = new(() => FractalBounds.ComputeBox(this));
    }

    /// <summary>What the file says.</summary>
    public FractalDescription Description { get; }

    /// <summary>The mesh that every instance is a copy of.</summary>
    public Mesh BaseMesh { get; }

    /// <summary>How many chains of transformations there are, equal ones counted; null for infinitely many.</summary>
    public BigInteger? InstanceCount => _instanceCount.Value;

    /// <summary>Instances times faces of the base mesh (the paper's b·t^d); null for infinitely many.</summary>
    public BigInteger? FaceCount => InstanceCount * BaseMesh.FaceCount;

    /// <summary>How many sets a chain passes through; null for infinitely many.</summary>
    public long? LevelCount => FractalSteps.LevelCount(Description.Steps);

    /// <summary>A box that holds the fractal, see <see cref="FractalBounds"/> for how tight it is.</summary>
    public BoundingBox Bounds => _bounds.Value;

    /// <summary>The set at one level, 0 the outermost.</summary>
    public TransformationSet LevelAt(long level) => FractalSteps.LevelAt(Description.Steps, level);

    /// <summary>The same fractal at another depth, see <see cref="FractalDescription.WithDepth"/>.</summary>
    public Fractal WithDepth(int depth) => new(Description.WithDepth(depth), BaseMesh);

    /// <summary>
    /// The fractal itself where it has at most <paramref name="maxInstances"/> instances, else the deepest version of it that
    /// has: repetitions are cut short, the outermost first; where that is not enough, the innermost sets are left out.
    /// </summary>
    /// <param name="maxInstances">At least 1.</param>
    public Fractal WithMaxInstances(long maxInstances)
    {
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(maxInstances);
        if (Fits(Description.Steps, maxInstances))
        {
            return this;
        }

        var steps = Description.Steps;
        for (var i = 0; i < steps.Length && !Fits(steps, maxInstances); i++)
        {
            if (steps[i] is Repetition repetition)
            {
                steps = steps.SetItem(i, repetition.WithCount(MaxRepetitionCount(steps, i, repetition, maxInstances)));
            }
        }

        while (!Fits(steps, maxInstances))
        {
            steps = steps.RemoveAt(steps.Length - 1);
        }

        return new(Description with { Steps = steps }, BaseMesh);
    }

    private static bool Fits(ImmutableArray<FractalStep> steps, long maxInstances) =>
        FractalSteps.LevelCount(steps) is not null && FractalSteps.HasAtMostInstances(steps, maxInstances);

    /// <summary>The largest number of rounds with which the whole still fits; 0 where none does.</summary>
    private static int MaxRepetitionCount(ImmutableArray<FractalStep> steps, int index, Repetition repetition, long maxInstances)
    {
        var (others, perRound) =
            (FractalSteps.CountUpTo(steps.RemoveAt(index), maxInstances), FractalSteps.CountUpTo(repetition.Body, maxInstances));
        if (perRound <= 1)
        {
            return repetition.Count ?? FractalLimits.MaxDepth;
        }

        var count = 0;
        for (var total = others * perRound; total <= maxInstances && !(count >= repetition.Count); total *= perRound)
        {
            count++;
        }

        return count;
    }
}
