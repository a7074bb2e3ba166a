using System.Collections.Immutable;
using System.Diagnostics.CodeAnalysis;
using FractalEngine.Core.Generation.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>The shapes that files of fractals name in place of a mesh. Each fits a cube of side 1 around the origin.</summary>
public static class BaseShapes
{
    private const int Sides = 24;
    private const int BallSubdivisions = 2;

    private static readonly ImmutableArray<(string Name, Lazy<Mesh> Mesh)> All =
    [
        ("box", new(Shapes.Cube)),
        ("ball", new(static () => Scale(Shapes.Sphere(BallSubdivisions), 0.5))),
        ("plate", new(static () => Shapes.Square())),
        ("tetrahedron", new(static () => Scale(Shapes.Tetrahedron(), 0.5 * Math.Sqrt(3)))),
        ("cylinder", new(static () => Column(isPointed: false))),
        ("cone", new(static () => Column(isPointed: true))),
    ];

    /// <summary>The names, in the order of a listing.</summary>
    public static IEnumerable<string> Names => All.Select(static shape => shape.Name);

    /// <summary>Finds the mesh of a shape, always the same one.</summary>
    public static bool TryFind(string name, [NotNullWhen(true)] out Mesh? mesh)
    {
        mesh = All.FirstOrDefault(shape => shape.Name == name).Mesh?.Value;
        return mesh is not null;
    }

    /// <summary>Returns the name of the shape that a mesh was found as; null for other meshes.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="isPainted">Whether it may have got a material since, and texture coordinates for that.</param>
    public static string? NameOf(Mesh mesh, bool isPainted = false) => All.FirstOrDefault(shape => shape.Mesh.IsValueCreated
        && (ReferenceEquals(shape.Mesh.Value, mesh) || (isPainted && shape.Mesh.Value.Positions == mesh.Positions))).Name;

    private static Mesh Scale(Mesh mesh, double factor)
    {
        var scaled = new Mesh([.. mesh.Positions.Select(x => factor * x)], mesh.VertexIndices);
        return mesh.Normals.IsEmpty ? scaled : scaled.WithNormals(mesh.Normals, mesh.NormalIndices)
            .WithTextureCoordinates(mesh.TextureCoordinates, mesh.TextureIndices);
    }

    /// <summary>Makes a cylinder along y, or a cone that points upwards, with smooth sides.</summary>
    private static Mesh Column(bool isPointed)
    {
        var mesh = new MeshBuilder();
        var (low, high) = (new MeshCorner[Sides + 1], new MeshCorner[Sides + 1]);
        for (var side = 0; side <= Sides; side++)
        {
            // The last corners have the positions of the first, and other texture coordinates.
            low[side] = AddCorner(mesh, side, 0, side == Sides ? low[0].PositionIndex : null);
            high[side] = AddCorner(mesh, side, 1, side == Sides && !isPointed ? high[0].PositionIndex : null, isPointed ? 0 : 0.5);
        }

        var (bottom, top) = (AddCorner(mesh, 0, 0, null, 0), AddCorner(mesh, 0, 1, null, 0));
        for (var side = 0; side < Sides; side++)
        {
            mesh.SmoothingGroup = 1;
            mesh.AddTriangle(low[side], high[side], low[side + 1]);
            if (!isPointed)
            {
                mesh.AddTriangle(high[side], high[side + 1], low[side + 1]);
                mesh.SmoothingGroup = 0;
                mesh.AddTriangle(top, high[side + 1], high[side]);
            }

            mesh.SmoothingGroup = 0;
            mesh.AddTriangle(bottom, low[side], low[side + 1]);
        }

        return mesh.Build();
    }

    private static MeshCorner AddCorner(MeshBuilder mesh, int side, int height, int? position, double radius = 0.5)
    {
        var (sine, cosine) = SineCosine.FromDegrees(360.0 / Sides * side);
        return new(
            position ?? mesh.AddPosition(new(radius * cosine, height - 0.5, radius * sine)),
            mesh.AddTextureCoordinate((double)side / Sides, height));
    }
}
