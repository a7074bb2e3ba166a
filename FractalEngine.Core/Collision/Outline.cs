using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>What is known of where a sub-fractal is, in its own frame, while a table is built.</summary>
/// <param name="Box">Holds it.</param>
/// <param name="Hull">Holds it, if widened by the margin; null where there is none or where it would be no better than the box.</param>
/// <param name="Margin">Scene units.</param>
internal sealed record Outline(BoundingBox Box, ConvexHull? Hull, double Margin)
{
    // Of the largest coordinate: more than what mapping a point adds by rounding.
    private const double Rounding = 2e-15;

    // More corners bound closer and take longer; this many leave about a hundredth of the size.
    private const int MostVertices = 48;

    private const double LargestSize = 1e100;

    /// <summary>Of nothing.</summary>
    public static Outline Empty { get; } = new(BoundingBox.Empty, null, 0);

    /// <summary>Of a mesh.</summary>
    public static Outline Of(Mesh mesh)
    {
        if (mesh.FaceCount == 0)
        {
            return Empty;
        }

        return With(mesh.Bounds, [.. mesh.Faces.Distinct().Select(mesh.Vertex)], 0);
    }

    /// <summary>Of several parts.</summary>
    /// <param name="box">Holds all.</param>
    /// <param name="corners">What the parts' hulls have as corners; null where one has none.</param>
    /// <param name="margin">How far the parts reach out of their hulls.</param>
    public static Outline With(BoundingBox box, Vector[]? corners, double margin)
    {
        // Beyond this, squares of coordinates leave the range of a double, and with them the hull.
        if (corners is null || corners.Length == 0 || !(box.Diagonal < LargestSize) || !(RoundingOf(box) < LargestSize))
        {
            return new(box, null, 0);
        }

        var hull = ConvexHull.Of(corners, MostVertices);
        return new Outline(box, hull, margin + hull.Missed + RoundingOf(box)).Tightened();
    }

    /// <summary>Of one part's image.</summary>
    /// <param name="part">In its own frame.</param>
    /// <param name="map">Of the frame.</param>
    /// <param name="lengthening">The most by which the map lengthens.</param>
    public static Outline With(Outline part, AffineMap map, double lengthening) => part.Image(map, lengthening) switch
    {
        var box when part.Hull is null => new(box, null, 0),
        var box => new Outline(box, part.Hull.Image(map), (part.Margin * lengthening) + RoundingOf(box)).Tightened(),
    };

    /// <summary>The outline's image under a map: a box around it.</summary>
    /// <param name="map">Of the frame.</param>
    /// <param name="lengthening">The most by which the map lengthens.</param>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    public BoundingBox Image(AffineMap map, double lengthening)
    {
        var image = Box.Transform(map);
        if (Hull is null)
        {
            return image;
        }

        var box = BoundingBox.Empty;
        foreach (var vertex in Hull.Vertices)
        {
            box = box.Including(map * vertex);
        }

        return Shared(image, Widened(box, (Margin * lengthening) + RoundingOf(image)));
    }

    /// <summary>A box grown to all sides.</summary>
    public static BoundingBox Widened(BoundingBox box, double margin) => new(box.Minimum - (margin * Vector.One), box.Maximum + (margin * Vector.One));

    private static double RoundingOf(BoundingBox box) => Rounding * Math.Max(box.Minimum.MaximumComponent(), box.Maximum.MaximumComponent());

    /// <summary>With a box that is no larger than that of the hull.</summary>
    private Outline Tightened() =>
        this with { Box = Shared(Box, Widened(Hull!.Vertices.Aggregate(BoundingBox.Empty, (sum, vertex) => sum.Including(vertex)), Margin)) };

    private static BoundingBox Shared(BoundingBox box1, BoundingBox box2) => new(Vector.Max(box1.Minimum, box2.Minimum), Vector.Min(box1.Maximum, box2.Maximum));
}
