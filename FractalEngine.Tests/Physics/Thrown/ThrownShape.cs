using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Physics.Rigid;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Thrown;

/// <summary>A shape of bodies that are thrown, no farther than 1.5 sizes from its centre of mass.</summary>
/// <param name="Name">For counts and messages.</param>
/// <param name="Describe">Makes a body at the origin, from random numbers and its size.</param>
/// <param name="Parts">The convex parts that fill its mesh or fractal; none for balls.</param>
internal sealed record ThrownShape(string Name, Func<Random, double, BodyDescription> Describe, ConvexUnion? Parts = null)
{
    // A sheet has no inside; this thickness is far below the gap at which bodies of meshes rest.
    private const double Thin = 1e-7;

    public static readonly ThrownShape[] Balls = [new("ball", static (random, size) => new(Vector.Zero, random.Between(0.2, 0.5) * size))];

    public static readonly ThrownShape[] Compounds =
    [
        new("capsule", static (random, size) =>
        {
            var end = 0.5 * size * random.Direction();
            return new(Vector.Zero, CompoundShape.Capsule(-end, end, random.Between(0.1, 0.4) * size));
        }),
        new("balls", static (random, size) => new(Vector.Zero, CompoundShape.OfBalls(
            [.. Enumerable.Range(0, 3).Select(_ => new CompoundBall(0.4 * size * random.Direction(), random.Between(0.2, 0.4) * size))]))),
    ];

    public static readonly ThrownShape[] Meshes =
    [
        OfMesh("cube", RigidMeshes.Box(1, 1, 1)), OfMesh("slab", RigidMeshes.Box(1, 0.1, 0.5)),
        OfMesh("plate", RigidMeshes.Box(1, 0.01, 1)), OfMesh("rod", RigidMeshes.Box(1, 0.03, 0.03)),
        OfModel("L", Model.Of(RigidMeshes.CreateL(0.5)), ConvexUnion.Of(RigidMeshes.BoxesOfL(0.5))),
        OfMesh("tetrahedron", Shapes.Tetrahedron()), OfMesh("octahedron", Shapes.Octahedron()), OfMesh("icosphere", Shapes.Sphere(1)),
        OfModel("sheet", Model.Of(Shapes.Square()), ConvexUnion.Of(RigidMeshes.Box(1, Thin, 1))),
    ];

    public static readonly ThrownShape[] Fractals =
    [
        OfCubes("sponge", static others => others > 1), OfCubes("cross", static others => others <= 1),
        OfCubes("dust", static others => others == 3),
    ];

    private static ThrownShape OfMesh(string name, Mesh mesh) => OfModel(name, Model.Of(mesh), ConvexUnion.Of(mesh));

    private static ThrownShape OfModel(string name, Model model, ConvexUnion parts) => new(
        name,
        (random, size) => new(Vector.Zero, new MeshShape(model, random.Between(0.5, 1) * size * random.Orthogonal())),
        parts);

    /// <summary>Makes two levels of cubes, of a third of the side, by how many coordinates of theirs differ from the middle's.</summary>
    private static ThrownShape OfCubes(string name, Func<int, bool> isKept)
    {
        Transformation[] maps =
        [
            .. from x in new[] { -1, 0, 1 }
               from y in new[] { -1, 0, 1 }
               from z in new[] { -1, 0, 1 }
               where isKept((x * x) + (y * y) + (z * z))
               select Transformation.At(new Vector(x, y, z) / 3, 1 / 3.0),
        ];
        var cells = maps.SelectMany(outer => maps.Select(inner => outer.ToAffineMap() * inner.ToAffineMap()));
        return OfModel(name, Model.Of(Fractal.Of(Shapes.Cube()).Repeat(maps, 2)), ConvexUnion.Of(Shapes.Cube(), cells));
    }
}
