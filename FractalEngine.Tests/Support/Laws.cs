using FractalEngine.Core.Maths;
using FsCheck;
using FsCheck.Fluent;

namespace FractalEngine.Tests.Support;

/// <summary>Checks laws by FsCheck, on the same random inputs in every run. A failure prints them shrunk.</summary>
internal static class Laws
{
    // A fixed seed, so that a red run can be repeated. Any odd second number will do.
    private static readonly Config Replayed = Config.QuickThrowOnFailure.WithReplay(20260101, 7);

    /// <summary>Generates whole numbers up to 1000. Sums and products of a few are exact, so algebra holds to the last bit.</summary>
    public static Gen<double> Whole { get; } = Gen.Choose(-1000, 1000).Select(number => (double)number);

    public static Gen<Vector> Vectors { get; } = Whole.Three().Select(t => new Vector(t.Item1, t.Item2, t.Item3));

    public static Gen<Matrix> Matrices { get; } = Vectors.Three().Select(t => new Matrix(t.Item1, t.Item2, t.Item3));

    public static Gen<AffineMap> Maps { get; } = Matrices.Zip(Vectors, (linear, translation) => new AffineMap(linear, translation));

    /// <summary>Generates doubles of any size, ±0, subnormals and the largest among them.</summary>
    public static Gen<double> AnyFinite { get; } = Gen.OneOf(
        Gen.Elements(0.0, -0.0, double.Epsilon, -double.Epsilon, 2.2250738585072014e-308, 2.225073858507201e-308, double.MaxValue,
        double.MinValue, 1e308, 0.1, 1.0 / 3),
        Gen.Choose(int.MinValue, int.MaxValue).Two().Select(t => BitConverter.Int64BitsToDouble(((long)t.Item1 << 32) | (uint)t.Item2))
            .Where(double.IsFinite));

    public static void CheckForAll<T>(Gen<T> inputs, Func<T, bool> law, int cases = 300) =>
        Prop.ForAll(inputs.ToArbitrary(), law).Check(Replayed.WithMaxTest(cases));

    public static void CheckForAll<T>(Gen<T> inputs, Action<T> law, int cases = 300) =>
        Prop.ForAll(inputs.ToArbitrary(), law).Check(Replayed.WithMaxTest(cases));
}
