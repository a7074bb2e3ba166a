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
internal static class FloatAndDouble
{
    /// <summary>Faces of a set.</summary>
    public const int Cases = 1024;

    private const int Boxes = 8;

    /// <summary>Where the faces are, as the offset from the origin and the width, in sizes.</summary>
    public static (string Name, double Offset, double Width)[] Sets { get; } =
        [("near the origin", 0, 1), ("1000 sizes away", 1000, 1), ("thin", 0, 1e-3)];

    /// <summary>Writes the file.</summary>
    public static void Write(TableOptions options)
    {
        var measured = Sets.SelectMany(set => new[]
            {
                Faces<float>(set), Faces<double>(set), Engine(set),
            })
            .Concat(Sets[..2].SelectMany(set => new[] { EightBoxes<float>(set), EightBoxes<double>(set) })).ToArray();
        var times = TakeTurns.Best([.. measured.Select(item => item.Time)], 20 * options.Rounds);
        var table = options.Table("float-double.csv", "test", "coordinates", "type", "ns", "worst_error_of_distance",
            "above_the_truth_percent");
        foreach (var (item, seconds) in measured.Zip(times))
        {
            table.Add(item.Test, item.Coordinates, item.Type, Math.Round(1e9 * seconds / Cases, 3), item.WorstError,
                Math.Round(item.Above, 2));
        }

        table.Save();
    }

    /// <summary>What is known of a kernel on a set.</summary>
    internal sealed record Measured(string Test, string Coordinates, string Type, Action Time, double WorstError, double Above);

    private static double _sink;

    /// <summary>The distance of each position from its face.</summary>
    public static Measured Faces<T>((string Name, double Offset, double Width) set)
        where T : struct, IFloatingPointIeee754<T>
    {
        var random = new Random(1);
        var faces = Enumerable.Range(0, Cases).Select(_ => RandomFace(random, set.Offset, set.Width)).ToArray();
        var same = faces.Select(face => (P: Of<T>(face.P), A: Of<T>(face.A), B: Of<T>(face.B), C: Of<T>(face.C))).ToArray();
        var results = same.Select(face => double.CreateChecked(GenericFaceKernel<T>.DistanceSquared(face.P, face.A, face.B, face.C)));
        var (worst, above) =
            Errors(results.Zip(faces, (result, face) => (result, ExactDistance.SquaredToFace(face.P, face.A, face.B, face.C))));
        return new("face", set.Name, typeof(T).Name, () => Sum(same), worst, above);
    }

    /// <summary>The engine's own, which also finds the point, its weights and the feature.</summary>
    public static Measured Engine((string Name, double Offset, double Width) set)
    {
        var random = new Random(1);
        var faces = Enumerable.Range(0, Cases).Select(_ => RandomFace(random, set.Offset, set.Width)).ToArray();
        var (worst, above) = Errors(faces.Select(
            face => (TriangleKernel.ClosestPoint(face.P, face.A, face.B, face.C).DistanceSquared,
            ExactDistance.SquaredToFace(face.P, face.A, face.B, face.C))));
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
    private static void Sum<T>((GenericFaceKernel<T>.Triple P, GenericFaceKernel<T>.Triple A, GenericFaceKernel<T>.Triple B,
    GenericFaceKernel<T>.Triple C)[] faces)
        where T : struct, IFloatingPointIeee754<T>
    {
        var sum = T.Zero;
        foreach (var (p, a, b, c) in faces)
        {
            sum += GenericFaceKernel<T>.DistanceSquared(p, a, b, c);
        }

        _sink = double.CreateChecked(sum);
    }

    private static Measured EightBoxes<T>((string Name, double Offset, double Width) set)
        where T : struct, IFloatingPointIeee754<T>
    {
        var random = new Random(1);
        var boxes = Enumerable.Range(0, Cases * Boxes)
            .Select(_ => (Low: RandomPoint(random, set.Offset, 1), Size: RandomPoint(random, 0.5, 0.5))).Select(
            box => (box.Low, High: Single(box.Low + box.Size))).ToArray();
        var positions = Enumerable.Range(0, Cases).Select(_ => RandomPoint(random, set.Offset, 2)).ToArray();
        // A group of eight: least x of all, then y and z, then the largest.
        var numbers = boxes.Chunk(Boxes).SelectMany(group => new Func<(Vector Low, Vector High), double>[]
        {
            box => box.Low.X, box => box.Low.Y, box => box.Low.Z, box => box.High.X, box => box.High.Y, box => box.High.Z,
        }.SelectMany(group.Select)).Select(T.CreateChecked).ToArray();
        var places = positions.Select(Of<T>).ToArray();
        var results = new T[Cases * Boxes];
        BoxDistances(places, numbers, results);
        var (worst, above) =
            Errors(results.Select(
                (result, i) => (double.CreateChecked(result),
                ExactDistance.SquaredToBox(positions[i / Boxes], boxes[i].Low, boxes[i].High))));
        return new("8 boxes", set.Name, typeof(T).Name, () => BoxDistances(places, numbers, results), worst, above);
    }

    /// <summary>
    /// Squared distances of each position from its eight boxes: one group of floats, two of doubles, in registers of 256 bits.
    /// </summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    private static void BoxDistances<T>(GenericFaceKernel<T>.Triple[] positions, T[] numbers, T[] results)
        where T : struct, IFloatingPointIeee754<T>
    {
        for (var i = 0; i < positions.Length; i++)
        {
            var (x, y, z) = (Vector256.Create(positions[i].X), Vector256.Create(positions[i].Y), Vector256.Create(positions[i].Z));
            for (var lane = 0; lane < Boxes; lane += Vector256<T>.Count)
            {
                var group = numbers.AsSpan((i * 6 * Boxes) + lane, (5 * Boxes) + Vector256<T>.Count);
                var dx = Outside(x, group, 0);
                var dy = Outside(y, group, 1);
                var dz = Outside(z, group, 2);
                ((dx * dx) + (dy * dy) + (dz * dz)).CopyTo(results.AsSpan((i * Boxes) + lane));
            }
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<T> Outside<T>(Vector256<T> p, ReadOnlySpan<T> group, int axis) => Vector256.Max(
        Vector256.Max(Vector256.Create(group[(axis * Boxes)..]) - p, p - Vector256.Create(group[((axis + 3) * Boxes)..])),
        Vector256<T>.Zero);

    /// <summary>
    /// The worst error of the distance, and the percent that are more than the true one, which a lower bound must not be.
    /// </summary>
    private static (double Worst, double Above) Errors(IEnumerable<(double Squared, Rational Exact)> results)
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
    private static (Vector P, Vector A, Vector B, Vector C) RandomFace(Random random, double offset, double width)
    {
        var a = RandomPoint(random, offset, 1);
        var along = RandomPoint(random, 0, 1);
        return (Single(a + RandomPoint(random, 0, 1)), a, Single(a + along),
            Single(a + (width < 1 ? random.NextDouble() : 0) * along + (width * RandomPoint(random, 0, 1))));
    }

    private static Vector RandomPoint(Random random, double centre, double most) =>
        Single(QueryPositions.Uniform(random, new((centre - most) * Vector.One, (centre + most) * Vector.One)));

    private static Vector Single(Vector v) => new((float)v.X, (float)v.Y, (float)v.Z);

    private static GenericFaceKernel<T>.Triple Of<T>(Vector v)
        where T : struct, IFloatingPointIeee754<T> => new(T.CreateChecked(v.X), T.CreateChecked(v.Y), T.CreateChecked(v.Z));
}
