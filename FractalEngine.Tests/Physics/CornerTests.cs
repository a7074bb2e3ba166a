using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Bodies that touch several surfaces at once.</summary>
public class CornerTests
{
    // Relative to the radius.
    private const double MaxOverlap = 1e-6;

    // Scene units. Some grooves lead away downwards, but in the 30 s of the longest run no body comes so far.
    private const double FarEdge = 20_000;

    [Fact]
    public void Corner_OfThreePlanes_NeitherPenetratesNorAddsEnergy() => CheckCorner(150, 150);

    [Fact]
    [Trait("Category", "Soak")]
    public void Corner_OfThreePlanesForLong_NeitherPenetratesNorAddsEnergy() => CheckCorner(5_000, 300);

    [Fact]
    public void Corners_OfFractals_AddNoEnergy()
    {
        foreach (var name in new[] { "menger", "sierpinski", "tetrahedron", "snowflake" })
        {
            var placed = TestWorlds.Place(AssetFractals.Load(name, 2));
            Seeded.RunMost(10, random =>
            {
                var world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.002, 0.03), placed);
                var size = placed.Bounds.Diagonal;
                var height = 0.7 * size;
                var velocity = random.Vector(3);
                // It falls towards the middle of the fractal.
                var fallTime = Math.Sqrt(2 * height / 9.8);
                var target = placed.Bounds.Centre + random.Vector(0.3).Stretch(placed.Bounds.Size);
                var start = new Vector(
                    target.X - (fallTime * velocity.X), placed.Bounds.Centre.Y + height, target.Z - (fallTime * velocity.Z));
                var body = world.Add(new(start, random.Between(0.01, 0.1) * size)
                {
                    Restitution = random.Next(2) * random.NextDouble(), Friction = random.Next(2) * random.NextDouble(),
                    Velocity = velocity,
                });
                CheckEnergy(world, (int)Math.Max(300, 2 * fallTime / world.Settings.TimeStep), size);
                // A body that has hit nothing falls as from the beginning, up to some hundred roundings.
                return (body.Velocity - body.Description.Velocity - (world.Time * world.Gravity)).Length() > 1e-9;
            }, minShare: 0.7);
        }
    }

    [Fact]
    public void Slit_AsWideAsTheSphere_LetsItFall()
    {
        var walls = PhysicsMeshes.FromTriangles(
            PhysicsMeshes.PlaneTriangle(new(-0.5, 0, 0), Vector.I), PhysicsMeshes.PlaneTriangle(new(0.5, 0, 0), -Vector.I));
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(walls));
        var body = world.Add(new(Vector.Zero, 0.5));
        world.Run(60, () => Assert.InRange(Math.Abs(body.Position.X), 0, MaxOverlap));
        // A free fall of one second: ½·9.8.
        Near.Equal(-4.9, body.Position.Y, 1e-6);
    }

    /// <summary>
    /// The moment of this impact lies between two neighbouring doubles, the later one even: halving the time between them never ends.
    /// </summary>
    [Fact]
    public void Step_WithoutATimeInBetween_Ends()
    {
        Vector[] normals =
        [
            new(0.17257901991850758, 0.8028422418663766, 0.5706669927014685),
            new(-0.7585652770047524, 0.5649615159364958, 0.32464935859083366),
            new(-0.02770280104002601, 0.5215446756759484, -0.8527741237212856),
        ];
        var corner = PhysicsMeshes.FromTriangles([.. normals.Select(normal => PhysicsMeshes.PlaneTriangle(Vector.Zero, normal, 1000))]);
        var world = TestWorlds.Create(TestWorlds.Gravity, 0.045447124385289764, TestWorlds.Place(corner));
        var velocity = new Vector(0.9551074220589868, 9.029697821955057, 5.162879012135267);
        world.AddSphere(new(0, 0.7219706945285043, 0), 0.08265429241889093, velocity: velocity);
        // A step that does not end can't be counted or stopped. All of them take some milliseconds.
        var run = new Thread(() => world.Run(300)) { IsBackground = true };
        run.Start();
        Assert.True(run.Join(Polling.Deadline), "a step has not ended");
        Assert.Equal(300, world.StepCount);
    }

    private static void CheckCorner(int cases, int steps) => Seeded.Run(cases, random =>
    {
        // Three normals that all point up at least a little, spread around the vertical.
        var rotationAngle = random.Between(0, 2 * Math.PI);
        Vector[] normals = [.. Enumerable.Range(0, 3).Select(i => rotationAngle + ((i + random.Between(-0.35, 0.35)) * 2 * Math.PI / 3))
            .Select(angle => new Vector(Math.Cos(angle), random.Between(0.05, 2), Math.Sin(angle)).UnitVector())];
        var radius = Math.Pow(10, random.Between(-1.5, 0));
        var corner = PhysicsMeshes.FromTriangles([.. normals.Select(normal => PhysicsMeshes.PlaneTriangle(Vector.Zero, normal, FarEdge))]);
        var world = TestWorlds.Create(TestWorlds.Gravity, Math.Pow(10, random.Between(-3, -1)), TestWorlds.Place(corner));
        var start = random.Between(3, 30) * radius * Vector.J;
        var lowest = normals.Min(normal => Vector.Dot(start, normal));
        // Clear of all of them at first.
        start *= lowest < 1.5 * radius ? 1.5 * radius / lowest : 1;
        world.Add(new(start, radius)
        {
            Velocity = random.Vector(10), Restitution = random.Next(3) switch { 0 => 0, 1 => 0.95, _ => random.NextDouble() },
            Friction = random.Next(2) * random.NextDouble(),
        });
        var body = world.Bodies[0];
        CheckEnergy(world, steps, start.Length(), () =>
        {
            foreach (var normal in normals)
            {
                var height = Vector.Dot(body.Position, normal);
                Assert.True(height >= radius * (1 - MaxOverlap),
                    $"{body.Description}, step {world.Settings.TimeStep:R}, after {world.StepCount}: {height:R} from a plane");
            }
        });
    });

    /// <summary>Checks that a world which nothing drives never gains energy.</summary>
    private static void CheckEnergy(PhysicsWorld world, int steps, double size, Action? afterEach = null)
    {
        var body = world.Bodies[0];
        var before = world.Energy();
        world.Run(steps, () =>
        {
            var after = world.Energy();
            // The rounding of a contact lifts a body by the allowed overlap at most.
            var tolerance = (1e-9 * (Math.Abs(before) + (9.8 * size))) + (9.8 * MaxOverlap * body.Radius);
            Assert.True(
                after <= before + tolerance,
                $"{body.Description}, step {world.Settings.TimeStep:R}, after {world.StepCount}: energy {after:R}, {before:R} before");
            before = Math.Min(before, after);
            afterEach?.Invoke();
        });
    }
}
