using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>A sub-fractal inside another one, by one child instance or a path of several, while bounds for rays are built.</summary>
/// <param name="Path">Indices of the child instances that lead to it, the outermost first.</param>
/// <param name="LevelStep">From the remaining levels of the outer one to its own.</param>
/// <param name="Map">From its frame to that of the outer one.</param>
/// <param name="Inverse">From the frame of the outer one to its own.</param>
/// <param name="Norm">Upper bound of the factor by which the map lengthens vectors.</param>
/// <param name="InverseNorm">Upper bound of the factor by which the inverse lengthens vectors.</param>
/// <param name="Group">The group of children that it stands for; null for a sub-fractal.</param>
/// <param name="Box">A box around it, in the frame of the outer one.</param>
internal sealed record RayDescendant(
    int[] Path, LevelStep LevelStep, AffineMap Map, AffineMap Inverse, double Norm, double InverseNorm, SubFractal? Group, BoundingBox Box)
{
    // The norms of maps are rounded.
    private const double NormError = 1e-15;

    /// <summary>Lists the children of a sub-fractal that are not empty.</summary>
    public static IEnumerable<RayDescendant> ChildrenOf(SubFractal subFractal) => Enumerable.Range(0, subFractal.Children.Length)
        .Where(i => !subFractal.IsChildEmpty(i))
        .Select(i => OfChild(subFractal.Children[i], i, subFractal.ChildBox(i)));

    /// <summary>Describes a descendant of the sub-fractal that this is an instance of, as one of the outer sub-fractal.</summary>
    /// <param name="inner">The descendant, seen from the sub-fractal.</param>
    /// <param name="target">What it is an instance of.</param>
    public RayDescendant Then(RayDescendant inner, SubFractal target)
    {
        var map = Map * inner.Map;
        var norm = Norm * inner.Norm * (1 + NormError);
        return new(
            [.. Path, .. inner.Path], LevelStep.Then(inner.LevelStep), map, inner.Inverse * Inverse, norm,
            InverseNorm * inner.InverseNorm * (1 + NormError), inner.Group,
            BoundingBox.Intersection(inner.Box.Transform(Map), target.TransformedBox(map, norm)));
    }

    private static RayDescendant OfChild(ChildInstance child, int index, BoundingBox box)
    {
        var inverse = child.InverseSimdMap.ToAffineMap();
        var inverseNorm = BoundingSphere.OperatorNormBound(inverse.Linear) * (1 + NormError);
        return new([index], child.LevelStep, child.Map, inverse, child.OperatorNormBound, inverseNorm, child.Group, box);
    }
}
