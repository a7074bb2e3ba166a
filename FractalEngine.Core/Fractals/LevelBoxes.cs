using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// Bounds the levels of a fractal one after another, from the base mesh outwards, by a box and a sphere. The boxes are exact where all maps
/// keep boxes axis-aligned; elsewhere they grow with each level, and the <see cref="FractalHierarchy"/> bounds better.
/// </summary>
/// <param name="mesh">The base mesh.</param>
/// <param name="maxRounds">Maximum number of rounds of a repetition; those of an infinite one are never more than 100,000.</param>
internal sealed class LevelBoxes(Mesh mesh, int maxRounds = int.MaxValue)
{
    private const int MaxInfiniteRounds = 100_000;

    private const double ConvergenceTolerance = 1e-15;

    /// <summary>Bounds of the levels so far; all of space where they don't converge, or leave the range of a double.</summary>
    public SphereAndBox Volume { get; private set; } = SphereAndBox.FromMesh(mesh);

    /// <summary>Tells whether all maps of some steps keep boxes axis-aligned.</summary>
    public static bool AreExact(ImmutableArray<FractalStep> steps) => steps.All(step => step is Repetition repetition
        ? AreExact(repetition.Round)
        : ((TransformationSet)step).Maps.All(map => map.Linear.KeepsBoxesAxisAligned()));

    /// <summary>Computes the box of a fractal in affine composition; all of space where it has no bounds.</summary>
    public static BoundingBox ComputeBox(Fractal fractal)
    {
        var boxes = new LevelBoxes(fractal.BaseMesh);
        _ = boxes.Ascend(fractal.Description.Steps).LastOrDefault();
        return boxes.Volume.Box;
    }

    /// <summary>
    /// Lists the sets of some steps, the innermost first. While a set is listed, <see cref="Volume"/> bounds the level below it. The rounds
    /// of a repetition end once they no longer change it.
    /// </summary>
    /// <remarks>Cost: one step for each map and level.</remarks>
    public IEnumerable<TransformationSet> Ascend(ImmutableArray<FractalStep> steps) => steps.Reverse().SelectMany(step => step switch
    {
        TransformationSet set => AscendSet(set),
        Repetition repetition => AscendRepetition(repetition),
        _ => throw new ArgumentException($"{step.GetType().Name} is no step of a fractal", nameof(steps)),
    });

    private IEnumerable<TransformationSet> AscendSet(TransformationSet set)
    {
        yield return set;
        var volume = Volume.UnionOfTransformed(set.Maps.AsSpan());
        Volume = volume.IsFinite() ? volume : SphereAndBox.Unbounded;
    }

    private IEnumerable<TransformationSet> AscendRepetition(Repetition repetition)
    {
        var count = repetition.Count ?? int.MaxValue;
        var roundCount = Math.Min(count, Math.Min(maxRounds, repetition.Count is null ? MaxInfiniteRounds : int.MaxValue));
        var checkpoint = Volume;
        for (var round = 0; round < roundCount; round++)
        {
            var previous = Volume;
            checkpoint = BitOperations.IsPow2(round) ? previous : checkpoint;
            foreach (var set in Ascend(repetition.Round))
            {
                yield return set;
            }

            // Under mirrors, last digits may change without end, and come back to those of a checkpoint (cycles by R. Brent, 1980).
            var tolerance = ConvergenceTolerance * Volume.Box.Size.MaxAbsComponent();
            if (!Volume.IsFinite() || Change(previous, Volume) <= tolerance || (repetition.Count is null
                && Change(checkpoint, Volume) <= tolerance
                && Change(previous, Volume) <= RoundingErrors.Chain * Volume.Box.MaxAbsCoordinate()))
            {
                yield break;
            }
        }

        Volume = roundCount < count ? SphereAndBox.Unbounded : Volume;
    }

    private static double Change(in SphereAndBox previous, in SphereAndBox current)
    {
        var minimumChange = (previous.Box.Minimum - current.Box.Minimum).MaxAbsComponent();
        var maximumChange = (previous.Box.Maximum - current.Box.Maximum).MaxAbsComponent();
        var radiusChange = Math.Abs(previous.Sphere.Radius - current.Sphere.Radius);
        return Math.Max(radiusChange, Math.Max(minimumChange, maximumChange));
    }
}
