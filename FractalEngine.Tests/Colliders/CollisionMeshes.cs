using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>Creates meshes that colliders are tested on, and positions around them.</summary>
internal static class CollisionMeshes
{
    /// <summary>The meshes by names that say what is unusual about them.</summary>
    public static IReadOnlyDictionary<string, Func<Mesh>> All { get; } = new Dictionary<string, Func<Mesh>>
    {
        ["one face"] = () => TriangleSoup(1, 1, 1),
        ["five faces"] = () => TriangleSoup(2, 5, 1),
        ["nine faces"] = () => TriangleSoup(3, 9, 1),
        ["fifty faces"] = () => TriangleSoup(4, 50, 0.5),
        ["sixty-five faces"] = () => TriangleSoup(5, 65, 0.5),
        ["soup"] = () => TriangleSoup(6, 3000, 0.1),
        ["soup of large faces"] = () => TriangleSoup(7, 500, 5),
        ["tiny soup"] = () => TriangleSoup(8, 400, 0.1).Transform(v => 1e-30 * v),
        ["huge soup"] = () => TriangleSoup(9, 400, 0.1).Transform(v => 1e30 * v),
        ["soup far away"] = () => TriangleSoup(10, 1000, 0.1).Transform(v => v + new Vector(1e6, -3e6, 2e6)),
        ["needles"] = () => AdversarialSoup(11, 400),
        ["flat grid"] = () => Grid(40, (_, _) => 0),
        ["rough grid"] = () => Grid(40, (x, y) => Math.Sin(x) * Math.Cos(y)),
        ["coincident faces"] = () => Repeat(TriangleSoup(12, 1, 1), 300),
        ["points"] = () => Repeat(FromTriangles([(Vector.One, Vector.One, Vector.One)]), 100),
        ["sizes from 1e-15 to 1"] = () => FromTriangles(
            Enumerable.Range(0, 200).Select(i => Math.Pow(0.84, i)).Select(s => (s * Vector.I, s * Vector.J, s * Vector.K))),
        ["sphere"] = () => MeshGenerators.Create("icosphere", 1, 1280),
        ["terrain"] = () => MeshGenerators.Create("terrain", 1, 5000),
        ["knot"] = () => MeshGenerators.Create("torus-knot", 1, 4000),
    };

    /// <summary>The names of all meshes, for theories.</summary>
    public static TheoryData<string> Names => [.. All.Keys];

    /// <summary>Creates unconnected random triangles in the cube from −1 to 1.</summary>
    /// <param name="seed">Seed of the random numbers.</param>
    /// <param name="faces">Number of triangles.</param>
    /// <param name="size">Maximum extent of an edge along each axis.</param>
    public static Mesh TriangleSoup(int seed, int faces, double size)
    {
        var random = new Random(seed);
        return FromTriangles(Enumerable.Range(0, faces).Select(_ =>
        {
            var a = AdversarialTriangle.RandomInCube(random);
            var b = a + (size * AdversarialTriangle.RandomInCube(random));
            var c = a + (size * AdversarialTriangle.RandomInCube(random));
            return (a, b, c);
        }));
    }

    /// <summary>Draws a position: far, near, on a vertex, an edge or a triangle, or in the box.</summary>
    public static Vector RandomPosition(Random random, Mesh mesh)
    {
        var bounds = mesh.Bounds;
        var diagonal = mesh.Bounds.Diagonal;
        var (a, b, c) = mesh.Face(random.Next(mesh.FaceCount));
        var (u, v) = random.Barycentrics();
        var inside = a + (u * (b - a)) + (v * (c - a));
        return random.Next(8) switch
        {
            0 => bounds.Centre + (Math.Pow(10, random.Next(0, 8)) * diagonal * AdversarialTriangle.RandomInCube(random)),
            1 => a,
            2 => 0.5 * (a + b),
            3 => a + (u * (b - a)),
            4 => inside,
            5 => inside + (Math.Pow(10, random.Next(-12, 0)) * diagonal * AdversarialTriangle.RandomInCube(random)),
            6 => bounds.Centre,
            _ => bounds.Minimum + bounds.Size.Stretch(new(random.NextDouble(), random.NextDouble(), random.NextDouble())),
        };
    }

    private static Mesh AdversarialSoup(int seed, int faces)
    {
        var random = new Random(seed);
        // Triangles of one scale, so that they fit in one mesh.
        return FromTriangles(Enumerable.Range(0, int.MaxValue).Select(_ => AdversarialTriangle.Random(random))
            .Where(triangle => triangle.Magnitude is > 0.1 and < 10)
            .Take(faces).Select(triangle => (triangle.A, triangle.B, triangle.C)));
    }

    private static Mesh Repeat(Mesh mesh, int times) =>
        new(mesh.Positions, [.. Enumerable.Repeat(mesh.VertexIndices, times).SelectMany(faces => faces)]);

    private static Mesh FromTriangles(IEnumerable<(Vector A, Vector B, Vector C)> triangles)
    {
        var vertices = triangles.SelectMany(triangle => new[] { triangle.A, triangle.B, triangle.C });
        var positions = vertices.SelectMany(v => new[] { v.X, v.Y, v.Z }).ToArray();
        return new([.. positions], [.. Enumerable.Range(0, positions.Length / 3)]);
    }

    private static Mesh Grid(int side, Func<double, double, double> height) => new(
        [.. from i in Enumerable.Range(0, side + 1)
            from j in Enumerable.Range(0, side + 1)
            from coordinate in new[] { i, height(i, j), j }
            select coordinate],
        [.. from i in Enumerable.Range(0, side)
            from j in Enumerable.Range(0, side)
            let first = (i * (side + 1)) + j
            from vertex in new[] { first, first + 1, first + side + 1, first + 1, first + side + 2, first + side + 1 }
            select vertex]);
}
