using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Makes meshes that are no models: each is a valid <see cref="Mesh"/>, but has little or nothing to be found.</summary>
internal static class BadInputs
{
    /// <summary>How many triangles <see cref="BadInputKind.SeparateTriangles"/> has unless another number is asked for.</summary>
    public const int DefaultFaces = 1_000_000;

    private const int FewFaces = 2000;

    /// <summary>Makes the mesh of a kind.</summary>
    /// <param name="kind">What is wrong with it.</param>
    /// <param name="seed">Chooses all numbers; any integer.</param>
    /// <param name="separateFaces">How many faces <see cref="BadInputKind.SeparateTriangles"/> has.</param>
    public static Mesh Create(BadInputKind kind, int seed, int separateFaces = DefaultFaces)
    {
        var random = new SeededRandom(kind.ToString(), seed);
        return kind switch
        {
            BadInputKind.Empty => Mesh.Empty,
            BadInputKind.NoFaces => MeshTools.Create([.. Points(random, 100)], []),
            BadInputKind.OneTriangle => MeshTools.Create([.. Points(random, 3)], [0, 1, 2]),
            BadInputKind.AllDegenerate => AllDegenerate(random),
            BadInputKind.SeparateTriangles => Separate(separateFaces, () => SmallTriangle(random, 0.01)),
            BadInputKind.SelfIntersecting => SelfIntersecting(random),
            BadInputKind.FarVertex => FarVertex(random),
            BadInputKind.CoincidentDuplicates => CoincidentDuplicates(random),
            BadInputKind.Slivers => Separate(FewFaces, () => Sliver(random)),
            BadInputKind.OnePlane => OnePlane(random),
            BadInputKind.OneLine => OneLine(random),
            BadInputKind.OnePoint => Separate(FewFaces, () => [new(1, 2, 3), new(1, 2, 3), new(1, 2, 3)]),
            BadInputKind.TinyAndFar => MeshTools.Move(GoodShape(random), new(1e-12 * Matrix.Identity, Vector.One)),
            BadInputKind.Huge => MeshTools.Move(GoodShape(random), new(1e140 * Matrix.Identity, Vector.Zero)),
            BadInputKind.UnusedVertices => UnusedVertices(random),
            _ => throw new ArgumentOutOfRangeException(nameof(kind), kind, "no kind of bad input"),
        };
    }

    private static Mesh AllDegenerate(SeededRandom random) => Separate(FewFaces, () =>
    {
        var (a, b) = (random.InBox(1), random.InBox(1));
        return random.Index(3) switch
        {
            0 => [a, a, a],
            1 => [a, b, a],
            // Exactly in the middle, so that rounding gives no area.
            _ => [Dyadic(a), Dyadic(b), 0.5 * (Dyadic(a) + Dyadic(b))],
        };
    });

    private static Mesh SelfIntersecting(SeededRandom random)
    {
        var points = Points(random, FewFaces / 10).ToArray();
        var faces = Enumerable.Range(0, FewFaces).SelectMany(_ => random.Permutation(points.Length).Take(3));
        return MeshTools.Create(points, [.. faces]);
    }

    private static Mesh FarVertex(SeededRandom random)
    {
        var shape = GoodShape(random);
        var positions = MeshTools.Positions(shape);
        positions[random.Index(positions.Length)] = 1e14 * random.Direction();
        return MeshTools.Create(positions, shape.VertexIndices);
    }

    private static Mesh CoincidentDuplicates(SeededRandom random)
    {
        var shape = GoodShape(random);
        var (positions, indices) = (new List<Vector>(), new List<int>());
        for (var copy = 0; copy < 20; copy++)
        {
            indices.AddRange(shape.VertexIndices.Select(vertex => positions.Count + vertex));
            positions.AddRange(MeshTools.Positions(shape));
        }

        return Shuffling.Shuffle(MeshTools.Create(positions, indices), random);
    }

    private static Mesh OnePlane(SeededRandom random)
    {
        var plane = random.GenericRotation();
        return Separate(FewFaces, () => [.. SmallTriangle(random, 0.1).Select(point => plane * (point with { Z = 0 }))]);
    }

    private static Mesh OneLine(SeededRandom random)
    {
        var direction = random.Direction();
        return Separate(FewFaces, () => [.. Points(random, 3).Select(point => point.X * direction)]);
    }

    private static Mesh UnusedVertices(SeededRandom random)
    {
        var shape = GoodShape(random);
        return MeshTools.Create(
            [.. MeshTools.Positions(shape), .. Points(random, 2 * shape.VertexCount).Select(point => 1000 * point)], shape.VertexIndices);
    }

    /// <summary>Makes what a search would find without what is wrong: a fractal of diagonal 1 around the origin.</summary>
    private static Mesh GoodShape(SeededRandom random)
    {
        var mesh = UnseenFractals.Create(FractalKind.Leaves, random.Index(1000), FewFaces).Mesh;
        var size = 1 / mesh.Bounds.Diagonal;
        return MeshTools.Move(mesh, new(size * Matrix.Identity, -size * mesh.Bounds.Centre));
    }

    private static IEnumerable<Vector> Points(SeededRandom random, int count) => Enumerable.Range(0, count).Select(_ => random.InBox(1));

    private static Vector[] SmallTriangle(SeededRandom random, double size)
    {
        var centre = random.InBox(1);
        return [centre + random.InBox(size), centre + random.InBox(size), centre + random.InBox(size)];
    }

    private static Vector[] Sliver(SeededRandom random)
    {
        var (start, along) = (random.InBox(1), random.Direction());
        return [start, start + along, start + (random.Fraction() * along) + (1e-6 * random.Direction())];
    }

    private static Vector Dyadic(Vector point) => new(Round(point.X), Round(point.Y), Round(point.Z));

    private static double Round(double coordinate) => Math.Round(coordinate * 1024) / 1024;

    private static Mesh Separate(int faces, Func<Vector[]> createFace)
    {
        var positions = new Vector[3 * faces];
        for (var face = 0; face < faces; face++)
        {
            createFace().CopyTo(positions, 3 * face);
        }

        return MeshTools.Create(positions, [.. Enumerable.Range(0, positions.Length)]);
    }
}
