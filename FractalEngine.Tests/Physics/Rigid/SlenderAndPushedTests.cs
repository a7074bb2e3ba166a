using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Rods and plates that gain no energy, objects that push bodies, and faces that a mesh lists twice.</summary>
public class SlenderAndPushedTests
{
    /// <summary>A triangle in the plane of x and z.</summary>
    private static readonly double[] Triangle = [0, 0, 0, 0.4, 0, 0, 0, 0, 0.4];

    [Theory]
    [InlineData(0.3, 3)]
    [InlineData(0.03, 3)]
    [InlineData(0.01, 3)]
    [InlineData(0.01, 0)]
    public void Rod_ThatFallsOnAFloor_GainsNoEnergy(double width, double spin)
    {
        var world = CreateOnFloor();
        var body = world.Add(RigidMeshes.Describe(
            RigidMeshes.Box(width, 1, width), new(0, 1.2, 0), Matrix.Rotation(new Vector(1, 2, 3).UnitVector(), 0.7)) with
        {
            Mass = 1,
            Friction = 0.5,
            AngularVelocity = spin / 3 * new Vector(1, 2, 3),
        });
        var energy = world.Energy();
        world.Run(120, () => Assert.True(world.Energy() <= energy + 1e-6, $"{world.Energy()} J at {body.Position}, {energy} J before"));
    }

    [Fact]
    public void Plate_ThatTipsOverACorner_GainsNoEnergy()
    {
        var world = CreateOnFloor(-2);
        world.AddStatic(new Mesh([.. Triangle], [0, 2, 1]));
        world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 0.01, 1), new(0.01, 1.3, 0.02)) with
        {
            Mass = 1,
            Friction = 0.5,
            AngularVelocity = new(2, 0.5, 3),
            Velocity = new(0, -2, 0),
        });
        var energy = world.Energy();
        world.Run(120, () => Assert.True(world.Energy() <= energy + 1e-6, $"{world.Energy()} J, {energy} J before"));
    }

    [Theory]
    [InlineData(1)]
    [InlineData(5)]
    [InlineData(20)]
    [InlineData(60)]
    public void Lift_PassesIntoNothingThatLiesOnIt(double speed)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0);
        var lift = world.AddStatic(RigidMeshes.Box(new(-2, -0.2, -2), new(2, 0, 2)));
        lift.SetMotion(speed * Vector.J);
        Body[] bodies =
        [
            world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(0.2, 0.5002, 0.2)) with { Friction = 0.5, Mass = 1 }),
            world.Add(RigidMeshes.Describe(Shapes.Tetrahedron(), new(-0.2, 2.2, -0.1)) with { Friction = 0.5, Mass = 1 }),
        ];
        world.Run(120, () =>
        {
            var top = lift.ObjectToWorld.Translation.Y;
            foreach (var body in bodies.Where(static body => Math.Max(Math.Abs(body.Position.X), Math.Abs(body.Position.Z)) < 1))
            {
                Assert.InRange(RigidMeshes.LowestPoint(body) - top, -1e-9, double.PositiveInfinity);
            }
        });
        Assert.InRange(bodies[0].Position.Y, speed, double.PositiveInfinity);
    }

    [Fact]
    public void FacesThatAreListedTwice_KeepTheirEdges()
    {
        var features = MeshFeatures.For(new Mesh([.. Triangle], [0, 2, 1, 0, 2, 1]));
        Assert.All(Enumerable.Range(0, 3), side => Assert.True(features.HasEdge(0, side, out _)));
    }

    /// <summary>Of a square of two triangles the diagonal is no edge, and all other edges and corners belong to one of them.</summary>
    [Fact]
    public void FacesOfOnePlane_HaveNoEdgeBetweenThem()
    {
        var mesh = Shapes.Square(1);
        var features = MeshFeatures.For(mesh);
        var sides = Enumerable.Range(0, 3 * mesh.FaceCount).ToArray();
        Assert.Equal(4, sides.Count(side => features.HasEdge(side / 3, side % 3, out _)));
        Assert.Equal(4, sides.Count(side => features.HasVertex(side / 3, side % 3)));
    }

    private static PhysicsWorld CreateOnFloor(double height = 0)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0);
        world.AddStatic(PhysicsMeshes.Cube, new(new(0, height - 0.5, 0), Vector.Zero, new(40, 1, 40)));
        return world;
    }
}
