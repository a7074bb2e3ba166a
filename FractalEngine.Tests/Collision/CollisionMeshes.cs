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
        ["sizes from 1e-15 to 1"] = () => FromTriangles(Enumerable.Range(0, 200).Select(i => Math.Pow(0.84, i))
        .Select(s => (s * Vector.I, s * Vector.J, s * Vector.K))),
        ["sphere"] = () => MeshGenerators.Create("icosphere", 1, 1280),
        ["terrain"] = () => MeshGenerators.Create("terrain", 1, 5000),
        ["knot"] = () => MeshGenerators.Create("torus-knot", 1, 4000),
    };

    public static TheoryData<string> Names => [.. All.Keys];

    /// <summary>Null where there are no files beside the checkout.</summary>
    public static Mesh? LoadScan(string file) => SharedModels.Folder is { } folder
        ? ObjParser.Parse(SourceText.Read(Path.Combine(folder, file), file, ParsingLimits.MaxObjBytes, acceptLatin1: true)).Mesh
        : null;

    public static Mesh TriangleSoup(int seed, int faces, double size) => new Random(seed) switch
    {
        var random => FromTriangles(Enumerable.Range(0, faces).Select(_ => AdversarialTriangle.RandomInCube(random)).Select(corner =>
            (corner, corner + (size * AdversarialTriangle.RandomInCube(random)),
            corner + (size * AdversarialTriangle.RandomInCube(random))))),
    };

    /// <summary>A position: far, near, on a corner, an edge or a face, or in the box.</summary>
    public static Vector RandomPosition(Random random, Mesh mesh)
    {
        var (bounds, diagonal) = (mesh.Bounds, mesh.Bounds.Diagonal);
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

    private static Mesh AdversarialSoup(int seed, int faces) => new Random(seed) switch
    {
        // Those that stand at the scale of 1, so that one mesh holds them all.
        var random =>
            FromTriangles(Enumerable.Range(0, int.MaxValue).Select(_ => AdversarialTriangle.Random(random))
            .Where(face => face.Magnitude is > 0.1 and < 10)
            .Take(faces).Select(face => (face.A, face.B, face.C))),
    };

    private static Mesh Repeat(Mesh mesh, int times) =>
        new(mesh.Positions, [.. Enumerable.Repeat(mesh.VertexIndices, times).SelectMany(faces => faces)]);

    private static Mesh FromTriangles(IEnumerable<(Vector A, Vector B, Vector C)> faces)
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
