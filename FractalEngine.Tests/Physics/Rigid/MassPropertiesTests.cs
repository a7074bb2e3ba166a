using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>The mass of bodies that are meshes and fractals, against closed forms and sums over all instances.</summary>
public class MassPropertiesTests
{
    // Some 10⁴ roundings of the sums, relative to the size.
    private const double Tolerance = 1e-11;

    private static readonly Matrix Turn = Matrix.Rotation(new Vector(1, 2, -2).UnitVector(), 0.7);

    [Fact]
    public void Box_AnywhereAndOfAnySize_HasTheInertiaOfTheTextbook()
    {
        Vector[] places = [Vector.Zero, new(5, -3, 2), new(100, 200, -50)];
        foreach (var place in places)
        {
            var (a, b, c) = new Vector(1, 2, 3);
            var shape = ShapeOf(RigidMeshes.Box(place - new Vector(0.5, 1, 1.5), place + new Vector(0.5, 1, 1.5)));
            var tolerance = Tolerance * (1 + place.LengthSquared());
            Near.Equal(6, shape.Volume, tolerance);
            Near.Equal(place, shape.Centre, tolerance);
            Near.Equal(InertiaOfBox(a, b, c), shape.Inertia, tolerance);
            Assert.True(shape.HasMassOfSurface);
        }
    }

    [Theory]
    [InlineData(1, 1, 1)]
    [InlineData(2, 3, 0.5)]
    [InlineData(-1, 1, 1)]
    [InlineData(-2, -3, -0.5)]
    public void Box_TurnedScaledAndMirrored_HasTheInertiaOfItsImage(double x, double y, double z)
    {
        var linear = Turn * Matrix.Diagonal(new(x, y, z));
        var centre = new Vector(0.3, -0.2, 4);
        var shape = ShapeOf(RigidMeshes.Box(centre - new Vector(0.5, 1, 1.5), centre + new Vector(0.5, 1, 1.5)), linear);
        var inertia = Turn * InertiaOfBox(Math.Abs(x), 2 * Math.Abs(y), 3 * Math.Abs(z)) * Turn.Transpose();
        Near.Equal(6 * Math.Abs(x * y * z), shape.Volume, 100 * Tolerance);
        Near.Equal(linear * centre, shape.Centre, 100 * Tolerance);
        Near.Equal(inertia, shape.Inertia, 1000 * Tolerance);
    }

    [Fact]
    public void Mesh_WoundInwards_HasTheSameMass()
    {
        var shape = ShapeOf(PhysicsMeshes.FlipWinding(RigidMeshes.Box(1, 2, 3)));
        Near.Equal(6, shape.Volume, Tolerance);
        Near.Equal(Vector.Zero, shape.Centre, Tolerance);
        Near.Equal(InertiaOfBox(1, 2, 3), shape.Inertia, Tolerance);
    }

    [Fact]
    public void RegularSolids_HaveTheInertiaOfTheTextbook()
    {
        // Edge length s: volume s³/(6√2) and moment s²/20; √2·s³/3 and s²/10.
        var tetrahedron = ShapeOf(Shapes.Tetrahedron());
        var edge = Math.Sqrt(8 / 3.0);
        Near.Equal(edge * edge * edge / (6 * Math.Sqrt(2)), tetrahedron.Volume, Tolerance);
        Near.Equal(Vector.Zero, tetrahedron.Centre, Tolerance);
        Near.Equal(edge * edge / 20 * Matrix.Identity, tetrahedron.Inertia, Tolerance);
        var octahedron = ShapeOf(Shapes.Octahedron());
        Near.Equal(4 / 3.0, octahedron.Volume, Tolerance);
        Near.Equal(Vector.Zero, octahedron.Centre, Tolerance);
        Near.Equal(0.2 * Matrix.Identity, octahedron.Inertia, Tolerance);
    }

