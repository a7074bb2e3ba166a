using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>
/// Puts undamaged elements in place of those of a base that a search has found in a decimated model, so that its maps can be judged
/// alone: what they make of these is the undamaged model, or they are not those that it was made by.
/// </summary>
internal static class UndamagedBase
{
    /// <summary>The largest distance from the undamaged model, in its diagonals, at which maps count as found.</summary>
    public const double MapTolerance = 0.01;

    /// <summary>Returns a grammar with the same maps and undamaged elements.</summary>
    /// <param name="grammar">What was found; its base stands where elements of the model do.</param>
    /// <param name="input">The model.</param>
    public static MeshGrammar Put(MeshGrammar grammar, UnseenInput input) => grammar with
    {
        Base = Put(grammar.Base, input),
        Leaf = grammar.Leaf is null ? null : Put(grammar.Leaf, input),
        Parts = [.. grammar.Parts.Select(part => Put(part, input))],
    };

    private static Mesh Put(Mesh mesh, UnseenInput input)
    {
        var elements = ElementFinder.Find(input.Clean, weldPositions: false);
        var nearest = ElementFinder.Find(mesh, weldPositions: false).Select(part => elements.MinBy(element =>
            (element.Shape.Centroid - part.Shape.Centroid).Length() + Math.Abs(element.Shape.Size - part.Shape.Size))!);
        var (points, corners) = Element.Join(nearest.Select(element => (element, AffineMap.Identity)));
        return MeshTools.Create(points, corners);
    }
}
