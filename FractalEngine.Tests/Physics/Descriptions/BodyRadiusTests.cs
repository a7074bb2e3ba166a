using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Descriptions;

/// <summary>Bounding spheres of physics objects, against every vertex where plain arithmetic puts it.</summary>
public sealed class BodyRadiusTests
{
    [Fact]
    public void Compute_OfAMeshUnderAnyMatrix_IsTheDistanceOfTheFarthestVertex() => Seeded.Run(100, random =>
    {
        var declared = new PhysicsObject(new MeshModel(Samples.Tetrahedron)) { Placement = random.Transformation() };
        var body = Assert.Single(new PhysicsWorld(new Scene { Objects = [declared] }).Bodies);
        var map = NaiveFractal.MapOf(declared.Placement);
        var expected = MaxDistance(NaiveFractal.Vertices(Samples.Tetrahedron).Select(v => NaiveFractal.Apply(map, v)), declared);
        Near.Equal(declared.Placement.Position, body.Position, 0);
        Near.Equal(expected, body.Radius, 1e-12 * expected);
    });

    [Fact]
    public void Compute_OfAFractalUnderAnyMatrix_IsNoLessThanThatAndABillionthMoreAtMost() => Seeded.Run(60, random =>
    {
        var fractal = Samples.Repeated(random.Next(1, 4), random.Transformation(), random.Transformation());
        var declared = new PhysicsObject(new FractalModel(fractal)) { Placement = random.Transformation() };
        var radius = BodyDescription.FromPhysicsObject(new(declared), declared, 0).Radius;
        var corners = NaiveFractal.Corners(fractal.Description, fractal.BaseMesh, NaiveFractal.MapOf(declared.Placement));
        var expected = MaxDistance(corners, declared);
        // Besides the tolerance of the search, some roundings of either side.
        Assert.InRange(radius, expected * (1 - 1e-12), expected * (1 + 1e-9 + 1e-12));
    });

    /// <summary>Maps whose numbers are added up one by one have no hierarchy: each instance is looked at.</summary>
    [Fact]
    public void Compute_OfAComponentwiseFractal_IsTheDistanceOfTheFarthestVertex() => Seeded.Run(10, random =>
    {
        var fractal = Samples.AppendixBAt(random.Next(1, 4), Composition.Componentwise);
        var declared = new PhysicsObject(new FractalModel(fractal)) { Placement = random.Transformation() };
        var radius = BodyDescription.FromPhysicsObject(new(declared), declared, 0).Radius;
        var map = NaiveFractal.MapOf(declared.Placement);
        var expected = MaxDistance(
            NaiveFractal.Vertices(FractalGenerator.Flatten(fractal, 100_000)).Select(v => NaiveFractal.Apply(map, v)), declared);
        Near.Equal(expected, radius, 1e-12 * expected);
    });

    /// <summary>Needles along one axis: boxes that are taken for those along another one would hide the farthest.</summary>
    [Fact]
    public void Compute_OfAFractalOfNeedles_IsTheDistanceOfTheFarthestVertex() => Seeded.Run(60, random =>
    {
        var corner = random.Vector(0.1) + (random.Next(3) switch { 0 => Vector.I, 1 => Vector.J, _ => Vector.K } * 3);
        var needle = Shapes.Box(new(Vector.Min(Vector.Zero, corner), Vector.Max(Vector.Zero, corner)));
        // Not turned against each other, so that what they make up is long and thin too.
        var maps = Enumerable.Range(0, 4).Select(_ => random.Transformation() with { Rotation = Vector.Zero });
        var fractal = Fractal.Of(needle).Repeat([.. maps], random.Next(1, 4));
        var declared = new PhysicsObject(new FractalModel(fractal)) { Placement = random.Transformation() };
        var radius = BodyDescription.FromPhysicsObject(new(declared), declared, 0).Radius;
        var expected = MaxDistance(
            NaiveFractal.Corners(fractal.Description, fractal.BaseMesh, NaiveFractal.MapOf(declared.Placement)), declared);
        Near.Equal(expected, radius, 1e-9 * expected);
    });

    private static double MaxDistance(IEnumerable<Vector> vertices, PhysicsObject declared) =>
        vertices.Max(vertex => (vertex - declared.Placement.Position).Length());
}
