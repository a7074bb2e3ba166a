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

    // Beyond it, what a product of maps rounds may be more than its norm tells.
    private const double MaxCondition = 100;

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
            var norm = Norm * inner.Norm * (1 + RoundingErrors.Norm);
            return inner with
            {
                Path = [.. Path, .. inner.Path],
                LevelStep = LevelStep.Then(inner.LevelStep),
                Map = map,
                Inverse = inner.Inverse * Inverse,
                Norm = norm,
                InverseNorm = InverseNorm * inner.InverseNorm * (1 + RoundingErrors.Norm),
                Box = BoundingBox.Intersection(inner.Box.Transform(Map), inner.Target.TransformedBox(map, norm)),
            };
        });

    private static RayDescendant OfChild(ChildInstance child, int index, BoundingBox box, long level, FractalHierarchy hierarchy)
    {
        var levels = child.RemainingLevels(level);
        var inverse = child.InverseSimdMap.ToAffineMap();
        var inverseNorm = BoundingSphere.OperatorNormBound(inverse.Linear) * (1 + RoundingErrors.Norm);
        return new(
            [index], hierarchy.At(child, levels), child.Group is not null, levels, child.LevelStep, child.Map, inverse,
            NormBound(child, inverseNorm), inverseNorm, box);
    }

    /// <summary>
    /// Bounds the factor by which the map of a child lengthens vectors: where it is well conditioned, by the norm of the product of its
    /// parts without their signs, which bounds what the product rounds too. That may be far less than the product of their norms.
    /// </summary>
    private static double NormBound(ChildInstance child, double inverseNorm)
    {
        var absolute = Matrix.Identity;
        foreach (var edge in child.Edges)
        {
            absolute *= edge.Map.Linear.Absolute();
        }

        return child.OperatorNormBound * inverseNorm < MaxCondition
            ? Math.Min(child.OperatorNormBound, absolute.OperatorNorm() * (1 + NormError))
            : child.OperatorNormBound;
    }
}
