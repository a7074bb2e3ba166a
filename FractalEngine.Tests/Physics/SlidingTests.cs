using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Edges within a flat surface are no obstacles.</summary>
public class SlidingTests
{
    // Of the radius, and of the speed. A normal that is off by 1e-9 at one seam would show.
    private const double HeightTolerance = 1e-7;
    private const double SpeedTolerance = 1e-9;

    [Fact]
    public void Sliding_OverManyTriangles_KeepsHeightAndVelocity() => Seeded.Run(40, random =>
    {
        // A grid with its inner vertices shaken sideways.
        var mesh = Grid(random, 20);
        CheckSliding(random, TestWorlds.Place(mesh), new(2, 0, 2), 16, random.Between(0.05, 3));
    });

    [Fact]
    public void Sliding_OverARotatedPlane_KeepsHeightAndVelocity() => Seeded.Run(40, random =>
    {
        var mesh = Grid(random, 20);
        var placement = Transformation.Identity with { Rotation = random.Degrees(), Position = random.Vector(5),
            Scale = new(random.Between(0.5, 2), 1, random.Between(0.5, 2)) };
        var placed = TestWorlds.Place(mesh, placement);
        var normal = placed.ObjectToWorld.Linear.Cofactors().V2.UnitVector();
        var (radius, step) = (random.Between(0.1, 1), random.Between(0.002, 0.05));
        var world = TestWorlds.Create(-9.8 * normal, step, placed);
        var start = placed.ObjectToWorld * new Vector(10, 0, 10);
        var velocity = 3 * Vector.Cross(normal, random.Direction());
        var body = world.Add(new(start + (radius * normal), radius));
        world.Run(5);
        world.SetVelocity(body, velocity);
        world.Run((int)(1 / step), () =>
        {
            // Coordinates of some tens.
            Near.Equal(radius, Vector.Dot(body.Position - start, normal), (HeightTolerance * radius) + 1e-13);
            Near.Equal(velocity, body.Velocity, 3 * SpeedTolerance);
        });
    });

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(4)]
    public void Sliding_OverInstances_KeepsHeightAndVelocity(int depth) => Seeded.Run(10, random =>
    {
        var half = Math.Pow(2, -depth) / 2;
        // Cubes side by side: 4^depth make a slab, whose sides of 15 digits meet.
        var placed =
            TestWorlds.Place(
                new Core.Fractals.Fractal(
                    Samples.Repeated(depth,
                    [.. from x in new[] { -0.25, 0.25 } from z in new[] { -0.25, 0.25 } select Samples.MoveAndScale(x, 0, z,
                    0.5)]).Description, PhysicsMeshes.Cube));
        CheckSliding(random, placed, new(-0.4, half, -0.4), 0.6, random.Between(0.02, 0.5));
    });

    /// <summary>Over the sponge's rim, between its outer edge and its holes, for a ball so large that no hole lets it sink.</summary>
    [Fact]
    public void Sliding_OverTheMengersRim_KeepsHeightAndVelocity() => Seeded.Run(10, random =>
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.002, 0.02), TestWorlds.Place(AssetFractals.Load("menger", 2)));
        // At this depth holes are 1/9 wide and begin 1/9 from the edge; the ball touches in one point, 0.05 from the edge.
        var body = world.Add(new(new(-0.45, 0.5 + 0.1, -0.4), 0.1));
        world.Run(5);
        world.SetVelocity(body, new(0, 0, 0.5));
        world.Run((int)(1.5 / world.Settings.TimeStep), () =>
        {
            // The asset's thirds have 15 digits.
            Near.Equal(0.6, body.Position.Y, HeightTolerance * 0.1);
            Near.Equal(new(0, 0, 0.5), body.Velocity, SpeedTolerance);
        });
    });

    [Fact]
    public void Sliding_FromTheFirstContact_KeepsHeightAndVelocity() => Seeded.Run(100, random =>
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.002, 0.05), TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var (radius, velocity) = (random.Between(0.02, 1), new Vector(random.Between(0, 3), 0, random.NextDouble()));
        var body = world.Add(new(new(0, radius, 0), radius) { Velocity = velocity });
        world.Run(20, () =>
        {
            Near.Equal(radius, body.Position.Y, HeightTolerance * radius);
            Near.Equal(velocity, body.Velocity, SpeedTolerance);
        });
    });

    /// <summary>
    /// School physics: without friction a ball leaves the sphere under it where the cosine of the angle from the top is (2 + v²/(g·r))/3,
    /// and until then v² grows by 2·g·height.
    /// </summary>
    [Theory]
    [InlineData(1.0 / 60)]
    [InlineData(1.0 / 240)]
    [InlineData(1.0 / 1000)]
    public void Sliding_DownASleepingSphere_LeavesItWhereEnergySays(double step)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, step, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var lowerBody = world.Add(new(new(0, 1, 0), 1) { Mass = 1000 });
        world.Run((int)(1.5 / step));
        Assert.True(lowerBody.IsAsleep);
        const double CentreDistance = 1.25;
        const double Speed = 0.5;
        const double Leaving = (2 + (Speed * Speed / (9.8 * CentreDistance))) / 3;
        var body = world.Add(new(lowerBody.Position + new Vector(0, CentreDistance, 0), 0.25) { Velocity = new(Speed, 0, 0) });
        var (steps, cosine) = (0, 1.0);
        for (; cosine > Leaving + 0.02 && steps < 2 / step; steps++)
        {
            world.Step();
            var offset = body.Position - lowerBody.Position;
            cosine = offset.Y / offset.Length();
            Near.Equal(CentreDistance, offset.Length(), 2e-3);
            Near.Equal((Speed * Speed) + (2 * 9.8 * CentreDistance * (1 - cosine)), body.Velocity.LengthSquared(), 0.01 + (4 * step));
        }

        Assert.InRange(cosine, 0.5, Leaving + 0.02);
        // A little later it is in the air.
        world.Run((int)(0.25 / step));
        Assert.True((body.Position - lowerBody.Position).Length() > 1.01 * CentreDistance);
    }

    private static void CheckSliding(Random random, PlacedModel placed, Vector start, double extent, double speed)
    {
        var (radius, step) = (extent * Math.Pow(10, random.Between(-2, -0.5)), random.Between(0.002, 0.05));
        var world = TestWorlds.Create(TestWorlds.Gravity, step, placed);
        var velocity = speed * new Vector(random.NextDouble(), 0, random.NextDouble());
        var body = world.Add(new(start + new Vector(0, radius, 0), radius) { Restitution = random.NextDouble() });
        // It comes to rest first; what the first touch does has a test of its own.
        world.Run(5);
        var startTime = world.Time;
        world.SetVelocity(body, velocity);
        world.Run((int)Math.Min(400, extent / speed / step), () =>
        {
            Near.Equal(start.Y + radius, body.Position.Y, HeightTolerance * radius);
            Near.Equal(velocity, body.Velocity, SpeedTolerance * Math.Max(1, speed));
            Near.Equal(start + new Vector(0, radius, 0) + ((world.Time - startTime) * velocity), body.Position, 1e-7 * extent);
        });
    }

    private static Mesh Grid(Random random, int side)
    {
        var positions = from i in Enumerable.Range(0, side + 1)
                        from j in Enumerable.Range(0, side + 1)
                        let position = new Vector(i + random.Between(-0.3, 0.3), 0, j + random.Between(-0.3, 0.3))
                        from x in new[] { position.X, position.Y, position.Z }
                        select x;
        var faces = from i in Enumerable.Range(0, side)
                    from j in Enumerable.Range(0, side)
                    let corner = (i * (side + 1)) + j
                    from vertex in new[] { corner, corner + 1, corner + side + 1, corner + 1, corner + side + 2, corner + side + 1 }
                    select vertex;
        return new([.. positions], [.. faces]);
    }
}
