using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Makes meshes for bodies to collide with.</summary>
internal static class PhysicsMeshes
{
    /// <summary>A cube of side 1 about the origin, faces outwards.</summary>
    public static Mesh Cube { get; } = Samples.ParseObj(SampleFiles.Cube).Mesh;

    /// <summary>The same cube as a room, faces inwards.</summary>
    public static Mesh InwardCube { get; } = FlipWinding(Cube);

    public static Mesh FlipWinding(Mesh mesh) => new(mesh.Positions, [.. mesh.VertexIndices.Chunk(3).SelectMany(face => face.Reverse())]);

    public static Mesh Scale(Mesh mesh, double factor) => mesh.Transform(v => factor * v);

    public static Mesh FromTriangles(params (Vector A, Vector B, Vector C)[] faces) => new(
        [.. faces.SelectMany(face => new[] { face.A, face.B, face.C }).SelectMany(v => new[] { v.X, v.Y, v.Z })],
        [.. Enumerable.Range(0, 3 * faces.Length)]);

    public static (Vector A, Vector B, Vector C)[] TrianglesOf(Mesh mesh) => [.. Enumerable.Range(0, mesh.FaceCount).Select(mesh.Face)];

    /// <summary>Makes one large face with a point well inside it, wound about a normal.</summary>
    public static (Vector A, Vector B, Vector C) PlaneTriangle(Vector point, Vector normal, double size = 100)
    {
        var side = Vector.Cross(normal, Math.Abs(normal.X) < 0.9 * normal.Length() ? Vector.I : Vector.J).UnitVector();
        var other = Vector.Cross(normal, side).UnitVector();
        return (point + (size * side), point + (size * ((-0.5 * side) + (0.8 * other))), point + (size * ((-0.6 * side) - (0.9 * other))));
    }

    /// <summary>Makes one large face at y = 0 that faces upwards.</summary>
    public static Mesh FloorMesh(double size = 100) => FromTriangles(PlaneTriangle(Vector.Zero, Vector.J, size));

    /// <summary>Makes the sponge of side 1 about the origin: 20 of 27 cubes, and so on.</summary>
    public static Fractal CreateSponge(int? depth) => Fractal.Of(Shapes.Cube()).Repeat(
        [.. from x in new[] { -1, 0, 1 }
            from y in new[] { -1, 0, 1 }
            from z in new[] { -1, 0, 1 }
            where (x * x) + (y * y) + (z * z) > 1
            select Transformation.At(new Vector(x, y, z) / 3, 1 / 3.0)],
        depth);
}
