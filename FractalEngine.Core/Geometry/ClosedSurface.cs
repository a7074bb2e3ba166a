using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>Tells whether a mesh is a solid's skin. From outside, the back faces of such a mesh are never seen and need not be drawn.</summary>
public static class ClosedSurface
{
    /// <summary>
    /// True when every edge is passed as often in one direction as in the other, vertices at the same place taken as one, and every
    /// connected part is wound outwards. False proves nothing: a hollow solid's inner skin is wound inwards.
    /// </summary>
    /// <remarks>Cost O(faces): about 0.2 s for 300,000.</remarks>
    public static bool IsSolid(Mesh mesh)
    {
        var (corners, positions) = Weld(mesh);
        var balance = new Dictionary<(int From, int To), int>(corners.Length);
        var parts = new int[positions];
        for (var i = 0; i < parts.Length; i++)
        {
            parts[i] = i;
        }

        for (var i = 0; i < corners.Length; i++)
        {
            var (from, to) = (corners[i], corners[i % 3 == 2 ? i - 2 : i + 1]);
            CollectionsMarshal.GetValueRefOrAddDefault(balance, from < to ? (from, to) : (to, from), out _) += Math.Sign(to - from);
            parts[PartOf(parts, from)] = PartOf(parts, to);
        }

        return mesh.FaceCount > 0 && balance.Values.All(static count => count == 0) && AreWoundOutwards(mesh, corners, parts);
    }

    private static (int[] Corners, int Positions) Weld(Mesh mesh)
    {
        var numbers = new Dictionary<Vector, int>(mesh.VertexCount);
        var corners = new int[mesh.Faces.Length];
        for (var i = 0; i < corners.Length; i++)
        {
            ref var number = ref CollectionsMarshal.GetValueRefOrAddDefault(numbers, mesh.Vertex(mesh.Faces[i]), out var exists);
            corners[i] = number = exists ? number : numbers.Count - 1;
        }

        return (corners, numbers.Count);
    }

    /// <summary>The representative of a vertex's connected part, with the paths to it halved on the way.</summary>
    private static int PartOf(int[] parts, int vertex)
    {
        while (parts[vertex] != vertex)
        {
            vertex = parts[vertex] = parts[parts[vertex]];
        }

        return vertex;
    }

    private static bool AreWoundOutwards(Mesh mesh, int[] corners, int[] parts)
    {
        var volumes = new Dictionary<int, double>();
        var middle = mesh.Bounds.Centre;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            CollectionsMarshal.GetValueRefOrAddDefault(volumes, PartOf(parts, corners[3 * face]), out _) +=
                Vector.Dot(a - middle, Vector.Cross(b - middle, c - middle));
        }

        // Flat parts have a volume of rounding errors only and don't count as solid.
        var size = mesh.Bounds.Diagonal;
        return volumes.Values.All(volume => volume > 1e-12 * size * size * size);
    }
}