    [Fact]
    public void L_AsOnePrismOrTwoBoxes_HasTheInertiaOfThreeCubes()
    {
        Vector[] cubes = [new(0.5, 0.5, 0.5), new(1.5, 0.5, 0.5), new(0.5, 1.5, 0.5)];
        var centre = (cubes[0] + cubes[1] + cubes[2]) / 3;
        var inertia = cubes.Aggregate(0 * Matrix.Identity, (sum, cube) => sum + (SteinerTerm(cube - centre) / 3))
            + InertiaOfBox(1, 1, 1);
        Mesh[] meshes = [RigidMeshes.CreateL(), RigidMeshes.Join(RigidMeshes.BoxesOfL())];
        foreach (var shape in meshes.Select(mesh => ShapeOf(mesh)))
        {
            Near.Equal(3, shape.Volume, Tolerance);
            Near.Equal(centre, shape.Centre, Tolerance);
            Near.Equal(inertia, shape.Inertia, Tolerance);
        }
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void Sponge_HasTheMassOfItsCubes(int depth)
    {
        var shape = ShapeOf(PhysicsMeshes.CreateSponge(depth));
        Near.Equal(Math.Pow(20 / 27.0, depth), shape.Volume, Tolerance);
        Near.Equal(Vector.Zero, shape.Centre, Tolerance);
        var expected = SolidMoments.Of(Shapes.Cube(), Expand(SpongeMaps(), depth));
        Near.Equal(expected.Inertia, shape.Inertia, Tolerance);
    }

    [Fact]
    public void RandomFractals_HaveTheMassOfAllInstances() => Seeded.Run(12, random =>
    {
        var depth = 1 + random.Next(3);
        var maps = Enumerable.Range(0, 2 + random.Next(3)).Select(_ => RandomMap(random)).ToArray();
        var mesh = random.Next(2) == 0 ? RigidMeshes.CreateL() : Shapes.Tetrahedron();
        var fractal = Fractal.Of(mesh).Repeat(maps, depth);
        var linear = random.Next(2) == 0 ? Matrix.Identity : Turn * Matrix.Diagonal(new(1.5, -0.5, 1));
        var expected = SolidMoments.Of(
            mesh, Expand([.. maps.Select(map => map.ToAffineMap())], depth).Select(map => new AffineMap(linear, Vector.Zero) * map));
        var shape = ShapeOf(fractal, linear);
        Near.Equal(expected.Volume, shape.Volume, Tolerance * (1 + expected.Volume));
        Near.Equal(expected.Centre, shape.Centre, 100 * Tolerance);
        Near.Equal(expected.Inertia, shape.Inertia, 100 * Tolerance);
    });

    [Fact]
    public void Fractal_OfDifferentSets_HasTheMassOfAllInstances()
    {
        Transformation[] outer = [Transformation.At(new(1, 0, 0), 0.5), Transformation.At(new(-1, 0.5, 0), -0.4)];
        Transformation[] inner = [Transformation.At(new(0, 1, 0), 0.7), Transformation.Identity with { Rotation = new(10, 20, 30) }];
        var mesh = RigidMeshes.CreateL();
        var shape = ShapeOf(Fractal.Of(mesh).Apply(inner).Apply(outer));
        var expected = SolidMoments.Of(
            mesh, outer.SelectMany(first => inner.Select(second => first.ToAffineMap() * second.ToAffineMap())));
        Near.Equal(expected.Volume, shape.Volume, Tolerance);
        Near.Equal(expected.Centre, shape.Centre, Tolerance);
        Near.Equal(expected.Inertia, shape.Inertia, Tolerance);
    }

    [Fact]
    public void OpenBox_CountsByItsHull_AloneAndInAFractal()
    {
        var box = RigidMeshes.Box(1, 2, 3);
        var open = new Mesh(box.Positions, [.. box.VertexIndices.Take(30)]);
        var shape = ShapeOf(open);
        Near.Equal(6, shape.Volume, 1e-9);
        Near.Equal(Vector.Zero, shape.Centre, 1e-9);
        Near.Equal(InertiaOfBox(1, 2, 3), shape.Inertia, 1e-9);
        Assert.False(shape.HasMassOfSurface);
        Transformation[] maps = [Transformation.At(new(2, 0, 0), 0.5), Transformation.At(new(-1, 1, 0), 0.25)];
        var (ofOpen, ofClosed) = (ShapeOf(Fractal.Of(open).Repeat(maps, 2)), ShapeOf(Fractal.Of(box).Repeat(maps, 2)));
        Near.Equal(ofClosed.Volume, ofOpen.Volume, 1e-9);
        Near.Equal(ofClosed.Centre, ofOpen.Centre, 1e-9);
        Near.Equal(ofClosed.Inertia, ofOpen.Inertia, 1e-9);
    }

    [Fact]
    public void Flat_HasAFinitePositiveMass()
    {
        Mesh[] flat = [Shapes.Square(), Shapes.Square(1e-3), PhysicsMeshes.FloorMesh(), Shapes.Square().Transform(v => Turn * v)];
        Assert.All(flat, mesh =>
        {
            CheckSound(ShapeOf(mesh));
            CheckSound(ShapeOf(mesh, Turn * Matrix.Diagonal(new(2, -1, 3))));
            CheckSound(ShapeOf(Fractal.Of(mesh).Repeat([Transformation.At(Vector.I, 0.5), Transformation.At(Vector.Zero, 0.5)], 2)));
        });
    }

    [Fact]
    public void Impossible_IsRefused()
    {
        var world = new PhysicsWorld();
        Assert.ThrowsAny<ArgumentException>(() => ShapeOf(PhysicsMeshes.CreateSponge(null)));
        Assert.ThrowsAny<ArgumentException>(() => world.Add(PhysicsMeshes.CreateSponge(null), Vector.Zero));
        Assert.ThrowsAny<ArgumentException>(() => ShapeOf(Mesh.Empty));
        Assert.ThrowsAny<ArgumentException>(() => world.Add(Mesh.Empty, Vector.Zero));
        Assert.ThrowsAny<ArgumentException>(() => ShapeOf(new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [])));
        Assert.ThrowsAny<ArgumentException>(() => ShapeOf(Fractal.Of(Shapes.Cube()).Apply([])));
        Assert.ThrowsAny<ArgumentException>(() => ShapeOf(Shapes.Cube(), Matrix.Diagonal(new(1e200, 1e200, 1e200))));
        Assert.ThrowsAny<ArgumentException>(() => ShapeOf(Shapes.Cube(), double.NaN * Matrix.Identity));
        Assert.Empty(world.Bodies);
    }

