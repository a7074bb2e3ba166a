using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Elements;

/// <summary>Splits a mesh into its elements: faces that are connected by vertices.</summary>
internal static class ElementFinder
{
    /// <summary>Finds the elements, in the order of their first faces.</summary>
    /// <param name="mesh">The mesh; faces without area are left out.</param>
    /// <param name="weldPositions">Whether vertices at the same position connect, or only those with the same index.</param>
    public static List<Element> Find(Mesh mesh, bool weldPositions)
    {
        var representatives = VertexWelding.FindRepresentatives(mesh);
        var connected = new DisjointSets();
        connected.Reset(mesh.VertexCount);
        for (var vertex = 0; weldPositions && vertex < representatives.Length; vertex++)
        {
            connected.Join(vertex, representatives[vertex]);
        }

        var faces = Enumerable.Range(0, mesh.FaceCount).Where(face => HasArea(mesh, face)).ToArray();
        foreach (var face in faces)
        {
            connected.Join(mesh.VertexIndices[3 * face], mesh.VertexIndices[(3 * face) + 1]);
            connected.Join(mesh.VertexIndices[3 * face], mesh.VertexIndices[(3 * face) + 2]);
        }

        return [.. faces.GroupBy(face => connected.RootOf(mesh.VertexIndices[3 * face]))
            .Select(group => Create(mesh, representatives, [.. group])).OfType<Element>()];
    }

    private static Element? Create(Mesh mesh, int[] representatives, int[] faces)
    {
        var vertices = new Dictionary<int, int>();
        var corners = new int[3 * faces.Length];
        for (var corner = 0; corner < corners.Length; corner++)
        {
            var vertex = representatives[mesh.VertexIndices[(3 * faces[corner / 3]) + (corner % 3)]];
            vertices.TryAdd(vertex, vertices.Count);
            corners[corner] = vertices[vertex];
        }

        return ElementShape.Create([.. vertices.Keys.Select(mesh.Vertex)]) is { } shape ? new(shape, corners) : null;
    }

    private static bool HasArea(Mesh mesh, int face)
    {
        var (a, b, c) = mesh.Face(face);
        return Vector.Cross(b - a, c - a) != Vector.Zero;
    }
}
