using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Elements;

/// <summary>A connected part of a mesh, and the class of those that affine maps take to it.</summary>
/// <param name="shape">Its vertices.</param>
/// <param name="corners">Its faces, indices of the shape's vertices, [faces × 3].</param>
internal sealed class Element(ElementShape shape, int[] corners)
{
    /// <summary>The vertices of the element.</summary>
    public ElementShape Shape => shape;

    /// <summary>Indices of vertices from 0, [faces × 3].</summary>
    public int[] Corners => corners;

    /// <summary>The class of congruent elements, from 0.</summary>
    public int Class { get; set; }

    /// <summary>One of the maps that take the first element of the class to this one.</summary>
    public AffineMap Placement { get; set; } = AffineMap.Identity;

    /// <summary>Joins images of elements: all vertices, and the faces as indices of these, [faces × 3].</summary>
    public static (Vector[] Points, int[] Corners) Join(IEnumerable<(Element Element, AffineMap Map)> parts)
    {
        var points = new List<Vector>();
        var corners = new List<int>();
        foreach (var (element, map) in parts)
        {
            var first = points.Count;
            points.AddRange(element.Shape.Points.Select(point => map * point));
            // A mirror turns faces inside out.
            int[] order = map.Linear.Determinant() < 0 ? [0, 2, 1] : [0, 1, 2];
            foreach (var face in element.Corners.Chunk(3))
            {
                corners.AddRange(order.Select(corner => first + face[corner]));
            }
        }

        return ([.. points], [.. corners]);
    }
}
