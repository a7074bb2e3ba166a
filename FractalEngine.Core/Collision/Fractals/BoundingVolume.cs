using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>What is known of where a sub-fractal is, in its own frame, while a table is built.</summary>
/// <param name="Box">Holds it.</param>
/// <param name="Hull">Holds it, if widened by the margin; null where there is none or where it would be no better than the box.</param>
/// <param name="Margin">Scene units.</param>
internal sealed record BoundingVolume(BoundingBox Box, ConvexHull? Hull, double Margin)
{
    // Of the largest coordinate: more than what mapping a point adds by rounding.
    private const double Rounding = 2e-15;

    // More corners bound closer and take longer; this many leave about a hundredth of the size.
    private const int MaxHullVertices = 48;

    private const double MaxSize = 1e100;

    /// <summary>Of nothing.</summary>
    public static BoundingVolume Empty { get; } = new(BoundingBox.Empty, null, 0);

    /// <summary>Of a mesh.</summary>
    public static BoundingVolume Of(Mesh mesh)
    {
        if (mesh.FaceCount == 0)
        {
            return Empty;
        }

        return Create(mesh.Bounds, [.. mesh.VertexIndices.Distinct().Select(mesh.Vertex)], 0);
    }

    /// <summary>Of several parts.</summary>
    /// <param name="box">Holds all.</param>
    /// <param name="vertices">What the parts' hulls have as corners; null where one has none.</param>
    /// <param name="margin">How far the parts reach out of their hulls.</param>
    public static BoundingVolume Create(BoundingBox box, Vector[]? vertices, double margin)
    {
        // Beyond this, squares of coordinates leave the range of a double, and with them the hull.
        if (vertices is null || vertices.Length == 0 || !(box.Diagonal < MaxSize) || !(RoundingMargin(box) < MaxSize))
        {
            return new(box, null, 0);
        }

        var hull = ConvexHull.Build(vertices, MaxHullVertices);
        return new BoundingVolume(box, hull, margin + hull.MaxOutsideDistance + RoundingMargin(box)).Tightened();
    }

    /// <summary>Of one part's image.</summary>
    /// <param name="child">In its own frame.</param>
    /// <param name="map">Of the frame.</param>
    /// <param name="operatorNormBound">The most by which the map lengthens.</param>
    public static BoundingVolume Create(BoundingVolume child, AffineMap map, double operatorNormBound) =>
        child.TransformedBox(map, operatorNormBound) switch
    {
        var box when child.Hull is null => new(box, null, 0),
        var box => new BoundingVolume(box, child.Hull.Transform(map), (child.Margin * operatorNormBound) + RoundingMargin(box)).Tightened(),
    };

    /// <summary>The outline's image under a map: a box around it.</summary>
    /// <param name="map">Of the frame.</param>
    /// <param name="operatorNormBound">The most by which the map lengthens.</param>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    public BoundingBox TransformedBox(AffineMap map, double operatorNormBound)
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

        return Intersection(image, Inflate(box, (Margin * operatorNormBound) + RoundingMargin(image)));
    }

    /// <summary>A box grown to all sides.</summary>
    public static BoundingBox Inflate(BoundingBox box, double margin) =>
        new(box.Minimum - (margin * Vector.One), box.Maximum + (margin * Vector.One));

    private static double RoundingMargin(BoundingBox box) =>
        Rounding * Math.Max(box.Minimum.MaxAbsComponent(), box.Maximum.MaxAbsComponent());

    /// <summary>With a box that is no larger than that of the hull.</summary>
    private BoundingVolume Tightened() =>
        this with { Box =
        Intersection(Box, Inflate(Hull!.Vertices.Aggregate(BoundingBox.Empty, (sum, vertex) => sum.Including(vertex)), Margin)) };

    private static BoundingBox Intersection(BoundingBox box1, BoundingBox box2) =>
        new(Vector.Max(box1.Minimum, box2.Minimum), Vector.Min(box1.Maximum, box2.Maximum));
}
