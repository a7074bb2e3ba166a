using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;
using Xunit.Sdk;

namespace FractalEngine.Tests.Physics;

/// <summary>Spheres that must not pass through anything, however fast and small they are and however long the step.</summary>
public class ShotTests
{
    /// <summary>Fraction of its radius by which a sphere may overlap anything.</summary>
    internal const double MaxOverlap = 1e-6;

    // Sine of the angle between path and surface, below which a shot is not followed: see Shot_AtTriangles.
    private const double GrazingSine = 0.15;

    /// <summary>Names of meshes and small fractals, see <see cref="ShotTarget"/>.</summary>
    public static TheoryData<string> Targets =>
    [
        "sphere", "cube", "plate", "soup", "small soup", "needles", "rough grid", "menger", "sierpinski", "tetrahedron", "terrain",
        "snowflake", "appendix-b",
    ];

    /// <summary>
    /// Until a sphere in free space hits a second triangle, its path is known. A sweep may miss what is grazed by less than 1/128 of the
    /// radius. So the path is followed only where its angle to the surface has a sine above 0.15: 1 − √(1 − 0.15²) > 1/128.
    /// </summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(12)]
    [InlineData(40)]
    public void Shot_AtTriangles_BouncesWhereGeometrySays(int faces)
    {
        var bounced = 0;
        Seeded.Run(25, random => bounced += ShootAtTriangles(random, faces, 80));
        AssertEnoughBounces(bounced, 25 * 80);
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Shot_AtTrianglesForLong_BouncesWhereGeometrySays()
    {
        var bounced = 0;
        Parallel.For(1, 4001, seed => Seeded.RunOne(
            seed, random => Interlocked.Add(ref bounced, ShootAtTriangles(random, 1 + (seed % 40), 100))));
        AssertEnoughBounces(bounced, 4000 * 100);
    }

    [Fact]
    public void Shot_HeadOnWithoutBounce_StaysOnItsSide() => Seeded.RunMost(2000, random =>
    {
        var (a, b, c) = (random.Vector(), random.Vector(), random.Vector());
        var cross = Vector.Cross(b - a, c - a);
        if (cross.Length() < 0.05)
        {
            return false;
        }

        var normal = (random.Next(2) == 0 ? 1 : -1) * cross.UnitVector();
        var radius = Math.Pow(10, random.Between(-3, 0));
        var speed = Math.Pow(10, random.Between(0, 2.7));
        var centroid = 1 / 3.0 * (a + b + c);
        var aim = centroid + (random.Between(0, 0.3) * (random.Next(3) switch { 0 => a, 1 => b, _ => c } - centroid));
        var triangle = PhysicsMeshes.FromTriangles((a, b, c));
        var world = TestWorlds.Create(Vector.Zero, Math.Pow(10, random.Between(-4, -1)), TestWorlds.Place(triangle));
        var body = world.AddSphere(aim + ((radius + random.Between(0.001, 2)) * normal), radius, velocity: -speed * normal);
        world.Run((int)Math.Min(30, 2 + (3 / speed / world.Settings.TimeStep)), () =>
        {
            var height = Vector.Dot(body.Position - aim, normal);
            Assert.True(height >= radius * (1 - MaxOverlap),
                $"radius {radius:R}, speed {speed:R}, step {world.Settings.TimeStep:R}: {height:R} from its plane");
        });
        return true;
    });

    [Theory]
    [MemberData(nameof(Targets))]
    public void Shot_AtATarget_NeverOverlapsIt(string name) => new ShotTarget(name).Shoot(1, 400);

    [Theory]
    [MemberData(nameof(Targets))]
    [Trait("Category", "Soak")]
    public void Shot_AtATargetForLong_NeverOverlapsIt(string name) =>
        Parallel.For(0, 40, batch => new ShotTarget(name).Shoot(1000 * (batch + 1), 1000));

    [Fact]
    public void Shot_AtRandomFractals_NeverOverlapsThem()
    {
        var hits = 0;
        Seeded.Run(40, random => hits += ShootAtFractal(random, 10));
        AssertEnoughHits(hits, 40 * 10);
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Shot_AtRandomFractalsForLong_NeverOverlapsThem()
    {
        var hits = 0;
        Parallel.For(1, 1001, seed => Seeded.RunOne(seed, random => Interlocked.Add(ref hits, ShootAtFractal(random, 50))));
        AssertEnoughHits(hits, 1000 * 50);
    }

    [Fact]
    public void Shot_InAClosedBox_StaysInside() => ShootInside(1000);

    [Fact]
    [Trait("Category", "Soak")]
    public void Shot_InAClosedBoxForLong_StaysInside() => ShootInside(100_000);

    [Fact]
    public void Shot_AtTheInfiniteMenger_NeverOverlapsIt() => ShootAtInfiniteMenger(300);

    [Fact]
    [Trait("Category", "Soak")]
    public void Shot_AtTheInfiniteMengerForLong_NeverOverlapsIt() => ShootAtInfiniteMenger(30_000);

    /// <summary>Shoots at random triangles.</summary>
    /// <returns>The number of shots that were followed beyond a bounce.</returns>
    private static int ShootAtTriangles(Random random, int count, int shots)
    {
        var faces = Enumerable.Range(0, count).Select(_ => random.Vector())
            .Select(corner => (A: corner, B: corner + random.Vector(0.7), C: corner + random.Vector(0.7)))
            .Where(face => Vector.Cross(face.B - face.A, face.C - face.A).Length() > 0.01).ToArray();
        if (faces.Length == 0)
        {
            return 0;
        }

        var bounced = 0;
        var oracle = new SphereTriangleOracle(faces);
        var target = PhysicsMeshes.FromTriangles(faces);
        var world = TestWorlds.Create(Vector.Zero, Math.Pow(10, random.Between(-4, -1)), TestWorlds.Place(target));
        for (var shot = 0; shot < shots; shot++)
        {
            var radius = Math.Pow(10, random.Between(-3, -0.5));
            var speed = Math.Pow(10, random.Between(0, 2.7));
            var (a, b, c) = faces[random.Next(faces.Length)];
            var (u, v) = (random.NextDouble(), random.NextDouble());
            var aim = u + v > 1 ? c : a + (u * (b - a)) + (v * (c - a));
            // One in four comes in the plane of the face, towards its edges. All arrive within some steps.
            var direction = random.Next(4) == 0
                ? ((random.Between(-1, 1) * (b - a)) + (random.Between(-1, 1) * (c - a))).UnitVector()
                : random.Direction();
            var startDistance = Math.Max(1.5 * radius, Math.Min(random.Between(0.1, 3), 20 * speed * world.Settings.TimeStep));
            var start = aim + (startDistance * direction);
            if (oracle.Distance(start) < radius * (1 + 1e-6))
            {
                continue;
            }

            var description = new BodyDescription(start, radius)
            {
                Velocity = speed * (aim - start).UnitVector(), Restitution = random.Between(0.1, 1),
            };
            bounced += FollowShot(world, oracle, description) ? 1 : 0;
        }

        return bounced;
    }

    /// <summary>Steps a shot, and compares its path with the oracle's up to the second hit.</summary>
    /// <returns>True when the shot was followed beyond a bounce.</returns>
    private static bool FollowShot(PhysicsWorld world, SphereTriangleOracle oracle, BodyDescription shot)
    {
        world.Reset();
        var body = world.Add(shot);
        // The straight path that the sphere is on, since when, and what it hits next.
        var start = shot.Position;
        var velocity = shot.Velocity;
        var startTime = 0.0;
        var hit = oracle.FindFirstHit(start, velocity, shot.Radius);
        var hits = 0;
        var isFollowed = false;
        // Until it has flown out of reach, 40 steps at most.
        for (var step = 0; step < 40 && body.Position.Length() < 5; step++)
        {
            world.Step();
            Require(oracle.Distance(body.Position) >= shot.Radius * (1 - MaxOverlap), "overlaps");
            var time = world.Time;
            while (hits == 0 && hit is { } first && first.Time <= time)
            {
                var normal = (start + (first.Time * velocity) - first.Point).UnitVector();
                var approach = Vector.Dot(velocity, normal);
                if (approach > -GrazingSine * velocity.Length())
                {
                    hits = 2;
                    hit = null;
                    break;
                }

                startTime = first.Time;
                start += first.Time * velocity;
                velocity -= (1 + shot.Restitution) * approach * normal;
                hits = 1;
                // A little off the surface that it has just hit, so that it does not hit that again.
                hit = oracle.FindFirstHit(start + (1e-9 * shot.Radius * normal), velocity, shot.Radius);
            }

            // By the second hit, an error has grown by the distance over the radius.
            if (hits < 2 && !(hits == 1 && startTime + hit?.Time <= time * (1 + 1e-9)))
            {
                // The impact is found to 1e-10 of the radius. At a sine of 0.15 the point moves by 7 times as much, and the normal turns
                // by that over the radius, over a distance of some units.
                isFollowed |= hits == 1;
                var expected = start + ((time - startTime) * velocity);
                var tolerance = 1e-8 * (1 + ((time - startTime) * velocity.Length()));
                Require((body.Position - expected).Length() <= tolerance, $"is not at {expected}");
            }
            else
            {
                hits = 2;
            }
        }

        return isFollowed;

        void Require(bool condition, string description)
        {
            if (!condition)
            {
                var state = $"step {world.Settings.TimeStep:R}, after {world.StepCount}: at {body.Position} it {description}";
                throw new XunitException($"{shot}, {state}; distance {oracle.Distance(body.Position):R}");
            }
        }
    }

    /// <summary>Shoots at a random fractal, unless it has too many instances for the oracle.</summary>
    /// <returns>The number of shots that hit.</returns>
    private static int ShootAtFractal(Random random, int shots)
    {
        var fractal = RandomFractals.CreateAny(random);
        if (fractal.InstanceCount > 2000)
        {
            return 0;
        }

        var mesh = FractalGenerator.Flatten(fractal, 1_000_000);
        // All faces of all instances, by maps that share nothing with the engine's.
        var faces = NaiveFractal.Corners(fractal.Description, fractal.BaseMesh, NaiveFractal.MapOf(Transformation.Identity)).Chunk(3)
            .Select(corners => (corners[0], corners[1], corners[2])).ToArray();
        var oracle = new SphereTriangleOracle(faces);
        var world = TestWorlds.Create(
            random.Vector(10 * fractal.Bounds.Diagonal), Math.Pow(10, random.Between(-4, -1)), TestWorlds.Place(fractal));
        var hits = 0;
        for (var shot = 0; shot < shots; shot++)
        {
            hits += ShotTarget.ShootOnce(random, world, mesh, oracle.Distance) ? 1 : 0;
        }

        return hits;
    }

    private static void ShootInside(int shots) => Seeded.Run(shots, random =>
    {
        var isSphere = random.Next(3) == 0;
        var mesh = isSphere ? PhysicsMeshes.FlipWinding(MeshGenerators.Create("icosphere", 1, 80)) : PhysicsMeshes.InwardCube;
        var size = mesh.Bounds.Size.MaxAbsComponent();
        var world = TestWorlds.Create(random.Vector(20), Math.Pow(10, random.Between(-4, -1)), TestWorlds.Place(mesh));
        var radius = size * Math.Pow(10, random.Between(-3, -0.7));
        var speed = Math.Pow(10, random.Between(0, 2.7));
        var body = world.Add(new(0.15 * random.Vector(size), radius)
        {
            Velocity = speed * random.Direction(),
            Restitution = random.Next(3) switch { 0 => 0, 1 => 1, _ => random.NextDouble() },
            Friction = random.Next(2) * random.NextDouble(),
        });
        var faces = PhysicsMeshes.TrianglesOf(mesh);
        world.Run((int)Math.Clamp(3 * size / speed / world.Settings.TimeStep, 10, 100), () =>
        {
            foreach (var (a, b, c) in faces)
            {
                // Both meshes are convex, so inside is in front of all faces.
                var height = Vector.Dot(body.Position - a, Vector.Cross(b - a, c - a).UnitVector());
                if (!(height >= radius * (1 - MaxOverlap)))
                {
                    throw new XunitException(
                        $"{body.Description}, step {world.Settings.TimeStep:R}, after {world.StepCount}: {height:R} from a wall");
                }
            }
        });
    });

    private static void ShootAtInfiniteMenger(int shots)
    {
        // Besides the overlap: the thirds in the fractal's file have 15 digits, the oracle's distance 9.
        const double OracleError = 1e-8;
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(AssetFractals.Load("infinite-menger")));
        var hits = 0;
        Seeded.Run(shots, random => hits += ShotTarget.ShootOnce(
            random, world, PhysicsMeshes.Cube, position => MengerDistanceOracle.Distance(position) + OracleError) ? 1 : 0);
        AssertEnoughHits(hits, shots);
    }

    /// <summary>Fails unless enough shots were followed beyond a bounce: most are aimed well, but some graze or begin too close.</summary>
    private static void AssertEnoughBounces(int bounced, int shots) => Seeded.AssertMost(bounced, shots, minShare: 0.25);

    /// <summary>
    /// Fails unless enough shots hit. The others begin too close, are deflected by too little, or were meant for a fractal of too many
    /// instances.
    /// </summary>
    private static void AssertEnoughHits(int hits, int shots) => Seeded.AssertMost(hits, shots, minShare: 0.5);
}
