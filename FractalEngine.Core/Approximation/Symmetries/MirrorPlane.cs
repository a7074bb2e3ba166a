using FractalEngine.Core.Distances;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Symmetries;

/// <summary>A plane about which a surface is roughly its own mirror image: normal · x = offset.</summary>
/// <param name="Normal">Unit vector.</param>
/// <param name="Offset">Distance of the plane from the origin along the normal, scene units.</param>
/// <param name="MeanDistance">Mean distance of the mirror image from the surface, scene units.</param>
public sealed record MirrorPlane(Vector Normal, double Offset, double MeanDistance)
{
    // Vertices so near to the plane are put onto it, as a part of the diagonal: no slivers, and halves that meet.
    private const double PlaneTolerance = 1e-6;

    /// <summary>The reflection about the plane.</summary>
    public AffineMap Reflection => new(Matrix.Identity - (2 * Matrix.Outer(Normal, Normal)), 2 * Offset * Normal);

    /// <summary>Cuts off what is behind the plane.</summary>
    /// <param name="mesh">The mesh to cut; faces in the plane are left out.</param>
    /// <returns>Positions and faces alone. Cut faces have new vertices in the plane.</returns>
    public Mesh HalfOf(Mesh mesh)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        var tolerance = PlaneTolerance * mesh.UsedBounds.Diagonal;
        var closed = WithClosedSeam(mesh, tolerance);
        List<Vector> corners = [];
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = closed.Face(face);
            var (front, _) = new SurfacePiece([a, b, c]).Split([HeightOf(a), HeightOf(b), HeightOf(c)]);
            // A corner in the plane ends two edges.
            var outline = front.Corners.Distinct().ToArray();
            for (var corner = 2; corner < outline.Length; corner++)
            {
                corners.AddRange([outline[0], outline[corner - 1], outline[corner]]);
            }
        }

        var positions = corners.Distinct().ToArray();
        var vertices = positions.Index().ToDictionary(entry => entry.Item, entry => entry.Index);
        return new([.. positions.SelectMany(CoordinatesOf)], [.. corners.Select(corner => vertices[corner])]);

        double HeightOf(Vector position) => Math.Abs(DistanceOf(position)) <= tolerance ? 0 : DistanceOf(position);
    }

    /// <summary>Puts vertices near the plane into it, so that a simplified half meets its mirror image.</summary>
    /// <param name="half">Result of <see cref="HalfOf"/>, simplified.</param>
    /// <param name="tolerance">Largest distance from the plane of vertices that are moved, scene units.</param>
    public Mesh WithClosedSeam(Mesh half, double tolerance)
    {
        ArgumentNullException.ThrowIfNull(half);
        var positions = Enumerable.Range(0, half.VertexCount).Select(half.Vertex)
            .Select(position => Math.Abs(DistanceOf(position)) <= tolerance ? position - (DistanceOf(position) * Normal) : position);
        return new([.. positions.SelectMany(CoordinatesOf)], half.VertexIndices);
    }

    private double DistanceOf(Vector position) => Vector.Dot(Normal, position) - Offset;

    private static double[] CoordinatesOf(Vector position) => [position.X, position.Y, position.Z];
}
