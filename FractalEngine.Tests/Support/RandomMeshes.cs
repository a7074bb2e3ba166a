using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Draws meshes of all the sorts that break bounds and searches: flat, thin, far away, without area, in several components. Most have few
/// faces; none has more than <see cref="MaxFaces"/>.
/// </summary>
internal static class RandomMeshes
{
    public const int MaxFaces = 80;

    private static readonly (int Weight, Func<Random, Mesh> Create)[] Kinds =
    [
        (14, CreateTetrahedron),
        (12, random => FlattenAlongAxis(random, CreateTriangle(random))),
        (12, random => FlattenAlongAxis(random, CreatePatch(random, height: 0))),
        (6, random => Turn(random, CreatePatch(random, height: 0))),
        (4, random => CreatePatch(random, height: 0.3)),
        (8, CreateNeedles),
        (5, random => FlattenAlongAxis(random, CreateNeedles(random))),
        (6, CreateWithoutArea),
        (8, CreateWithFarVertex),
        (8, CreateWithDuplicates),
        (6, CreateLargeHull),
        (7, CreateComponents),
        (4, random => CreateSoup(random, random.Next(2, 20))),
    ];

    /// <summary>Draws a mesh of any kind, at any place.</summary>
    public static Mesh Create(Random random) => Place(random, random.Draw(Kinds)(random));

    /// <summary>Draws unconnected triangles with corners in the cube from −1 to 1.</summary>
    public static Mesh CreateSoup(Random random, int faces) =>
        FromVertices([.. Enumerable.Range(0, 3 * faces).Select(_ => random.Vector())]);

    /// <summary>Gives all vertices exactly the same coordinate along an axis, which is rarely 0.</summary>
    public static Mesh FlattenAlongAxis(Random random, Mesh mesh)
    {
        var axis = random.Draw((1, Vector.I), (2, Vector.J), (1, Vector.K));
        var height = random.Draw((3, 0.7), (3, random.Between(-3, 3)), (1, 1e-3), (1, 1000), (1, -1e6), (1, 0));
        return mesh.Transform(v => v.Stretch(Vector.One - axis) + (height * axis));
    }

    /// <summary>Leaves a mesh where it is in most cases, and otherwise moves, scales or turns it.</summary>
    private static Mesh Place(Random random, Mesh mesh)
    {
        var offset = random.Vector(20);
        var size = Math.Pow(10, random.Next(-6, 7));
        return random.Draw<Func<Mesh>>(
            (56, () => mesh),
            (15, () => mesh.Transform(v => v + new Vector(1000, -999, 0))),
            (10, () => mesh.Transform(v => v + offset)),
            (12, () => mesh.Transform(v => size * v)),
            (7, () => Turn(random, mesh)))();
    }

    private static Mesh Turn(Random random, Mesh mesh)
    {
        var rotation = random.Orthogonal();
        return mesh.Transform(v => rotation * v);
    }

    private static Mesh CreateTetrahedron(Random random) => random.Next(2) == 0
        ? Samples.Tetrahedron
        : new Mesh(Samples.Tetrahedron.Positions, Samples.Tetrahedron.VertexIndices).Transform(v => v + random.Vector(0.4));

    private static Mesh CreateTriangle(Random random) =>
        random.Next(2) == 0 ? Samples.Triangle.Transform(v => new(v.X, v.Z, v.Y)) : CreateSoup(random, 1);

    /// <summary>Creates an open grid in the plane of x and z whose triangles share edges.</summary>
    private static Mesh CreatePatch(Random random, double height)
    {
        var (columns, rows) = (random.Next(1, 4), random.Next(1, 4));
        // Regular ones have edges along the axes, and equal coordinates.
        var roughness = random.Next(2) == 0 ? 0 : 0.3;
        List<int> indices = [];
        for (var corner = 0; corner < rows * columns; corner++)
        {
            var a = (corner / columns * (columns + 1)) + (corner % columns);
            var (b, c, d) = (a + 1, a + columns + 1, a + columns + 2);
            indices.AddRange(random.Next(2) == 0 ? [a, b, d, a, d, c] : [a, b, c, b, d, c]);
        }

        double[] positions =
        [
            .. from row in Enumerable.Range(0, rows + 1)
               from column in Enumerable.Range(0, columns + 1)
               from coordinate in new[] { column, 0.0, row }
               select coordinate,
        ];
        return new Mesh([.. positions], [.. indices]).Transform(v => v + random.Vector().Stretch(new(roughness, height, roughness)));
    }

