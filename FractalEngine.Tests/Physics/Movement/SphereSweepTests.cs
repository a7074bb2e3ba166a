using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Movement;

/// <summary>
/// When a ball of radius 0.5 meets floors, edges and other balls, in closed form; and what obstacles tell of it.
/// </summary>
public sealed class SphereSweepTests
{
    private const double Radius = 0.5;

    // Impacts are found to 1e-10 of the radius, at speeds about 1.
    private const double Tolerance = 1e-9;

    /// <summary>From a height of 3 the centre falls by 2.5: v·t + a·t²/2.</summary>
    [Theory]
    [InlineData(5, 0, 0.5)]
    [InlineData(4, 2, 0.5495097567963924)]
    [InlineData(0, 20, 0.5)]
    [InlineData(2.6, 0, 0.9615384615384616)]
    public void TryFindImpact_OfAFall_IsWhenItTouchesTheFloor(double speed, double acceleration, double expected)
    {
        var setup = new Setup(PhysicsMeshes.FloorMesh());
        var motion = new SphereMotion(new(0.25, 3, 0.125), new(1, -speed, 0), new(0, -acceleration, 0));
        Assert.True(setup.TryFind(motion, 1, out var hit, out var elapsed));
        Near.Equal(expected, elapsed, Tolerance);
        Assert.Equal((false, true), (hit.IsBody, hit.IsFlat));
        Near.Equal(new(0.25 + expected, 0, 0.125), hit.Point, 1e-8);
        Assert.False(setup.TryFind(motion, expected - 1e-6, out _, out elapsed));
        Assert.Equal(expected - 1e-6, elapsed);
        Assert.True(setup.TryFind(motion, expected + 1e-6, out _, out elapsed));
        Near.Equal(expected, elapsed, Tolerance);
    }

    /// <summary>Beside the face of a cube its edge is met, and beside that its corner.</summary>
    [Theory]
    [InlineData(0.25, 0.25, 0)]
    [InlineData(0.8, 0, 0.1)]
    [InlineData(0, -0.9, 0.2)]
    [InlineData(0.8, 0.5 + 0.24, 0.18)]
    public void TryFindImpact_OfACube_IsWhereItsRoundedShapeSays(double x, double z, double sunk)
    {
        var setup = new Setup(PhysicsMeshes.Cube);
        var (beside, before) = (Math.Max(0, Math.Abs(x) - 0.5), Math.Max(0, Math.Abs(z) - 0.5));
        var expectedHeight = 0.5 + Math.Sqrt((Radius * Radius) - (beside * beside) - (before * before));
        var motion = new SphereMotion(new(x, 3, z), new(0, -4, 0), Vector.Zero);
        Assert.True(setup.TryFind(motion, 1, out var hit, out var elapsed));
        Near.Equal((3 - expectedHeight) / 4, elapsed, Tolerance);
        Near.Equal(new(Math.Clamp(x, -0.5, 0.5), 0.5, Math.Clamp(z, -0.5, 0.5)), hit.Point, 1e-8);
        Assert.InRange(1 - expectedHeight, sunk - 0.01, sunk + 0.01);
    }

    [Theory]
    [InlineData(0, 0.5)]
    [InlineData(0.6, 0.55)]
    [InlineData(-0.8, 0.6)]
    public void TryFindImpact_OfABall_IsWhenTheirCentresAreTwoRadiiApart(double offset, double expected)
    {
        var setup = new Setup(null, new BodyDescription(new(30, offset, 0), Radius), new BodyDescription(new(3, offset, 0), Radius));
        var motion = new SphereMotion(Vector.Zero, new(4, 0, 0), Vector.Zero);
        setup.Obstacles.CollectNearbyBodies(in motion, 1, Contact.NoBody);
        Assert.True(setup.TryFind(motion, 1, out var hit, out var elapsed));
        Near.Equal(expected, elapsed, Tolerance);
        Assert.Equal((1, 1.0), (hit.BodyIndex, hit.CombinedRadius));
        setup.Obstacles.CollectNearbyBodies(in motion, 1, excludedIndex: 1);
        Assert.False(setup.TryFind(motion, 1, out _, out elapsed));
        Assert.Equal(1, elapsed);
    }

    /// <summary>It leaves the floor that it touches, and comes back: v·t = a·t²/2.</summary>
    [Fact]
    public void TryFindImpact_OfABallThatIsThrownUp_IsWhenItReturns()
    {
        var setup = new Setup(PhysicsMeshes.FloorMesh());
        var motion = new SphereMotion(new(0, Radius, 0), new(0.5, 2, 0), new(0, -4, 0));
        Assert.True(setup.TryFind(motion, 2, out _, out var elapsed));
        Near.Equal(1, elapsed, Tolerance);
        Assert.False(setup.TryFind(motion, 0.999, out _, out elapsed));
        Assert.Equal(0.999, elapsed);
    }

    [Fact]
    public void TryFindImpact_AlongAFloor_IsNone()
    {
        var setup = new Setup(PhysicsMeshes.FloorMesh());
        Assert.False(setup.TryFind(new(new(0, Radius, 0), new(3, 0, 1), Vector.Zero), 2, out _, out var elapsed));
        Assert.Equal(2, elapsed);
        Assert.False(setup.TryFind(new(new(0, Radius, 0), new(3, 0, 1), new(0, 1, 0)), 2, out _, out _));
        Assert.True(setup.TryFind(new(new(0, Radius, 0), new(3, -0.001, 1), Vector.Zero), 2, out _, out elapsed));
        Near.Equal(0, elapsed, 1e-6);
    }

