using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>
/// Simplifies meshes by collapsing edges in the order of their quadric error (M. Garland, P. Heckbert, "Surface simplification using
/// quadric error metrics", 1997).
/// </summary>
public static class QuadricSimplifier
{
    /// <summary>Reduces a mesh to a number of faces that are as close to its surface as the method finds.</summary>
    /// <param name="mesh">
    /// Any mesh: open, not manifold, or without area. Vertices at exactly the same position are welded, faces with fewer than three
    /// different vertices are removed, and of faces with the same three vertices all but the first are.
    /// </param>
    /// <param name="maxFaces">Maximum number of faces; 0 or more.</param>
    /// <param name="cancellation">Ends the work before it is done.</param>
    /// <returns>
    /// Positions and faces alone: normals, texture coordinates, colours and groups are dropped. Faces and vertices keep their order,
    /// and all vertices are used.
    /// </returns>
    /// <exception cref="ArgumentNullException">The mesh is null.</exception>
    /// <exception cref="ArgumentOutOfRangeException">The number of faces is negative.</exception>
    /// <exception cref="OperationCanceledException">The work was cancelled.</exception>
    /// <remarks>
    /// Open edges are held in place as surfaces are. A collapse that would turn a face over or change the topology waits until others
    /// change as much as if the faces around it moved by a seventh of the edge. So the topology is kept while there are enough faces for
    /// it, and small components vanish before large ones lose their shape. The same mesh gives the same bits. Cost O(n·log n) for n faces,
    /// with a bounded number of them around each vertex.
    /// </remarks>
    public static Mesh Simplify(Mesh mesh, int maxFaces, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        ArgumentOutOfRangeException.ThrowIfNegative(maxFaces);
        // A power of two changes no digit of a coordinate.
        var size = mesh.VertexCount > 0 ? mesh.Bounds.MaxAbsCoordinate() : 0;
        var exponent = size > 0 ? Math.ILogB(size) : 0;
        var positions = new Vector[mesh.VertexCount];
        for (var vertex = 0; vertex < positions.Length; vertex++)
        {
            positions[vertex] = Scale(mesh.Vertex(vertex), -exponent);
        }

        var stars = new VertexStars(FindDistinctFaces(mesh), positions.Length);
        new EdgeCollapser(positions, stars).Run(maxFaces, cancellation);
        return Build(positions, exponent, [.. stars.VertexIndices]);
    }

    /// <summary>Makes a mesh of those vertices that faces use.</summary>
    private static Mesh Build(Vector[] positions, int exponent, int[] vertexIndices)
    {
        var newVertices = new int[positions.Length];
        foreach (var vertex in vertexIndices)
        {
            newVertices[vertex] = 1;
        }

        List<double> coordinates = [];
        for (var vertex = 0; vertex < newVertices.Length; vertex++)
        {
            if (newVertices[vertex] > 0)
            {
                newVertices[vertex] = coordinates.Count / 3;
                var (x, y, z) = Scale(positions[vertex], exponent);
                coordinates.AddRange([x, y, z]);
            }
        }

        return new([.. coordinates], [.. vertexIndices.Select(vertex => newVertices[vertex])]);
    }

    private static int[] FindDistinctFaces(Mesh mesh)
    {
        var representatives = VertexWelding.FindRepresentatives(mesh);
        var faces = new HashSet<(int, int, int)>(mesh.FaceCount);
        List<int> vertices = new(mesh.VertexIndices.Length);
        for (var i = 0; i < mesh.VertexIndices.Length; i += 3)
        {
            var a = representatives[mesh.VertexIndices[i]];
            var b = representatives[mesh.VertexIndices[i + 1]];
            var c = representatives[mesh.VertexIndices[i + 2]];
            var (min, max) = (Math.Min(a, Math.Min(b, c)), Math.Max(a, Math.Max(b, c)));
            var middle = a ^ b ^ c ^ min ^ max;
            if (a != b && b != c && c != a && faces.Add((min, middle, max)))
            {
                vertices.AddRange([a, b, c]);
            }
        }

        return [.. vertices];
    }

    /// <summary>Multiplies by a power of two. What is beyond the range of a double afterwards becomes its largest number.</summary>
    private static Vector Scale(Vector v, int exponent) => new(Scale(v.X, exponent), Scale(v.Y, exponent), Scale(v.Z, exponent));

    private static double Scale(double coordinate, int exponent) =>
        Math.Clamp(Math.ScaleB(coordinate, exponent), -double.MaxValue, double.MaxValue);
}