    /// <summary>Creates triangles from 1e-1 to 1e-12 as high as long, one beside the other along their longest edges.</summary>
    private static Mesh CreateNeedles(Random random)
    {
        var (start, end) = (random.Vector(), random.Vector());
        var height = Math.Pow(10, random.Next(-12, 0));
        // A third of them have their apex beyond an end.
        var place = random.Between(-0.5, 1.5);
        var apex = start + (place * (end - start)) + (height * random.Direction());
        var opposite = start + (random.NextDouble() * (end - start)) + (height * random.Direction());
        return random.Next(2) == 0
            ? FromVertices(start, end, apex)
            : FromIndices([start, end, apex, opposite], [0, 1, 2, 1, 0, 3]);
    }

    /// <summary>Creates a mesh among whose faces are points or segments.</summary>
    private static Mesh CreateWithoutArea(Random random)
    {
        var (a, b, c) = (random.Vector(), random.Vector(), random.Vector());
        return random.Next(4) switch
        {
            0 => FromIndices([a, b, 0.5 * (a + b), c], [0, 1, 2, 0, 1, 3]),
            1 => FromIndices([a, b, c], [0, 0, 1, 0, 1, 2, 2, 2, 2]),
            2 => FromVertices(Vector.Zero, Vector.One, 0.5 * Vector.One, Vector.Zero, Vector.I, Vector.J),
            _ => FromVertices(Vector.Zero, new(1, 2, 3), new(0.5, 1, 1.5)),
        };
    }

    private static Mesh CreateWithFarVertex(Random random)
    {
        var mesh = random.Draw(Kinds[..4])(random);
        var far = Math.Pow(10, random.Next(2, 9)) * random.Draw((1, Vector.I), (1, Vector.J), (1, random.Direction()));
        double[] positions = [.. mesh.Positions];
        var vertex = random.Next(mesh.VertexCount);
        for (var i = 0; i < 3; i++)
        {
            positions[(3 * vertex) + i] += i == 0 ? far.X : i == 1 ? far.Y : far.Z;
        }

        return new([.. positions], mesh.VertexIndices);
    }

    /// <summary>Creates a mesh whose faces have vertices of their own, with a face more than once or a vertex that none uses.</summary>
    private static Mesh CreateWithDuplicates(Random random)
    {
        var mesh = random.Draw(Kinds[..4])(random);
        Vector[] corners = [.. mesh.VertexIndices.Select(mesh.Vertex)];
        return random.Next(3) switch
        {
            0 => FromVertices(corners),
            1 => FromVertices([.. corners, corners[1], corners[2], corners[0], corners[0], corners[2], corners[1]]),
            _ => FromIndices([.. corners, random.Vector(5)], [.. Enumerable.Range(0, corners.Length)]),
        };
    }

    private static Mesh CreateLargeHull(Random random)
    {
        var sphere = MeshGenerators.Create("icosphere", 1, random.Next(2) == 0 ? 20 : MaxFaces);
        var size = new Vector(random.Between(0.5, 2), random.Between(0.5, 2), random.Between(0.5, 2));
        return sphere.Transform(v => v.Stretch(size));
    }

    /// <summary>Creates two to four parts apart from each other, of sizes from 1e-3 to 1.</summary>
    private static Mesh CreateComponents(Random random)
    {
        List<Vector> vertices = [];
        List<int> indices = [];
        for (var i = random.Next(2, 5); i > 0; i--)
        {
            var part = random.Draw(Kinds[..5])(random);
            var (offset, size) = (random.Vector(3), Math.Pow(10, random.Next(-3, 1)));
            indices.AddRange(part.VertexIndices.Select(index => index + vertices.Count));
            vertices.AddRange(NaiveFractal.Vertices(part).Select(v => (size * v) + offset));
        }

        return FromIndices(vertices, indices);
    }

    private static Mesh FromVertices(params Vector[] corners) => FromIndices(corners, Enumerable.Range(0, corners.Length));

    private static Mesh FromIndices(IEnumerable<Vector> vertices, IEnumerable<int> indices) =>
        new([.. vertices.SelectMany(v => new[] { v.X, v.Y, v.Z })], [.. indices]);
}
