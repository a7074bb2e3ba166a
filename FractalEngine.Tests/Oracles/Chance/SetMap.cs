using FractalEngine.Core.Maths;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>A map of a set, with the steps that it is made of.</summary>
/// <param name="steps">Maps that are composed, the outermost first.</param>
/// <param name="isProduct">Whether it is written as a power or a product.</param>
internal sealed class SetMap(RowMap[] steps, bool isProduct = false)
{
    public static SetMap Identity { get; } = new([]);

    /// <summary>The maps that are composed, the outermost first.</summary>
    public ReadOnlySpan<RowMap> Steps => steps;

    /// <summary>Whether the map changes nothing, but for rounding.</summary>
    public bool IsIdentity
    {
        get
        {
            var map = steps.Aggregate(RowMap.Identity, static (map, step) => map.After(step)).ToAffineMap();
            return ((ReadOnlySpan<Vector>)[Vector.Zero, Vector.I, Vector.J, Vector.K]).ToArray()
                .All(v => ((map * v) - v).Length() < 1e-13);
        }
    }

    /// <summary>The largest factor by which the map lengthens a vector.</summary>
    public double Stretch { get; } = LargestSingularValue(steps.Aggregate(RowMap.Identity, static (map, step) => map.After(step)));

    /// <summary>Makes all maps of a product: for each choice of exponents, that of the last factor changing first.</summary>
    public static IEnumerable<SetMap> AllOf(MapProduct product) => product.Factors
        .Aggregate(
            (IEnumerable<RowMap[]>)[[]],
            static (all, factor) => [.. all.SelectMany(first => Powers(factor).Select(power => (RowMap[])[.. first, .. power]))])
        .Select(steps => new SetMap(steps, product.Factors is not [(_, 1, 1)]));

    /// <summary>
    /// The text of the map, equal for equal ones. Powers and products count as other ones than maps as they are declared.
    /// </summary>
    public override string ToString() => (isProduct ? "product " : "")
        + steps.Aggregate(RowMap.Identity, static (map, step) => map.After(step)).ToAffineMap().ToString();

    private static IEnumerable<RowMap[]> Powers(MapPower power)
    {
        var forward = RowMap.Of(power.Leaf);
        for (var exponent = power.Low; exponent <= power.High; exponent++)
        {
            yield return [.. Enumerable.Repeat(exponent < 0 ? forward.Inverse() : forward, Math.Abs(exponent))];
        }
    }

    /// <summary>Turns the columns of the map until they are orthogonal (one-sided Jacobi); the longest one is the answer.</summary>
    private static double LargestSingularValue(RowMap map)
    {
        var origin = map.Translation;
        Vector[] columns = [map.Apply(Vector.I) - origin, map.Apply(Vector.J) - origin, map.Apply(Vector.K) - origin];
        for (var sweep = 0; sweep < 30; sweep++)
        {
            foreach (var (i, j) in (ReadOnlySpan<(int, int)>)[(0, 1), (0, 2), (1, 2)])
            {
                var (a, b) = (columns[i], columns[j]);
                var angle = 0.5 * Math.Atan2(2 * Vector.Dot(a, b), a.LengthSquared() - b.LengthSquared());
                var (sin, cos) = Math.SinCos(angle);
                (columns[i], columns[j]) = ((cos * a) + (sin * b), (cos * b) - (sin * a));
            }
        }

        return columns.Max(static column => column.Length());
    }
}
