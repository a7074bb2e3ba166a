using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>What is done with whole meshes in several places: making, moving and turning them.</summary>
internal static class MeshTools
{
    /// <summary>Makes a mesh of positions and indices.</summary>
    public static Mesh Create(IReadOnlyList<Vector> positions, IReadOnlyCollection<int> indices)
    {
        var coordinates = ImmutableArray.CreateBuilder<double>(3 * positions.Count);
        for (var i = 0; i < positions.Count; i++)
        {
            var (x, y, z) = positions[i];
            coordinates.Add(x);
            coordinates.Add(y);
            coordinates.Add(z);
        }

        return new(coordinates.MoveToImmutable(), [.. indices]);
    }

    /// <summary>Lists the positions of all vertices of a mesh.</summary>
    public static Vector[] Positions(Mesh mesh)
    {
        var positions = new Vector[mesh.VertexCount];
        for (var i = 0; i < positions.Length; i++)
        {
            positions[i] = mesh.Vertex(i);
        }

        return positions;
    }

    /// <summary>Makes the image of a mesh under a map; faces of mirrored images are turned, so that their fronts stay fronts.</summary>
    public static Mesh Move(Mesh mesh, AffineMap map)
    {
        var image = Create([.. Positions(mesh).Select(position => map * position)], mesh.VertexIndices);
        return map.Linear.Determinant() < 0 ? TurnFaces(image) : image;
    }

    /// <summary>Makes the same mesh with the back of each face as its front.</summary>
    public static Mesh TurnFaces(Mesh mesh)
    {
        var indices = mesh.VertexIndices.ToArray();
        for (var i = 0; i < indices.Length; i += 3)
        {
            (indices[i + 1], indices[i + 2]) = (indices[i + 2], indices[i + 1]);
        }

        return new(mesh.Positions, [.. indices]);
    }

    /// <summary>Computes the volume within a closed mesh; it is negative where the fronts of its faces look inwards.</summary>
    public static double SignedVolume(Mesh mesh)
    {
        var centre = mesh.Bounds.Centre;
        var volume = 0.0;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            volume += Vector.Dot(a - centre, Vector.Cross(b - centre, c - centre)) / 6;
        }

        return volume;
    }

    /// <summary>Computes the least altitude of a face: twice its area divided by its longest edge; infinite without faces.</summary>
    public static double SmallestAltitude(Mesh mesh)
    {
        var smallest = double.PositiveInfinity;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var longest = Math.Max((b - a).Length(), Math.Max((c - b).Length(), (a - c).Length()));
            smallest = Math.Min(smallest, Vector.Cross(b - a, c - a).Length() / longest);
        }

        return smallest;
    }

    /// <summary>Makes the mesh of some faces of another one, with the vertices that they use, in the order of their first use.</summary>
    public static Mesh TakeFaces(IReadOnlyList<Vector> positions, IReadOnlyList<int> indices)
    {
        var places = new int[positions.Count];
        Array.Fill(places, -1);
        var used = new List<Vector>();
        var taken = new int[indices.Count];
        for (var i = 0; i < taken.Length; i++)
        {
            var vertex = indices[i];
            if (places[vertex] < 0)
            {
                places[vertex] = used.Count;
                used.Add(positions[vertex]);
            }

            taken[i] = places[vertex];
        }

        return Create(used, taken);
    }
}
