using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Distances;

/// <summary>Surfaces whose distances are known, and changes of surfaces.</summary>
internal static class SurfaceTools
{
    /// <summary>The square from 0 to 1 along x and z, in cells that are divided along one of their diagonals.</summary>
    /// <param name="cells">Cells along each side.</param>
    /// <param name="random">Moves inner vertices by up to a fifth of a cell, and draws diagonals; null for a regular grid.</param>
    public static Mesh CreateGrid(int cells, Random? random = null)
    {
        List<double> positions = [];
        List<int> indices = [];
        for (var vertex = 0; vertex < (cells + 1) * (cells + 1); vertex++)
        {
            positions.AddRange([Coordinate(vertex % (cells + 1)), 0, Coordinate(vertex / (cells + 1))]);
        }

        for (var cell = 0; cell < cells * cells; cell++)
        {
            var a = (cell / cells * (cells + 1)) + (cell % cells);
            var (b, c, d) = (a + 1, a + cells + 1, a + cells + 2);
            indices.AddRange(random?.Next(2) == 1 ? [a, d, b, a, c, d] : [a, c, b, b, c, d]);
        }

        return new([.. positions], [.. indices]);

        double Coordinate(int line) =>
            (line + (random is null || line == 0 || line == cells ? 0 : 0.4 * (random.NextDouble() - 0.5))) / cells;
    }

    /// <summary>Moves one vertex, and leaves the others.</summary>
    public static Mesh MoveVertex(Mesh mesh, int vertex, Vector offset)
    {
        double[] positions = [.. mesh.Positions];
        for (var axis = 0; axis < 3; axis++)
        {
            positions[(3 * vertex) + axis] += offset.Component(axis);
        }

        return new([.. positions], mesh.VertexIndices);
    }

    /// <summary>Puts the faces of two meshes into one.</summary>
    public static Mesh Join(Mesh mesh1, Mesh mesh2) => new(
        [.. mesh1.Positions, .. mesh2.Positions],
        [.. mesh1.VertexIndices, .. mesh2.VertexIndices.Select(index => mesh1.VertexCount + index)]);

    /// <summary>Puts the faces of a mesh in another order.</summary>
    public static Mesh Shuffle(Mesh mesh, Random random)
    {
        int[] faces = [.. Enumerable.Range(0, mesh.FaceCount)];
        random.Shuffle(faces);
        return new(mesh.Positions, [.. faces.SelectMany(face => mesh.VertexIndices.Skip(3 * face).Take(3))]);
    }
}
