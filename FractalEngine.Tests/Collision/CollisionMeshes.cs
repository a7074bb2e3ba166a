using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Collision;

/// <summary>Meshes that colliders are tested on, and positions around them.</summary>
internal static class CollisionMeshes
{
    public static IReadOnlyDictionary<string, Func<Mesh>> All { get; } = new Dictionary<string, Func<Mesh>>
    {
        ["one face"] = () => Soup(1, 1, 1),
        ["five faces"] = () => Soup(2, 5, 1),
        ["nine faces"] = () => Soup(3, 9, 1),
        ["fifty faces"] = () => Soup(4, 50, 0.5),
        ["sixty-five faces"] = () => Soup(5, 65, 0.5),
        ["soup"] = () => Soup(6, 3000, 0.1),
        ["soup of large faces"] = () => Soup(7, 500, 5),
        ["tiny soup"] = () => Soup(8, 400, 0.1).Transform(v => 1e-30 * v),
        ["huge soup"] = () => Soup(9, 400, 0.1).Transform(v => 1e30 * v),
        ["soup far away"] = () => Soup(10, 1000, 0.1).Transform(v => v + new Vector(1e6, -3e6, 2e6)),
        ["needles"] = () => Nasty(11, 400),
        ["flat grid"] = () => Grid(40, (_, _) => 0),
        ["rough grid"] = () => Grid(40, (x, y) => Math.Sin(x) * Math.Cos(y)),
        ["coincident faces"] = () => Repeat(Soup(12, 1, 1), 300),
        ["points"] = () => Repeat(FromFaces([(Vector.One, Vector.One, Vector.One)]), 100),
        ["sizes from 1e-15 to 1"] = () => FromFaces(Enumerable.Range(0, 200).Select(i => Math.Pow(0.84, i))
        .Select(s => (s * Vector.I, s * Vector.J, s * Vector.K))),
        ["sphere"] = () => MeshGenerators.Create("icosphere", 1, 1280),
        ["terrain"] = () => MeshGenerators.Create("terrain", 1, 5000),
        ["knot"] = () => MeshGenerators.Create("torus-knot", 1, 4000),
    };

    public static TheoryData<string> Names => [.. All.Keys];

    /// <summary>Null where there are no files beside the checkout.</summary>
    public static Mesh? Scan(string file) => SharedModels.Folder is { } folder
        ? ObjParser.Parse(SourceText.Read(Path.Combine(folder, file), file, ParsingLimits.ObjBytes, acceptLatin1: true)).Mesh
        : null;

    public static Mesh Soup(int seed, int faces, double size) => new Random(seed) switch
    {
        var random => FromFaces(Enumerable.Range(0, faces).Select(_ => NastyFace.Cube(random)).Select(corner =>
            (corner, corner + (size * NastyFace.Cube(random)), corner + (size * NastyFace.Cube(random))))),
    };

    /// <summary>A position: far, near, on a corner, an edge or a face, or in the box.</summary>
    public static Vector Position(Random random, Mesh mesh)
    {
        var (bounds, diagonal) = (mesh.Bounds, mesh.Bounds.Diagonal);
        var (a, b, c) = mesh.Face(random.Next(mesh.FaceCount));
        var (u, v) = (random.NextDouble(), random.NextDouble());
        (u, v) = u + v > 1 ? (1 - u, 1 - v) : (u, v);
        var inside = a + (u * (b - a)) + (v * (c - a));
        return random.Next(8) switch
        {
            0 => bounds.Centre + (Math.Pow(10, random.Next(0, 8)) * diagonal * NastyFace.Cube(random)),
            1 => a,
            2 => 0.5 * (a + b),
            3 => a + (u * (b - a)),
            4 => inside,
            5 => inside + (Math.Pow(10, random.Next(-12, 0)) * diagonal * NastyFace.Cube(random)),
            6 => bounds.Centre,
            _ => bounds.Minimum + bounds.Size.Stretch(new(random.NextDouble(), random.NextDouble(), random.NextDouble())),
        };
    }

    private static Mesh Nasty(int seed, int faces) => new Random(seed) switch
    {
        // Those that stand at the scale of 1, so that one mesh holds them all.
        var random =>
            FromFaces(Enumerable.Range(0, int.MaxValue).Select(_ => NastyFace.Random(random))
            .Where(face => face.Magnitude is > 0.1 and < 10)
            .Take(faces).Select(face => (face.A, face.B, face.C))),
    };

    private static Mesh Repeat(Mesh mesh, int times) =>
        new(mesh.Positions, [.. Enumerable.Repeat(mesh.VertexIndices, times).SelectMany(faces => faces)]);

    private static Mesh FromFaces(IEnumerable<(Vector A, Vector B, Vector C)> faces)
    {
        var positions = faces.SelectMany(face => new[] { face.A, face.B, face.C }).SelectMany(v => new[] { v.X, v.Y, v.Z }).ToArray();
        return new([.. positions], [.. Enumerable.Range(0, positions.Length / 3)]);
    }

    private static Mesh Grid(int side, Func<double, double, double> height) => new(
        [.. from i in Enumerable.Range(0, side + 1) from j in Enumerable.Range(0, side + 1) from x in new[] { i, height(i, j),
        j } select x],
        [.. from i in Enumerable.Range(0, side)
            from j in Enumerable.Range(0, side)
            let corner = (i * (side + 1)) + j
            from vertex in new[] { corner, corner + 1, corner + side + 1, corner + 1, corner + side + 2, corner + side + 1 }
            select vertex]);
}