    /// <summary>All that surrounds a ball counts for each of its spheres.</summary>
    [Fact]
    public void Obstacles_OfAMoverOfTwoSpheres_AreThoseOfBoth()
    {
        var setup = new Setup(PhysicsMeshes.FloorMesh(), new BodyDescription(new(0, 9, 0), Radius));
        setup.Obstacles.SetMover(setup.Colliders, [Vector.Zero, 4 * Vector.J], Radius, new(), 0);
        setup.Obstacles.CollectNearbyBodies(new(new(0, 4.5, 0), Vector.Zero, Vector.Zero), 0, Contact.NoBody);
        Assert.True(setup.Obstacles.TryFindClosestContact(new(0, 4.5, 0), 9, out var contact));
        Assert.Equal((0, 4 * Vector.J), (contact.BodyIndex, contact.SphereOffset));
        Near.Equal(-0.5, contact.Gap(new(0, 4.5, 0)), 1e-15);
        Assert.True(setup.Obstacles.TryFindClosestContact(new(0, 2, 0), 9, out contact));
        Assert.Equal((Contact.NoBody, Vector.Zero), (contact.BodyIndex, contact.SphereOffset));
        Near.Equal(1.5, contact.Gap(new(0, 2, 0)), 1e-15);
        Assert.False(setup.Obstacles.TryFindClosestContact(new(0, 2, 0), 1.4999, out _));
        Near.Equal(2, setup.Obstacles.SurfaceDistance(new(0, 2, 0), 9), 1e-15);
        Near.Equal(1, setup.Obstacles.SurfaceDistance(new(0, -5, 0), 9), 1e-15);
        Assert.Equal(1.75, setup.Obstacles.SurfaceDistance(new(0, 2, 0), 1.75));
        setup.Obstacles.DropBodiesOfOtherLayers(0, 2);
        Assert.True(setup.Obstacles.TryFindClosestContact(new(0, 4.5, 0), 9, out contact));
        Assert.False(contact.IsBody);
    }

    [Theory]
    [InlineData(0.75, 9, 0.25)]
    [InlineData(3, 9, 2.5)]
    [InlineData(3, 2, 2)]
    [InlineData(0.25, 9, -0.25)]
    public void FreeDistance_AboveAFloor_IsTheGapOrWhatWasAskedFor(double height, double maxDistance, double expected)
    {
        var setup = new Setup(PhysicsMeshes.FloorMesh());
        for (var query = 0; query < 3; query++)
        {
            // Known from the query before, or not.
            Near.Equal(expected, setup.Obstacles.FreeDistance(new(0, height, 0), maxDistance, maxDistance), 1e-12);
        }
    }

    [Fact]
    public void TryFindSurfaceSide_OfACube_TellsInsideFromOutside()
    {
        var setup = new Setup(PhysicsMeshes.Cube);
        Assert.True(setup.Obstacles.TryFindSurfaceSide(new(0.1, 0.4, 0.2), out var closest, out var isInside));
        Assert.True(isInside);
        Near.Equal(new(0.1, 0.5, 0.2), closest.Point, 1e-15);
        Assert.True(setup.Obstacles.TryFindSurfaceSide(new(0.1, 0.6, 0.2), out closest, out isInside));
        Assert.False(isInside);
        Near.Equal(Vector.J, closest.Normal, 1e-15);
        Assert.False(setup.Obstacles.TryFindSurfaceSide(new(0.1, 1.01, 0.2), out _, out _));
        // A floor has no inside.
        Assert.True(new Setup(PhysicsMeshes.FloorMesh()).Obstacles.TryFindSurfaceSide(new(0, -0.1, 0), out _, out isInside));
        Assert.False(isInside);
    }

    /// <summary>A centre exactly as near as counts as on a surface is still before it.</summary>
    [Theory]
    [InlineData(1, true)]
    [InlineData(0.999, false)]
    public void IsReachable_FromTheToleranceOn_LeadsAwayFromTheSurface(double height, bool isReachable)
    {
        var setup = new Setup(PhysicsMeshes.FloorMesh());
        // A billionth of the radius is 1.
        setup.Obstacles.SetMover(setup.Colliders, [Vector.Zero], 1e9, new(), 0);
        Assert.Equal(isReachable, new OverlapResolver(setup.Obstacles).IsReachable(new(0, height, 0), new(0, 1.5, 0)));
        Assert.False(new OverlapResolver(setup.Obstacles).IsReachable(new(0, 2, 0), new(0, -2, 0)));
        Assert.True(new OverlapResolver(setup.Obstacles).IsReachable(new(0, 2, 0), new(0, 2, 0)));
    }

    private sealed class Setup
    {
        private readonly SphereSweep _sweep;

        public Setup(Mesh? mesh, params BodyDescription[] descriptions)
        {
            List<Body> bodies = [.. descriptions.Select(static (one, i) => new Body(one, i))];
            var grid = new BodyGrid();
            grid.Build(bodies);
            var statics = new StaticObjectSet(static _ => { }, null);
            Obstacles = new(
                bodies, new NearbyBodies(grid, bodies), new QueryContext(), new KinematicSet(), new BodySurfaces(bodies, statics));
            if (mesh is not null)
            {
                statics.Add(new PhysicsWorld().AddStatic(mesh));
            }

            Colliders = statics.CollidersOf(ColliderKind.Exact);
            Obstacles.SetMover(Colliders, [Vector.Zero], Radius, new(), 0);
            _sweep = new(Obstacles);
        }

        public Obstacles Obstacles { get; }

        public StaticColliders? Colliders { get; }

        public bool TryFind(SphereMotion motion, double maxTime, out Contact hit, out double elapsed)
        {
            _sweep.ResetStepBudget();
            return _sweep.TryFindImpact(in motion, maxTime, out hit, out elapsed);
        }
    }
}
