using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// Computes the bounding box of a fractal without expanding it.
/// </summary>
/// <remarks>
/// Maps that keep boxes axis-aligned have exact boxes level by level. For others the farthest point along each axis is searched for in the
/// <see cref="FractalHierarchy"/>, best bound first. The box is exact to 1e-12 of the fractal's size in nearly all cases. Where a search
/// would visit more than <see cref="MaxSearchedNodes"/> sub-fractals it stops and returns the bound that it has, which holds the fractal
/// but may be wider. Infinite fractals are bounded by their limit. The box is not finite where the maps grow beyond a double.
/// </remarks>
public static class FractalBounds
{
    private const int MaxSearchedNodes = 20_000;
    private const long MaxEnumeratedVertices = 10_000_000;
    private const double RelativeTolerance = 1e-13;

    /// <summary>Computes a box that holds all instances of a fractal, in its own frame.</summary>
    public static BoundingBox ComputeBox(Fractal fractal) => fractal switch
    {
        { Description.Parts.IsEmpty: false } => ComputeBoxOfParts(fractal),
        { BaseMesh.VertexCount: 0 } => BoundingBox.Empty,
        _ when FractalSteps.CountUpTo(fractal.Description.Steps, 1).IsZero => BoundingBox.Empty,
        { Description.Composition: Composition.Componentwise } => ComputeComponentwiseBox(fractal),
        _ when LevelBoxes.AreExact(fractal.Description.Steps) => LevelBoxes.ComputeBox(fractal),
        _ when FindWideSet(fractal) is { } index => ComputeEnumeratedBox(fractal, index),
        _ => ComputeAffineBox(fractal),
    };

    /// <summary>
    /// Finds the only level with more than one map of a fractal that is one wide set, perhaps under placements; null for others. To search
    /// its hierarchy would cost a hundred times the memory of its maps.
    /// </summary>
    private static int? FindWideSet(Fractal fractal)
    {
        var steps = LevelsOf(fractal);
        var wide = steps.Select((step, index) => (Set: step as TransformationSet, Index: index))
            .Where(static level => level.Set is not { Maps.Length: 1 }).ToArray();
        return wide is [{ Set.Maps.Length: > SubFractal.MaxUngroupedChildren and var count, Index: var index }]
            && (long)count * fractal.BaseMesh.VertexCount <= MaxEnumeratedVertices
                ? index
                : null;
    }

    /// <summary>The steps of a fractal, without repetitions that say a thing once.</summary>
    private static FractalStep[] LevelsOf(Fractal fractal) =>
        [.. fractal.Description.Steps.SelectMany(static step => step is Repetition { Count: 1 } once ? once.Round : [step])];

    private static BoundingBox ComputeEnumeratedBox(Fractal fractal, int wideIndex)
    {
        var steps = LevelsOf(fractal);
        var outer = steps[..wideIndex].Aggregate(AffineMap.Identity, static (map, step) => map * ((TransformationSet)step).Maps[0]);
        var inner = steps[(wideIndex + 1)..].Aggregate(AffineMap.Identity, static (map, step) => map * ((TransformationSet)step).Maps[0]);
        return ((TransformationSet)steps[wideIndex]).Maps.Select(map => fractal.BaseMesh.ComputeBounds(outer * map * inner))
            .Aggregate(BoundingBox.Empty, BoundingBox.Union);
    }

    private static BoundingBox ComputeAffineBox(Fractal fractal)
    {
        try
        {
            return ComputeBox(fractal.Hierarchy);
        }
        catch (Exception exception) when (exception is FractalLimitException or SingularMatrixException)
        {
            // There is no hierarchy where maps flatten space, or where too many levels don't shrink.
            return LevelBoxes.ComputeBox(fractal);
        }
    }

    /// <summary>Computes the box of a fractal of several parts; all of space where it has no bounds.</summary>
    private static BoundingBox ComputeBoxOfParts(Fractal fractal)
    {
        try
        {
            return fractal.Hierarchy.Root.Box.IsEmpty ? BoundingBox.Empty : ComputeBox(fractal.Hierarchy);
        }
        catch (Exception exception) when (exception is FractalLimitException or SingularMatrixException)
        {
            return SphereAndBox.Unbounded.Box;
        }
    }

    /// <summary>Computes a box that holds a fractal, perhaps of several recursives, that is not empty.</summary>
    internal static BoundingBox ComputeBox(FractalHierarchy hierarchy)
    {
        var search = new FarthestPointSearch(hierarchy);
        return new(
            new(0 - Support(-Vector.I), 0 - Support(-Vector.J), 0 - Support(-Vector.K)),
            new(Support(Vector.I), Support(Vector.J), Support(Vector.K)));

        double Support(Vector direction) =>
            search.Run(AffineMap.Identity, new SupportMeasure(direction), RelativeTolerance, MaxSearchedNodes);
    }

    /// <summary>Measures how far points reach in a direction.</summary>
    private readonly struct SupportMeasure(Vector direction) : IPointMeasure
    {
        public double UpperBound(SubFractal subFractal, in AffineMap map) => subFractal.SupportBound(in map, direction);

        public double MaxOverVertices(Mesh mesh, in AffineMap map)
        {
            var local = map.Linear.Transpose() * direction;
            var support = double.NegativeInfinity;
            for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
            {
                support = Math.Max(support, Vector.Dot(local, mesh.Vertex(vertex)));
            }

            return support + Vector.Dot(direction, map.Translation);
        }

        public (Vector Direction, double Offset)? Key(in AffineMap map) =>
            (map.Linear.Transpose() * direction, Vector.Dot(direction, map.Translation));
    }

    /// <summary>Computes the box of all vertices of the enumerated sums where they are few, else a box that may be wider.</summary>
    private static BoundingBox ComputeComponentwiseBox(Fractal fractal)
    {
        var mesh = fractal.BaseMesh;
        return FractalSteps.HasAtMostInstances(fractal.Description.Steps, MaxEnumeratedVertices / mesh.VertexCount)
            ? FractalGenerator.Expand(fractal, MaxEnumeratedVertices).Aggregate(
                BoundingBox.Empty, (box, map) => BoundingBox.Union(box, mesh.ComputeBounds(map)))
            : ComputeSummedBox(fractal);
    }

    /// <summary>
    /// Computes the box of the summed positions, widened by the base mesh's farthest vertex under the largest product of scales.
    /// </summary>
    private static BoundingBox ComputeSummedBox(Fractal fractal)
    {
        var minimum = Vector.Zero;
        var maximum = Vector.Zero;
        var scale = 1.0;
        for (var level = 0L; level < fractal.LevelCount; level++)
        {
            var set = fractal.LevelAt(level).Transformations;
            minimum += set.Select(transformation => transformation.Position).Aggregate(Vector.Min);
            maximum += set.Select(transformation => transformation.Position).Aggregate(Vector.Max);
            scale *= set.Max(transformation => transformation.Scale.MaxAbsComponent());
        }

        var padding = scale * fractal.BaseMesh.Radius(AffineMap.Identity) * Vector.One;
        return fractal.LevelCount is null
            ? new(double.NegativeInfinity * Vector.One, double.PositiveInfinity * Vector.One)
            : new(minimum - padding, maximum + padding);
    }
}
