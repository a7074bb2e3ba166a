using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Rays;

/// <summary>A sub-fractal inside another one, by one child instance or a path of several, while bounds for rays are built.</summary>
/// <param name="Path">Indices of the child instances that lead to it, the outermost first.</param>
/// <param name="Target">What it is an instance of, or a group of children.</param>
/// <param name="IsGroup">True for a group of children.</param>
/// <param name="RemainingLevels">Its remaining levels.</param>
/// <param name="LevelStep">From the remaining levels of the outer one to its own.</param>
/// <param name="Map">From its frame to that of the outer one.</param>
/// <param name="Inverse">From the frame of the outer one to its own.</param>
/// <param name="Norm">Upper bound of the factor by which the map lengthens vectors.</param>
/// <param name="InverseNorm">Upper bound of the factor by which the inverse lengthens vectors.</param>
/// <param name="Box">A box around it, in the frame of the outer one.</param>
internal sealed record RayDescendant(
    int[] Path, SubFractal Target, bool IsGroup, long RemainingLevels, LevelStep LevelStep, AffineMap Map, AffineMap Inverse, double Norm,
    double InverseNorm, BoundingBox Box)
{
    // Of the computed norm of a map: the root of what is rounded, where two directions are lengthened alike.
    private const double NormError = 1e-7;

    /// <summary>Lists the children of a sub-fractal, or of a group, that are not empty.</summary>
    /// <param name="subFractal">The sub-fractal or group.</param>
    /// <param name="level">Its remaining levels.</param>
    /// <param name="hierarchy">The hierarchy.</param>
    public static IEnumerable<RayDescendant> ChildrenOf(SubFractal subFractal, long level, FractalHierarchy hierarchy) =>
        Enumerable.Range(0, subFractal.Children.Length)
            .Where(i => !subFractal.IsChildEmpty(i))
            .Select(i => OfChild(subFractal.Children[i], i, subFractal.ChildBox(i), level, hierarchy));

    /// <summary>Lists the children of what this is an instance of, as descendants of the outer sub-fractal.</summary>
    /// <param name="hierarchy">The hierarchy.</param>
    public IEnumerable<RayDescendant> Children(FractalHierarchy hierarchy) =>
        ChildrenOf(Target, RemainingLevels, hierarchy).Select(inner =>
        {
            var map = Map * inner.Map;
            var inverse = inner.Inverse * Inverse;
            var norm = NormBound(map, Norm * inner.Norm);
            return inner with
            {
                Path = [.. Path, .. inner.Path],
                LevelStep = LevelStep.Then(inner.LevelStep),
                Map = map,
                Inverse = inverse,
                Norm = norm,
                InverseNorm = NormBound(inverse, InverseNorm * inner.InverseNorm),
                Box = BoundingBox.Intersection(inner.Box.Transform(Map), inner.Target.TransformedBox(map, norm)),
            };
        });

    private static RayDescendant OfChild(ChildInstance child, int index, BoundingBox box, long level, FractalHierarchy hierarchy)
    {
        var levels = child.RemainingLevels(level);
        var inverse = child.InverseSimdMap.ToAffineMap();
        return new(
            [index], hierarchy.At(child, levels), child.Group is not null, levels, child.LevelStep, child.Map, inverse,
            NormBound(child.Map, child.OperatorNormBound), NormBound(inverse, BoundingSphere.OperatorNormBound(inverse.Linear)), box);
    }

    /// <summary>Bounds the factor by which a map lengthens vectors, often better than the product of the bounds of its parts.</summary>
    private static double NormBound(AffineMap map, double bound) =>
        Math.Min(bound * (1 + RoundingErrors.Norm), map.Linear.OperatorNorm() * (1 + NormError));
}
