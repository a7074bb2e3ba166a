using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Hulls;

/// <summary>Bounds of a sub-fractal in its own frame, while the hierarchy of its fractal is built.</summary>
/// <param name="Box">Contains the sub-fractal.</param>
/// <param name="Hull">
/// Contains the sub-fractal if widened by the margin; null where there is none, or where it would be no better than the box.
/// </param>
/// <param name="Margin">How far the sub-fractal may reach out of the hull, in scene units.</param>
internal sealed record BoundingVolume(BoundingBox Box, ConvexHull? Hull, double Margin)
{
    /// <summary>Boxes that contain the sub-fractal together; none where <see cref="Box"/> alone bounds it as well.</summary>
    public BoundingBox[] Clusters { get; init; } = [];

    // More vertices bound more tightly and take longer; this many leave about a hundredth of the size.
    private const int MaxHullVertices = 48;

    // Beyond this, squares of coordinates leave the range of a double, and with them the hull.
    private const double MaxHullSize = 1e100;

    /// <summary>The volume that contains no point.</summary>
    public static BoundingVolume Empty { get; } = new(BoundingBox.Empty, null, 0);

    /// <summary>Computes the bounds of a mesh.</summary>
    public static BoundingVolume FromMesh(Mesh mesh)
    {
        if (mesh.FaceCount == 0)
        {
            return Empty;
        }

        var vertices = UsedVertices(mesh);
        return FromVertices(mesh.UsedBounds, vertices, vertices.Length, 0);
    }

    /// <summary>Tells whether a volume of this box is small enough for a hull.</summary>
    public static bool CanHaveHull(BoundingBox box) => box.Diagonal < MaxHullSize && RoundingMargin(box) < MaxHullSize;

    /// <summary>Computes the bounds of the union of several volumes.</summary>
    /// <param name="box">Contains all volumes.</param>
    /// <param name="vertices">Begins with the vertices of all their hulls, and is not kept.</param>
    /// <param name="vertexCount">Number of vertices; 0 where one of the volumes has no hull.</param>
    /// <param name="margin">The largest margin of the hulls.</param>
    public static BoundingVolume FromVertices(BoundingBox box, Vector[] vertices, int vertexCount, double margin)
    {
        if (vertexCount == 0 || !CanHaveHull(box))
        {
            return new(box, null, 0);
        }

        var hull = ConvexHull.Build(vertices, vertexCount, MaxHullVertices);
        return new BoundingVolume(box, hull, margin + hull.MaxOutsideDistance + RoundingMargin(box)).WithTightBox();
    }

    /// <summary>Computes the bounds of this volume's image under a map.</summary>
    /// <param name="map">From the frame of this volume to that of the image.</param>
    /// <param name="operatorNormBound">Upper bound of the factor by which the map lengthens vectors.</param>
    public BoundingVolume Transform(AffineMap map, double operatorNormBound)
    {
        var box = TransformedBox(map, operatorNormBound);
        if (Hull is null || !(box.Diagonal < MaxHullSize))
        {
            return new(box, null, 0);
        }

        var hull = Hull.Transform(map);
        return new BoundingVolume(box, hull, (Margin * operatorNormBound) + hull.MaxOutsideDistance + RoundingMargin(box)).WithTightBox();
    }

    /// <summary>Computes a box around this volume's image under a map.</summary>
    /// <param name="map">From the frame of this volume to that of the image.</param>
    /// <param name="operatorNormBound">Upper bound of the factor by which the map lengthens vectors.</param>
    public BoundingBox TransformedBox(AffineMap map, double operatorNormBound) =>
        TransformedBox(Box, Hull?.Vertices, Margin, map, operatorNormBound);

    /// <summary>Computes a box around the image of what a box and a hull hold.</summary>
    /// <param name="box">The box.</param>
    /// <param name="hullVertices">Vertices of the hull; null for none.</param>
    /// <param name="margin">How far points lie outside the hull at most.</param>
    /// <param name="map">The map.</param>
    /// <param name="operatorNormBound">Upper bound of the factor by which the map lengthens vectors.</param>
    public static BoundingBox TransformedBox(
        BoundingBox box, Vector[]? hullVertices, double margin, AffineMap map, double operatorNormBound)
    {
        var transformedBox = box.Transform(map);
        if (hullVertices is null)
        {
            return transformedBox;
        }

        var hullBox = BoundingBox.Around(Array.ConvertAll(hullVertices, vertex => map * vertex));
        return BoundingBox.Intersection(transformedBox, Inflate(hullBox, (margin * operatorNormBound) + RoundingMargin(transformedBox)));
    }

    /// <summary>Computes boxes around the images of the clusters, or of the box, under a map.</summary>
    public IEnumerable<BoundingBox> TransformedClusters(AffineMap map) =>
        Clusters is [] ? [Box.Transform(map)] : Clusters.Select(cluster => cluster.Transform(map));

    /// <summary>Computes a box that is larger by a margin on all sides.</summary>
    public static BoundingBox Inflate(BoundingBox box, double margin) =>
        new(box.Minimum - (margin * Vector.One), box.Maximum + (margin * Vector.One));

    /// <summary>Upper bound of how far rounding moves a mapped point of a box.</summary>
    public static double RoundingMargin(BoundingBox box) => RoundingErrors.MappedPoint * box.MaxAbsCoordinate();

    /// <summary>Lists the vertices of all faces, each once, by their first use.</summary>
    private static Vector[] UsedVertices(Mesh mesh)
    {
        var isUsed = new bool[mesh.Positions.Length / 3];
        var vertices = new List<Vector>(isUsed.Length);
        foreach (var index in mesh.VertexIndices.AsSpan())
        {
            if (!isUsed[index])
            {
                isUsed[index] = true;
                vertices.Add(mesh.Vertex(index));
            }
        }

        return vertices.ToArray();
    }

    /// <summary>The same volume with a box that is no larger than that of the hull.</summary>
    private BoundingVolume WithTightBox() =>
        this with { Box = BoundingBox.Intersection(Box, Inflate(BoundingBox.Around(Hull!.Vertices), Margin)) };
}
