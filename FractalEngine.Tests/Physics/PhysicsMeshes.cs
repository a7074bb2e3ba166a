using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Things for bodies to run into.</summary>
internal static class PhysicsMeshes
{
    /// <summary>Side 1 about the origin, faces outwards.</summary>
    public static Mesh Cube { get; } = Samples.ParseObj(SampleFiles.Cube).Mesh;

    /// <summary>The same as a room: faces inwards.</summary>
    public static Mesh InwardCube { get; } = FlipWinding(Cube);

    public static Mesh FlipWinding(Mesh mesh) => new(mesh.Positions, [.. mesh.VertexIndices.Chunk(3).SelectMany(face => face.Reverse())]);

    public static Mesh Scale(Mesh mesh, double factor) => mesh.Transform(v => factor * v);

    public static Mesh FromTriangles(params (Vector A, Vector B, Vector C)[] faces) => new(
        [.. faces.SelectMany(face => new[] { face.A, face.B, face.C }).SelectMany(v => new[] { v.X, v.Y, v.Z })],
        [.. Enumerable.Range(0, 3 * faces.Length)]);

    public static (Vector A, Vector B, Vector C)[] TrianglesOf(Mesh mesh) => [.. Enumerable.Range(0, mesh.FaceCount).Select(mesh.Face)];

    /// <summary>One large face through a point, the point well within it; its winding gives the normal.</summary>
    public static (Vector A, Vector B, Vector C) PlaneTriangle(Vector point, Vector normal, double size = 100)
    {
        var side = Vector.Cross(normal, Math.Abs(normal.X) < 0.9 * normal.Length() ? Vector.I : Vector.J).UnitVector();
        var other = Vector.Cross(normal, side).UnitVector();
        return (point + (size * side), point + (size * ((-0.5 * side) + (0.8 * other))), point + (size * ((-0.6 * side) - (0.9 * other))));
    }

    /// <summary>At y = 0, upwards.</summary>
    public static Mesh FloorMesh(double size = 100) => FromTriangles(PlaneTriangle(Vector.Zero, Vector.J, size));
}
