using System.Globalization;
using FractalEngine.Core.Maths;
using Xunit.Sdk;

namespace FractalEngine.Tests.Support;

/// <summary>Compares values within an absolute tolerance, which every caller gives with its reason.</summary>
internal static class Near
{
    public static double Difference(Vector v1, Vector v2) => (v1 - v2).MaxAbsComponent();

    public static double Difference(Matrix m1, Matrix m2) => (m1 + (-1 * m2)).MaxAbsEntry();

    public static double Difference(AffineMap map1, AffineMap map2) =>
        Math.Max(Difference(map1.Linear, map2.Linear), Difference(map1.Translation, map2.Translation));

    public static void Equal(double expected, double actual, double tolerance) =>
        Check(expected, actual, Math.Abs(expected - actual), tolerance);

    public static void Equal(Vector expected, Vector actual, double tolerance) =>
        Check(expected, actual, Difference(expected, actual), tolerance);

    public static void Equal(Matrix expected, Matrix actual, double tolerance) =>
        Check(expected, actual, Difference(expected, actual), tolerance);

    public static void Equal(AffineMap expected, AffineMap actual, double tolerance) =>
        Check(expected, actual, Difference(expected, actual), tolerance);

    // Written so that NaN fails, on either side or on both, and so do infinities: of these a tolerance says nothing.
    private static void Check(object expected, object actual, double difference, double tolerance)
    {
        if (!(difference <= tolerance))
        {
            throw new XunitException(string.Create(
                CultureInfo.InvariantCulture, $"expected {expected}, got {actual}: off by {difference}, allowed {tolerance}"));
        }
    }
}
