using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>
/// Gives each vertex and each edge of a mesh to one of the faces that have it, so that pairs of faces test none twice: representative
/// triangles (Curtis, Tamstorf and Manocha 2008). Edges between two faces of one plane belong to none.
/// </summary>
internal sealed class MeshFeatures
{
    // Sine of the angle between the planes of two faces that count as one.
    private const double MaxFlatSine = 1e-6;

    private static readonly ConditionalWeakTable<Mesh, MeshFeatures> Shared = [];

    private readonly byte[] _vertices;
    private readonly int[] _neighbours;
    private readonly int[] _representatives;
    private readonly Vector[] _inwards;
    private readonly Mesh _mesh;

    private MeshFeatures(Mesh mesh)
    {
        _mesh = mesh;
        _representatives = VertexWelding.FindRepresentatives(mesh);
        _inwards = new Vector[mesh.VertexCount];
        _vertices = new byte[mesh.FaceCount];
        _neighbours = new int[3 * mesh.FaceCount];
        var isGiven = new bool[mesh.VertexCount];
        var edges = new Dictionary<(int From, int To), (int First, int Second, int Count)>(2 * mesh.FaceCount);
        for (var i = 0; i < _neighbours.Length; i++)
        {
            var from = _representatives[mesh.VertexIndices[i]];
            var to = _representatives[mesh.VertexIndices[Mesh.NextCorner(i)]];
            _vertices[i / 3] |= (byte)(isGiven[from] ? 0 : 1 << (i % 3));
            isGiven[from] = true;
            _inwards[from] += mesh.Vertex(to) - mesh.Vertex(from);
            _inwards[to] += mesh.Vertex(from) - mesh.Vertex(to);
            ref var edge = ref CollectionsMarshal.GetValueRefOrAddDefault(edges, (Math.Min(from, to), Math.Max(from, to)), out _);
            edge = edge.Count == 0 ? (i, i, 1) : (edge.First, i, edge.Count + 1);
            _neighbours[i] = -1;
        }

        foreach (var (first, second, count) in edges.Values)
        {
            // Two faces on the same side of an edge, as where one is listed twice, go along it in the same direction.
            var isBetween = _representatives[mesh.VertexIndices[first]] != _representatives[mesh.VertexIndices[second]];
            if (count != 2 || !isBetween || !IsFlat(mesh, first / 3, second / 3))
            {
                _neighbours[first] = second / 3;
            }
        }
    }

    /// <summary>Finds the features of a mesh, which the first who asks for them does. Cost O(faces).</summary>
    public static MeshFeatures For(Mesh mesh) => Shared.GetValue(mesh, static key => new(key));

    /// <summary>True for the face that a vertex is given to.</summary>
    /// <param name="face">Index of the face.</param>
    /// <param name="corner">The vertex, as a corner of the face.</param>
    public bool HasVertex(int face, int corner) => (_vertices[face] & (1 << corner)) != 0;

    /// <summary>The sum of the edges from a vertex: it leads away from what touches a convex corner.</summary>
    /// <param name="face">Index of a face.</param>
    /// <param name="corner">The vertex, as a corner of the face.</param>
    public Vector InwardsFrom(int face, int corner) => _inwards[_representatives[_mesh.VertexIndices[(3 * face) + corner]]];

    /// <summary>True for the face that an edge is given to.</summary>
    /// <param name="face">Index of the face.</param>
    /// <param name="side">Corner of the face where the edge begins; it ends at the next one.</param>
    /// <param name="neighbour">Receives another face with that edge; the same one where there is none.</param>
    public bool HasEdge(int face, int side, out int neighbour)
    {
        neighbour = _neighbours[(3 * face) + side];
        return neighbour >= 0;
    }

    /// <summary>Tells whether two faces lie in one plane, wound alike.</summary>
    internal static bool IsFlat(Mesh mesh, int face1, int face2)
    {
        var (a1, b1, c1) = mesh.Face(face1);
        var (a2, b2, c2) = mesh.Face(face2);
        var (normal1, normal2) = (Vector.Cross(b1 - a1, c1 - a1), Vector.Cross(b2 - a2, c2 - a2));
        return Vector.Dot(normal1, normal2) > 0 && Vector.Cross(normal1, normal2).LengthSquared()
            < MaxFlatSine * MaxFlatSine * normal1.LengthSquared() * normal2.LengthSquared();
    }
}
