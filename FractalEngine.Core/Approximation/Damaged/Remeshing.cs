using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>Undoes what other programs do to meshes without changing surfaces: splits of edges and faces, and welds across parts.</summary>
internal static class Remeshing
{
    // Sine of the angle within which faces lie in one plane, and edges on one line.
    private const double MaxSine = 1e-6;

    /// <summary>Gives each group of faces vertices of its own; only edges with two faces connect.</summary>
    public static Mesh Unweld(Mesh mesh)
    {
        var facesAt = new Dictionary<(int, int), List<int>>();
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            var (a, b) = (mesh.VertexIndices[corner], mesh.VertexIndices[Mesh.NextCorner(corner)]);
            var key = (Math.Min(a, b), Math.Max(a, b));
            (CollectionsMarshal.GetValueRefOrAddDefault(facesAt, key, out _) ??= []).Add(corner / 3);
        }

        var joined = new DisjointSets();
        joined.Reset(mesh.FaceCount);
        foreach (var faces in facesAt.Values.Where(faces => faces.Count == 2))
        {
            joined.Join(faces[0], faces[1]);
        }

        var vertices = new Dictionary<(int Vertex, int Part), int>();
        var positions = ImmutableArray.CreateBuilder<double>();
        var corners = ImmutableArray.CreateBuilder<int>(mesh.VertexIndices.Length);
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            var key = (mesh.VertexIndices[corner], joined.RootOf(corner / 3));
            if (!vertices.TryGetValue(key, out var vertex))
            {
                vertices.Add(key, vertex = vertices.Count);
                var (x, y, z) = mesh.Vertex(key.Item1);
                positions.AddRange(x, y, z);
            }

            corners.Add(vertex);
        }

        return new(positions.ToImmutable(), corners.MoveToImmutable());
    }

    /// <summary>Removes vertices within flat regions and straight edges, which leaves the surface as it is.</summary>
    public static Mesh RemoveFlatVertices(Mesh mesh)
    {
        var corners = mesh.VertexIndices.ToArray();
        var facesAt = Enumerable.Range(0, mesh.VertexCount).Select(_ => new List<int>()).ToArray();
        for (var corner = 0; corner < corners.Length; corner++)
        {
            facesAt[corners[corner]].Add(corner / 3);
        }

        var pending = new Queue<int>(Enumerable.Range(0, mesh.VertexCount));
        while (pending.TryDequeue(out var vertex))
        {
            var faces = facesAt[vertex].ToArray();
            var neighbours = faces.SelectMany(face => corners[(3 * face)..((3 * face) + 3)]).Where(corner => corner != vertex)
                .Distinct().Order().ToArray();
            var target = Array.FindIndex(neighbours, neighbour => CanCollapse(mesh, corners, faces, vertex, neighbour));
            if (target < 0 || faces.Length == 0)
            {
                continue;
            }

            foreach (var face in faces)
            {
                var own = corners.AsSpan(3 * face, 3);
                if (own.Contains(neighbours[target]))
                {
                    foreach (var corner in own)
                    {
                        facesAt[corner].Remove(face);
                    }

                    own.Clear();
                }
                else
                {
                    own[own.IndexOf(vertex)] = neighbours[target];
                    facesAt[neighbours[target]].Add(face);
                }
            }

            facesAt[vertex].Clear();
            foreach (var neighbour in neighbours)
            {
                pending.Enqueue(neighbour);
            }
        }

        return new(mesh.Positions, [.. Enumerable.Range(0, mesh.FaceCount)
            .Where(face => corners[3 * face] != corners[(3 * face) + 1]).SelectMany(face => corners[(3 * face)..((3 * face) + 3)])]);
    }

    /// <summary>
    /// Whether the surface stays as it is where a vertex moves along an edge to its end: each face that stays remains in its plane without
    /// turning, and the two faces that vanish are covered by the others.
    /// </summary>
    private static bool CanCollapse(Mesh mesh, int[] corners, int[] faces, int vertex, int target)
    {
        var (before, after) = (0.0, 0.0);
        foreach (var face in faces)
        {
            var own = corners[(3 * face)..((3 * face) + 3)];
            var normal = NormalOf(mesh, own);
            before += normal.Length();
            if (Array.IndexOf(own, target) >= 0)
            {
                continue;
            }

            own[Array.IndexOf(own, vertex)] = target;
            var moved = NormalOf(mesh, own);
            after += moved.Length();
            if (Vector.Dot(normal, moved) <= 0 || Vector.Cross(normal, moved).Length() > MaxSine * normal.Length() * moved.Length())
            {
                return false;
            }
        }

        return after > 0 && Math.Abs(after - before) <= MaxSine * before;
    }

    private static Vector NormalOf(Mesh mesh, int[] face) =>
        Vector.Cross(mesh.Vertex(face[1]) - mesh.Vertex(face[0]), mesh.Vertex(face[2]) - mesh.Vertex(face[0]));
}
