using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Makes closed meshes for rigid bodies, and tells where their points are.</summary>
internal static class RigidMeshes
{
    /// <summary>An L of three unit squares, whose first corner sees all others.</summary>
    private static readonly (double X, double Y)[] OutlineOfL = [(1, 1), (1, 2), (0, 2), (0, 0), (2, 0), (2, 1)];

    public static Mesh Box(double x, double y, double z) => Box(-0.5 * new Vector(x, y, z), 0.5 * new Vector(x, y, z));

    public static Mesh Box(Vector minimum, Vector maximum) => Shapes.Box(new(minimum, maximum));

    /// <summary>An L in the plane of x and y whose arms are 2 long and 1 wide, without faces inside.</summary>
    public static Mesh CreateL(double depth = 1) => Prism(OutlineOfL, depth);

    /// <summary>The two boxes that fill <see cref="CreateL"/>.</summary>
    public static Mesh[] BoxesOfL(double depth = 1) =>
        [Box(Vector.Zero, new(2, 1, depth)), Box(new(0, 1, 0), new(1, 2, depth))];

    /// <summary>Four boxes around a square hole, the axis of which is y.</summary>
    public static Mesh[] BoxesOfFrame(double outer, double inner, double height)
    {
        var (o, i, h) = (0.5 * outer, 0.5 * inner, 0.5 * height);
        return
        [
            Box(new(-o, -h, -o), new(o, h, -i)), Box(new(-o, -h, i), new(o, h, o)),
            Box(new(-o, -h, -i), new(-i, h, i)), Box(new(i, -h, -i), new(o, h, i)),
        ];
    }

    /// <summary>All faces of several meshes in one.</summary>
    public static Mesh Join(params IEnumerable<Mesh> meshes) =>
        PhysicsMeshes.FromTriangles([.. meshes.SelectMany(PhysicsMeshes.TrianglesOf)]);

    /// <summary>A prism from z = 0 upwards.</summary>
    /// <param name="outline">Counter-clockwise; the first corner sees all others.</param>
    /// <param name="depth">Length along z.</param>
    public static Mesh Prism((double X, double Y)[] outline, double depth)
    {
        var count = outline.Length;
        List<int> indices = [];
        for (var i = 0; i < count; i++)
        {
            var next = (i + 1) % count;
            indices.AddRange([i, next, count + next, i, count + next, count + i]);
            if (i > 0 && next > 0)
            {
                indices.AddRange([0, next, i, count, count + i, count + next]);
            }
        }

        return new(
            [.. outline.SelectMany(p => new[] { p.X, p.Y, 0 }), .. outline.SelectMany(p => new[] { p.X, p.Y, depth })], [.. indices]);
    }

    /// <summary>A solid of revolution about y.</summary>
    /// <param name="profile">Distance from the axis and height: from the axis below, counter-clockwise, to the axis above.</param>
    /// <param name="sides">Number of faces around the axis.</param>
    public static Mesh Revolve((double Radius, double Y)[] profile, int sides)
    {
        int Index(int ring, int side) => (ring * sides) + (profile[ring].Radius > 0 ? side % sides : 0);
        List<int> indices = [];
        for (var ring = 0; ring + 1 < profile.Length; ring++)
        {
            for (var side = 0; side < sides; side++)
            {
                var (a, b) = (Index(ring, side), Index(ring, side + 1));
                var (d, c) = (Index(ring + 1, side), Index(ring + 1, side + 1));
                indices.AddRange(c != d ? [a, d, c] : []);
                indices.AddRange(a != b ? [a, c, b] : []);
            }
        }

        return new(
            [.. from point in profile
                from side in Enumerable.Range(0, sides)
                let angle = 2 * Math.PI * side / sides
                from coordinate in new[] { point.Radius * Math.Cos(angle), point.Y, point.Radius * Math.Sin(angle) }
                select coordinate],
            [.. indices]);
    }

    public static BodyDescription Describe(Mesh mesh, Vector position, Matrix? linear = null) =>
        new(position, new MeshShape(Model.Of(mesh), linear));

    /// <summary>Where a point of a body's model is in the world.</summary>
    public static Vector PointOf(Body body, Vector point)
    {
        var shape = body.Description.Mesh!;
        return body.Position + body.Orientation.Rotate((shape.Linear * point) - shape.Centre);
    }

    /// <summary>Height of the lowest vertex of a body that is made of a mesh.</summary>
    public static double LowestPoint(Body body)
    {
        var mesh = body.Description.Mesh!.Model.Mesh;
        return Enumerable.Range(0, mesh.VertexCount).Min(vertex => PointOf(body, mesh.Vertex(vertex)).Y);
    }
}
