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
        List<double> positions = [];
        List<int> corners = [];
        Dictionary<(int, int), int> vertices = [];
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            List<int> polygon = [];
            for (var corner = 0; corner < 3; corner++)
            {
                var (from, to) = (mesh.VertexIndices[(3 * face) + corner], mesh.VertexIndices[(3 * face) + ((corner + 1) % 3)]);
                var (heightFrom, heightTo) = (HeightOf(from), HeightOf(to));
                if (heightFrom >= 0)
                {
                    polygon.Add(VertexAt(from, from, 0));
                }

                if (heightFrom * heightTo < 0)
                {
                    polygon.Add(from < to ? VertexAt(from, to, heightFrom / (heightFrom - heightTo))
                        : VertexAt(to, from, heightTo / (heightTo - heightFrom)));
                }
            }

            var isInPlane = Enumerable.Range(0, 3).All(corner => HeightOf(mesh.VertexIndices[(3 * face) + corner]) <= 0);
            for (var corner = 2; corner < polygon.Count && !isInPlane; corner++)
            {
                corners.AddRange([polygon[0], polygon[corner - 1], polygon[corner]]);
            }
        }

        return new([.. positions], [.. corners]);

        double HeightOf(int vertex) =>
            Vector.Dot(Normal, mesh.Vertex(vertex)) - Offset is var height && Math.Abs(height) <= tolerance ? 0 : height;

        int VertexAt(int from, int to, double part)
        {
            if (!vertices.TryGetValue((from, to), out var index))
            {
                vertices.Add((from, to), index = positions.Count / 3);
                var position = mesh.Vertex(from) + (part * (mesh.Vertex(to) - mesh.Vertex(from)));
                if (from != to || HeightOf(from) == 0)
                {
                    position -= (Vector.Dot(Normal, position) - Offset) * Normal;
                }

                positions.AddRange([position.X, position.Y, position.Z]);
            }

            return index;
        }
    }

    /// <summary>Puts the open edges of a simplified half back into the plane, so that it meets its mirror image.</summary>
    /// <param name="half">Result of <see cref="HalfOf"/>, simplified.</param>
    /// <param name="tolerance">Largest distance from the plane of vertices that are moved, scene units.</param>
    public Mesh WithClosedSeam(Mesh half, double tolerance)
    {
        ArgumentNullException.ThrowIfNull(half);
        var uses = new Dictionary<(int, int), int>();
        for (var corner = 0; corner < half.VertexIndices.Length; corner++)
        {
            var (from, to) = (half.VertexIndices[corner], half.VertexIndices[corner % 3 == 2 ? corner - 2 : corner + 1]);
            var edge = (Math.Min(from, to), Math.Max(from, to));
            uses[edge] = uses.GetValueOrDefault(edge) + 1;
        }

        var positions = half.Positions.ToBuilder();
        foreach (var vertex in uses.Where(use => use.Value == 1).SelectMany(use => new[] { use.Key.Item1, use.Key.Item2 }))
        {
            var height = Vector.Dot(Normal, half.Vertex(vertex)) - Offset;
            if (Math.Abs(height) <= tolerance)
            {
                var (x, y, z) = half.Vertex(vertex) - (height * Normal);
                (positions[3 * vertex], positions[(3 * vertex) + 1], positions[(3 * vertex) + 2]) = (x, y, z);
            }
        }

        return new(positions.MoveToImmutable(), half.VertexIndices);
    }
}
