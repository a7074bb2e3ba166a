using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Elements;

/// <summary>
/// Maps of flat elements. Where one goes does not tell what becomes of its normal; another element that is not in its plane does, once it
/// is known where that one goes.
/// </summary>
internal static class OutOfPlane
{
    private const int MaxParts = 3;
    private const double MinHeight = 0.02;

    /// <summary>Chooses elements outside of an element's plane, the first ones of a list.</summary>
    public static int[] PartsOf(ElementSet set, int flat, IEnumerable<int> members)
    {
        var shape = set.Elements[flat].Shape;
        return [.. members.Where(member => Math.Abs(HeightOf(set, flat, member)) > MinHeight * shape.Size).Take(MaxParts)];
    }

    /// <summary>Returns maps that equal a known one in the plane of an element, and take another element to one of a list.</summary>
    /// <param name="set">All elements.</param>
    /// <param name="flat">The flat element.</param>
    /// <param name="map">A map that takes it where it goes.</param>
    /// <param name="part">An element outside of its plane.</param>
    /// <param name="images">Elements where that one may go.</param>
    public static IEnumerable<AffineMap> MapsOf(ElementSet set, int flat, AffineMap map, int part, IEnumerable<int> images)
    {
        var shape = set.Elements[flat].Shape;
        var normal = shape.Normal.UnitVector();
        var height = HeightOf(set, flat, part);
        var expected = map * set.Elements[part].Shape.Centroid;
        foreach (var image in images)
        {
            var change = (set.Elements[image].Shape.Centroid - expected) / height;
            var linear = map.Linear + Matrix.Outer(change, normal);
            var candidate = new AffineMap(linear, (map * shape.Centroid) - (linear * shape.Centroid));
            if (set.Match(candidate, part) == image)
            {
                yield return set.Fit(candidate, flat);
            }
        }
    }

    private static double HeightOf(ElementSet set, int flat, int member) => Vector.Dot(
        set.Elements[flat].Shape.Normal.UnitVector(), set.Elements[member].Shape.Centroid - set.Elements[flat].Shape.Centroid);
}
