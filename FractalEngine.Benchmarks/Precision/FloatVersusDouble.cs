using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Geometry.Triangles;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Benchmarks.Precision;

/// <summary>
/// What would floats save, and what would they cost? Distances from one triangle after the other, and from eight boxes at once, are
/// computed in float and in double, and compared with rational arithmetic. All coordinates are floats, so that nothing is lost before the
/// first operation.
/// </summary>
internal static class FloatVersusDouble
{
    /// <summary>Number of triangles in a set.</summary>
    public const int CaseCount = 1024;

    private const int BoxesPerGroup = 8;

    private static double _sink;

    /// <summary>Sets of triangles: their offset from the origin and their width, both in sizes of a triangle.</summary>
    public static (string Name, double Offset, double Width)[] CoordinateSets { get; } =
        [("near the origin", 0, 1), ("1000 sizes away", 1000, 1), ("thin", 0, 1e-3)];

    /// <summary>Measures and writes all rows of the table.</summary>
    public static void Write(TableOptions options)
    {
        var measured = CoordinateSets.SelectMany(set => new[]
            {
                MeasureTriangles<float>(set), MeasureTriangles<double>(set), MeasureEngineKernel(set),
            })
            .Concat(CoordinateSets[..2].SelectMany(set => new[] { MeasureEightBoxes<float>(set), MeasureEightBoxes<double>(set) }))
            .ToArray();
        var times = InterleavedTiming.MeasureBestSeconds([.. measured.Select(item => item.Run)], 20 * options.Rounds);
        var table = options.CreateTable("float-double.csv", "test", "coordinates", "type", "ns", "worst_error_of_distance",
            "above_the_truth_percent");
        foreach (var (item, seconds) in measured.Zip(times))
        {
            table.Add(item.Test, item.Coordinates, item.Type, Math.Round(1e9 * seconds / CaseCount, 3), item.WorstError,
                Math.Round(item.PercentAboveExact, 2));
        }

        table.Save();
    }

    /// <summary>Measures the distance of each position from its triangle, by the generic kernel.</summary>
    public static Measurement MeasureTriangles<T>((string Name, double Offset, double Width) set)
        where T : struct, IFloatingPointIeee754<T>
    {
        var random = new Random(1);
        var triangles = Enumerable.Range(0, CaseCount).Select(_ => RandomTriangle(random, set.Offset, set.Width)).ToArray();
        var converted = triangles
            .Select(face => (P: ToTriple<T>(face.P), A: ToTriple<T>(face.A), B: ToTriple<T>(face.B), C: ToTriple<T>(face.C))).ToArray();
        var (worst, above) = ComputeErrors(converted.Zip(triangles, (face, original) => (
            double.CreateChecked(GenericTriangleKernel<T>.DistanceSquared(face.P, face.A, face.B, face.C)),
            ExactDistance.SquaredToTriangle(original.P, original.A, original.B, original.C))));
        return new("face", set.Name, typeof(T).Name, () => Sum(converted), worst, above);
    }

