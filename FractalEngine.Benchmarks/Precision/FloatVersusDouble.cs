using FractalEngine.Core.Collision;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Benchmarks.Measuring;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Benchmarks.Precision;

/// <summary>
/// What would floats save, and what would they cost: a face's distance, one after the other, and those of eight boxes at once, in float and
/// in double, beside the same in fractions. All coordinates are floats, so nothing is lost before the first operation.
/// </summary>
internal static class FloatVersusDouble
{
    /// <summary>Faces of a set.</summary>
    public const int CaseCount = 1024;

    private const int BoxesPerGroup = 8;

    /// <summary>Where the faces are, as the offset from the origin and the width, in sizes.</summary>
    public static (string Name, double Offset, double Width)[] CoordinateSets { get; } =
        [("near the origin", 0, 1), ("1000 sizes away", 1000, 1), ("thin", 0, 1e-3)];

    /// <summary>Writes the file.</summary>
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

    /// <summary>What is known of a kernel on a set.</summary>
    internal sealed record Measurement(string Test, string Coordinates, string Type, Action Run, double WorstError,
        double PercentAboveExact);

    private static double _sink;

    /// <summary>The distance of each position from its face.</summary>
    public static Measurement MeasureTriangles<T>((string Name, double Offset, double Width) set)
        where T : struct, IFloatingPointIeee754<T>
    {
        var random = new Random(1);
        var faces = Enumerable.Range(0, CaseCount).Select(_ => RandomTriangle(random, set.Offset, set.Width)).ToArray();
        var same = faces.Select(face => (P: ToTriple<T>(face.P), A: ToTriple<T>(face.A), B: ToTriple<T>(face.B), C: ToTriple<T>(face.C)))
            .ToArray();
        var results = same.Select(face => double.CreateChecked(GenericTriangleKernel<T>.DistanceSquared(face.P, face.A, face.B, face.C)));
        var (worst, above) =
            ComputeErrors(results.Zip(faces, (result, face) => (result, ExactDistance.SquaredToTriangle(face.P, face.A, face.B, face.C))));
        return new("face", set.Name, typeof(T).Name, () => Sum(same), worst, above);
    }

    /// <summary>The engine's own, which also finds the point, its weights and the feature.</summary>
    public static Measurement MeasureEngineKernel((string Name, double Offset, double Width) set)
    {
        var random = new Random(1);
        var faces = Enumerable.Range(0, CaseCount).Select(_ => RandomTriangle(random, set.Offset, set.Width)).ToArray();
        var (worst, above) = ComputeErrors(faces.Select(
            face => (TriangleKernel.ClosestPoint(face.P, face.A, face.B, face.C).DistanceSquared,
            ExactDistance.SquaredToTriangle(face.P, face.A, face.B, face.C))));
        return new("face, the engine's kernel", set.Name, "Double", () => Sum(faces), worst, above);
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
    private static void Sum<T>((GenericTriangleKernel<T>.Triple P, GenericTriangleKernel<T>.Triple A, GenericTriangleKernel<T>.Triple B,
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
            .Select(_ => (Low: RandomPoint(random, set.Offset, 1), Size: RandomPoint(random, 0.5, 0.5))).Select(
            box => (box.Low, High: RoundToSingle(box.Low + box.Size))).ToArray();
        var positions = Enumerable.Range(0, CaseCount).Select(_ => RandomPoint(random, set.Offset, 2)).ToArray();
        // A group of eight: least x of all, then y and z, then the largest.
        var numbers = boxes.Chunk(BoxesPerGroup).SelectMany(group => new Func<(Vector Low, Vector High), double>[]
        {
            box => box.Low.X, box => box.Low.Y, box => box.Low.Z, box => box.High.X, box => box.High.Y, box => box.High.Z,
        }.SelectMany(group.Select)).Select(T.CreateChecked).ToArray();
        var triples = positions.Select(ToTriple<T>).ToArray();
        var results = new T[CaseCount * BoxesPerGroup];
        ComputeBoxDistances(triples, numbers, results);
        var (worst, above) =
            ComputeErrors(results.Select(
                (result, i) => (double.CreateChecked(result),
                ExactDistance.SquaredToBox(positions[i / BoxesPerGroup], boxes[i].Low, boxes[i].High))));
        return new("8 boxes", set.Name, typeof(T).Name, () => ComputeBoxDistances(triples, numbers, results), worst, above);
    }

    /// <summary>
    /// Squared distances of each position from its eight boxes: one group of floats, two of doubles, in registers of 256 bits.
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
    /// The worst error of the distance, and the percent that are more than the true one, which a lower bound must not be.
    /// </summary>
    private static (double Worst, double Above) ComputeErrors(IEnumerable<(double Squared, Rational Exact)> results)
    {
        var errors = results.Select(pair => (Rational.Of(pair.Squared) - pair.Exact).ToDouble() switch
        {
            0.0 => 0,
            var difference => difference / (Math.Sqrt(pair.Squared) + Math.Sqrt(pair.Exact.ToDouble())),
        }).ToArray();
        return (errors.Max(Math.Abs), 100.0 * errors.Count(error => error > 0) / errors.Length);
    }

    /// <summary>
    /// A face of size 1, or one that is as narrow as asked for, and a position up to 1 from its first corner along each axis.
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
}
