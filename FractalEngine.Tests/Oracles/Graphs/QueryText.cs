using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Writes queries as code that repeats them.</summary>
internal static class QueryText
{
    public static string Of(Vector v) => FormattableString.Invariant($"new({v.X:R}, {v.Y:R}, {v.Z:R})");

    public static string Of(Ray ray) => $"new Ray({Of(ray.Origin)}, {Of(ray.Direction)})";
}
