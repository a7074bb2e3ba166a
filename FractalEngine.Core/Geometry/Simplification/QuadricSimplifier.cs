using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Geometry.Triangles;

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
        var scale = QueryScale.Of(QueryScale.Magnitude(mesh));
        var positions = Enumerable.Range(0, mesh.VertexCount).Select(vertex => scale * mesh.Vertex(vertex)).ToArray();
        var representatives = VertexWelding.FindRepresentatives(mesh);
        var stars = new VertexStars([.. mesh.VertexIndices.Select(vertex => representatives[vertex])], positions.Length);
        new EdgeCollapser(positions, stars).Run(maxFaces, cancellation);
        int[] corners = [.. stars.VertexIndices];
        int[] used = [.. corners.Distinct().Order()];
        return new(
            [.. used.Select(vertex => positions[vertex]).SelectMany(position => new[] { position.X, position.Y, position.Z }
                .Select(coordinate => Math.Clamp(coordinate / scale, -double.MaxValue, double.MaxValue)))],
            [.. corners.Select(vertex => Array.BinarySearch(used, vertex))]);
    }
}