    /// <summary>Measures the engine's own kernel, which also finds the point, its barycentrics and the feature.</summary>
    public static Measurement MeasureEngineKernel((string Name, double Offset, double Width) set)
    {
        var random = new Random(1);
        var triangles = Enumerable.Range(0, CaseCount).Select(_ => RandomTriangle(random, set.Offset, set.Width)).ToArray();
        var (worst, above) = ComputeErrors(triangles.Select(face => (
            TriangleKernel.ClosestPoint(face.P, face.A, face.B, face.C).DistanceSquared,
            ExactDistance.SquaredToTriangle(face.P, face.A, face.B, face.C))));
        return new("face, the engine's kernel", set.Name, "Double", () => Sum(triangles), worst, above);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private static void Sum((Vector P, Vector A, Vector B, Vector C)[] faces)
    {
        var sum = 0.0;
        foreach (var (p, a, b, c) in faces)
        {
            sum += TriangleKernel.ClosestPoint(p, a, b, c).DistanceSquared;
        }

        _sink = sum;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private static void Sum<T>(
        (GenericTriangleKernel<T>.Triple P, GenericTriangleKernel<T>.Triple A, GenericTriangleKernel<T>.Triple B,
            GenericTriangleKernel<T>.Triple C)[] faces)
        where T : struct, IFloatingPointIeee754<T>
    {
        var sum = T.Zero;
        foreach (var (p, a, b, c) in faces)
        {
            sum += GenericTriangleKernel<T>.DistanceSquared(p, a, b, c);
        }

        _sink = double.CreateChecked(sum);
    }

    private static Measurement MeasureEightBoxes<T>((string Name, double Offset, double Width) set)
        where T : struct, IFloatingPointIeee754<T>
    {
        var random = new Random(1);
        var boxes = Enumerable.Range(0, CaseCount * BoxesPerGroup)
            .Select(_ => (Low: RandomPoint(random, set.Offset, 1), Size: RandomPoint(random, 0.5, 0.5)))
            .Select(box => (box.Low, High: RoundToSingle(box.Low + box.Size))).ToArray();
        var positions = Enumerable.Range(0, CaseCount).Select(_ => RandomPoint(random, set.Offset, 2)).ToArray();
        // A group of eight has its eight lowest x first, then the lowest y and z, then the highest x, y and z.
        Func<(Vector Low, Vector High), double>[] coordinates =
        [
            box => box.Low.X, box => box.Low.Y, box => box.Low.Z, box => box.High.X, box => box.High.Y, box => box.High.Z,
        ];
        var numbers = boxes.Chunk(BoxesPerGroup).SelectMany(group => coordinates.SelectMany(group.Select))
            .Select(T.CreateChecked).ToArray();
        var triples = positions.Select(ToTriple<T>).ToArray();
        var results = new T[CaseCount * BoxesPerGroup];
        ComputeBoxDistances(triples, numbers, results);
        var (worst, above) = ComputeErrors(results.Select((result, i) => (
            double.CreateChecked(result),
            ExactDistance.SquaredToBox(positions[i / BoxesPerGroup], boxes[i].Low, boxes[i].High))));
        return new("8 boxes", set.Name, typeof(T).Name, () => ComputeBoxDistances(triples, numbers, results), worst, above);
    }

    /// <summary>
    /// Computes the squared distances of each position from its eight boxes: one register of 256 bits in floats, two in doubles.
    /// </summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    private static void ComputeBoxDistances<T>(GenericTriangleKernel<T>.Triple[] positions, T[] numbers, T[] results)
        where T : struct, IFloatingPointIeee754<T>
    {
        for (var i = 0; i < positions.Length; i++)
        {
            var (x, y, z) = (Vector256.Create(positions[i].X), Vector256.Create(positions[i].Y), Vector256.Create(positions[i].Z));
            for (var lane = 0; lane < BoxesPerGroup; lane += Vector256<T>.Count)
            {
                var group = numbers.AsSpan((i * 6 * BoxesPerGroup) + lane, (5 * BoxesPerGroup) + Vector256<T>.Count);
                var dx = DistanceOutside(x, group, 0);
                var dy = DistanceOutside(y, group, 1);
                var dz = DistanceOutside(z, group, 2);
                ((dx * dx) + (dy * dy) + (dz * dz)).CopyTo(results.AsSpan((i * BoxesPerGroup) + lane));
            }
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<T> DistanceOutside<T>(Vector256<T> p, ReadOnlySpan<T> group, int axis) => Vector256.Max(
        Vector256.Max(Vector256.Create(group[(axis * BoxesPerGroup)..]) - p, p - Vector256.Create(group[((axis + 3) * BoxesPerGroup)..])),
        Vector256<T>.Zero);

    /// <summary>
    /// Computes the worst error of the distance, and the percent that are greater than the true one, which a lower bound must not be.
    /// </summary>
    private static (double Worst, double Above) ComputeErrors(IEnumerable<(double Squared, Rational Exact)> results)
    {
        var errors = results.Select(pair => ErrorOfDistance(pair.Squared, pair.Exact)).ToArray();
        return (errors.Max(Math.Abs), 100.0 * errors.Count(error => error > 0) / errors.Length);
    }

    private static double ErrorOfDistance(double squared, Rational exact)
    {
        var difference = (Rational.Of(squared) - exact).ToDouble();
        return difference == 0 ? 0 : difference / (Math.Sqrt(squared) + Math.Sqrt(exact.ToDouble()));
    }

    /// <summary>
    /// Creates a triangle of size 1, or one as narrow as asked for, and a position up to 1 from its first vertex along each axis.
    /// </summary>
    private static (Vector P, Vector A, Vector B, Vector C) RandomTriangle(Random random, double offset, double width)
    {
        var a = RandomPoint(random, offset, 1);
        var along = RandomPoint(random, 0, 1);
        return (RoundToSingle(a + RandomPoint(random, 0, 1)), a, RoundToSingle(a + along),
            RoundToSingle(a + (width < 1 ? random.NextDouble() : 0) * along + (width * RandomPoint(random, 0, 1))));
    }

    private static Vector RandomPoint(Random random, double centre, double halfExtent) =>
        RoundToSingle(QueryPositions.Uniform(random, new((centre - halfExtent) * Vector.One, (centre + halfExtent) * Vector.One)));

    private static Vector RoundToSingle(Vector v) => new((float)v.X, (float)v.Y, (float)v.Z);

    private static GenericTriangleKernel<T>.Triple ToTriple<T>(Vector v)
        where T : struct, IFloatingPointIeee754<T> => new(T.CreateChecked(v.X), T.CreateChecked(v.Y), T.CreateChecked(v.Z));

    /// <summary>A kernel on a set, and its errors.</summary>
    /// <param name="Test">Name of the kernel.</param>
    /// <param name="Coordinates">Name of the set.</param>
    /// <param name="Type">Name of the type of the numbers.</param>
    /// <param name="Run">Runs the kernel on all cases of the set.</param>
    /// <param name="WorstError">Largest error of the distance, as a fraction of a triangle's size.</param>
    /// <param name="PercentAboveExact">Percent of the distances that are greater than the true ones.</param>
    internal sealed record Measurement(
        string Test, string Coordinates, string Type, Action Run, double WorstError, double PercentAboveExact);
}
