using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Bodies slide over flat surfaces without feeling the edges between faces.</summary>
public class SlidingTests
{
    // Relative to the radius, and to the speed: a normal that is off by 1e-9 at one seam would show.
    private const double HeightTolerance = 1e-7;
    private const double SpeedTolerance = 1e-9;

    [Fact]
    public void Sliding_OverManyTriangles_KeepsHeightAndVelocity() => Seeded.Run(40, random =>
    {
        var mesh = CreateGrid(random, 20);
        CheckSliding(random, TestWorlds.Place(mesh), new(2, 0, 2), 16, random.Between(0.05, 3));
    });

    [Fact]
    public void Sliding_OverARotatedPlane_KeepsHeightAndVelocity() => Seeded.Run(40, random =>
    {
        var mesh = CreateGrid(random, 20);
        var placement = Transformation.Identity with
        {
            Rotation = random.Degrees(),
            Position = random.Vector(5),
            Scale = new(random.Between(0.5, 2), 1, random.Between(0.5, 2)),
        };
        var placed = TestWorlds.Place(mesh, placement);
        var normal = placed.ObjectToWorld.Linear.Cofactors().V2.UnitVector();
        var radius = random.Between(0.1, 1);
        var step = random.Between(0.002, 0.05);
        var world = TestWorlds.Create(-9.8 * normal, step, placed);
        var start = placed.ObjectToWorld * new Vector(10, 0, 10);
        var velocity = 3 * Vector.Cross(normal, random.Direction());
        var body = world.Add(new(start + (radius * normal), radius));
        world.Run(5);
        world.SetVelocity(body, velocity);
        world.Run((int)(1 / step), () =>
        {
            // The last summand is for the rounding of coordinates below a hundred.
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
        // Cubes side by side: 4^depth of them make a slab.
        var maps = from x in new[] { -0.25, 0.25 }
                   from z in new[] { -0.25, 0.25 }
                   select Samples.MoveAndScale(x, 0, z, 0.5);
        var slab = Fractal.Of(PhysicsMeshes.Cube).Repeat(maps, depth);
        var halfHeight = Math.Pow(2, -depth) / 2;
        CheckSliding(random, TestWorlds.Place(slab), new(-0.4, halfHeight, -0.4), 0.6, random.Between(0.02, 0.5));
    });

    /// <summary>The path leads over the rim of the sponge, between its outer edge and its holes.</summary>
    [Fact]
    public void Sliding_OverTheRimOfTheMengerSponge_KeepsHeightAndVelocity() => Seeded.Run(10, random =>
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.002, 0.02), TestWorlds.Place(AssetFractals.Load("menger", 2)));
        // At this depth holes are 1/9 wide and begin 1/9 from the edge; the sphere touches at one point, 0.05 from the edge.
        var body = world.Add(new(new(-0.45, 0.5 + 0.1, -0.4), 0.1));
        world.Run(5);
        world.SetVelocity(body, new(0, 0, 0.5));
        world.Run((int)(1.5 / world.Settings.TimeStep), () =>
        {
            // The thirds in the fractal's file have 15 digits.
            Near.Equal(0.6, body.Position.Y, HeightTolerance * 0.1);
            Near.Equal(new(0, 0, 0.5), body.Velocity, SpeedTolerance);
        });
    });

    [Fact]
    public void Sliding_FromTheFirstContact_KeepsHeightAndVelocity() => Seeded.Run(100, random =>
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.002, 0.05), TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var radius = random.Between(0.02, 1);
        var velocity = new Vector(random.Between(0, 3), 0, random.NextDouble());
        var body = world.Add(new(new(0, radius, 0), radius) { Velocity = velocity });
        world.Run(20, () =>
        {
            Near.Equal(radius, body.Position.Y, HeightTolerance * radius);
            Near.Equal(velocity, body.Velocity, SpeedTolerance);
        });
    });

    /// <summary>
    /// Without friction, a sphere leaves the one under it where the cosine of the angle from the top is (2 + v²/(g·r))/3. Until then v²
    /// grows by 2·g·height.
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
        const double LeavingCosine = (2 + (Speed * Speed / (9.8 * CentreDistance))) / 3;
        var body = world.Add(new(lowerBody.Position + new Vector(0, CentreDistance, 0), 0.25) { Velocity = new(Speed, 0, 0) });
        var cosine = 1.0;
        for (var steps = 0; cosine > LeavingCosine + 0.02 && steps < 2 / step; steps++)
        {
            world.Step();
            var offset = body.Position - lowerBody.Position;
            cosine = offset.Y / offset.Length();
            Near.Equal(CentreDistance, offset.Length(), 2e-3);
            Near.Equal((Speed * Speed) + (2 * 9.8 * CentreDistance * (1 - cosine)), body.Velocity.LengthSquared(), 0.01 + (4 * step));
        }

        Assert.InRange(cosine, 0.5, LeavingCosine + 0.02);
        // A quarter of a second later it is in the air.
        world.Run((int)(0.25 / step));
        Assert.True((body.Position - lowerBody.Position).Length() > 1.01 * CentreDistance);
    }

    private static void CheckSliding(Random random, PlacedModel placed, Vector start, double extent, double speed)
    {
        var radius = extent * Math.Pow(10, random.Between(-2, -0.5));
        var step = random.Between(0.002, 0.05);
        var world = TestWorlds.Create(TestWorlds.Gravity, step, placed);
        var velocity = speed * new Vector(random.NextDouble(), 0, random.NextDouble());
        var body = world.Add(new(start + new Vector(0, radius, 0), radius) { Restitution = random.NextDouble() });
        // It comes to rest first: the first contact has a test of its own.
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

    /// <summary>A flat square grid with vertices shifted sideways by random amounts.</summary>
    private static Mesh CreateGrid(Random random, int side)
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
