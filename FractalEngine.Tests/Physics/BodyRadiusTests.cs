using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

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

    private static double MaxDistance(IEnumerable<Vector> vertices, PhysicsObject declared) =>
        vertices.Max(vertex => (vertex - declared.Placement.Position).Length());
}