    [Fact]
    public void Body_TakesMassAndPlaceFromItsShape()
    {
        var world = new PhysicsWorld();
        var body = world.Add(RigidMeshes.CreateL(), new(1, 2, 3));
        Near.Equal(3, body.Description.Mass, Tolerance);
        Near.Equal(new(1, 2, 3), body.Position, 0);
        Near.Equal(new Vector(1, 2, 3) - ShapeOf(RigidMeshes.CreateL()).Centre, RigidMeshes.PointOf(body, Vector.Zero), Tolerance);
    }

    private static void CheckSound(MeshShape shape)
    {
        Assert.True(shape.Volume > 0 && double.IsFinite(shape.Volume), $"volume {shape.Volume:R}");
        Assert.True(shape.Centre.IsFinite() && shape.Inertia.IsFinite(), $"{shape.Centre} {shape.Inertia}");
        Assert.True(shape.Inertia.Determinant() > 0, $"inertia {shape.Inertia}");
    }

    private static MeshShape ShapeOf(Mesh mesh, Matrix? linear = null) => new(Model.Of(mesh), linear);

    private static MeshShape ShapeOf(Fractal fractal, Matrix? linear = null) => new(Model.Of(fractal), linear);

    private static Matrix InertiaOfBox(double a, double b, double c) =>
        Matrix.Diagonal(new Vector((b * b) + (c * c), (a * a) + (c * c), (a * a) + (b * b)) / 12);

    private static Matrix SteinerTerm(Vector offset) => (offset.LengthSquared() * Matrix.Identity) + (-1 * Matrix.Outer(offset, offset));

    private static AffineMap[] SpongeMaps() =>
    [
        .. from x in new[] { -1, 0, 1 }
           from y in new[] { -1, 0, 1 }
           from z in new[] { -1, 0, 1 }
           where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
           select new AffineMap(Matrix.Identity / 3, new Vector(x, y, z) / 3),
    ];

    private static AffineMap[] Expand(AffineMap[] maps, int depth) => depth == 0 ? [AffineMap.Identity]
        : [.. Expand(maps, depth - 1).SelectMany(outer => maps.Select(map => outer * map))];

    private static Transformation RandomMap(Random random) => new(
        random.Vector(1), random.Vector(180), new(random.Between(0.3, 1), random.Between(0.3, 1), random.Between(-1, -0.3)));
}
