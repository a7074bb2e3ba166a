using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>A convex solid: its vertices, faces and edges as indices.</summary>
internal sealed class ConvexPart
{
    public ConvexPart(Mesh mesh, AffineMap map)
    {
        Vertices = [.. Enumerable.Range(0, mesh.VertexCount).Select(vertex => map * mesh.Vertex(vertex)).Distinct()];
        Faces =
        [
            .. PhysicsMeshes.TrianglesOf(mesh).Select(face => (
                Array.IndexOf(Vertices, map * face.A), Array.IndexOf(Vertices, map * face.B), Array.IndexOf(Vertices, map * face.C))),
        ];
        Edges =
        [
            .. Faces.SelectMany(face => new[] { (face.A, face.B), (face.B, face.C), (face.C, face.A) })
                .Select(edge => (Math.Min(edge.Item1, edge.Item2), Math.Max(edge.Item1, edge.Item2))).Distinct(),
        ];
    }

    public Vector[] Vertices { get; }

    public (int A, int B, int C)[] Faces { get; }

    public (int A, int B)[] Edges { get; }
}
