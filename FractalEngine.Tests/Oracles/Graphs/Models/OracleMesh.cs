using System.Collections.Immutable;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>A base mesh of a model: corners and triangles, and the file that holds it.</summary>
/// <param name="Name">Its name in messages.</param>
/// <param name="Path">Path of its file from the folder of the model; empty for a shape, which has a name only.</param>
/// <param name="Vertices">Positions, which triangles need not use.</param>
/// <param name="Indices">Indices of vertices, [triangles × 3].</param>
internal sealed record OracleMesh(string Name, string Path, ImmutableArray<Vector> Vertices, ImmutableArray<int> Indices)
{
    /// <summary>The names of all shapes of the language.</summary>
    public static readonly ImmutableArray<string> ShapeNames = ["box", "ball", "plate", "tetrahedron", "cylinder", "cone"];

    private static readonly ImmutableDictionary<string, OracleMesh> Shapes = ShapeNames.ToImmutableDictionary(name => name, ReadShape);

    /// <summary>Number of triangles of the mesh.</summary>
    public int FaceCount => Indices.Length / 3;

    /// <summary>Finds the mesh of a shape. What shapes look like is taken from the library: nothing else says how they are cut.</summary>
    public static OracleMesh Shape(string name) => Shapes[name];

    private static OracleMesh ReadShape(string name)
    {
        Assert.True(BaseShapes.TryFind(name, out var mesh));
        return new(name, "", [.. Enumerable.Range(0, mesh!.VertexCount).Select(mesh.Vertex)], mesh.VertexIndices);
    }
}
