using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;
using Xunit.Sdk;

namespace FractalEngine.Tests.Physics;

/// <summary>A mesh or fractal to shoot at, with an independent way to find its distance.</summary>
internal sealed class ShotTarget
{
    // A body's position is rounded at each of its impacts, and so are the corners of faces. What is nearer than this part of the
    // coordinates counts as touched, which tells for tiny spheres far away.
    private const double Rounding = 1e-14;

    private readonly PlacedModel _placed;
    private readonly Mesh _mesh;
    private readonly Func<Vector, double> _distance;
    private readonly double[][][] _cells = [];

    public ShotTarget(string name)
    {
        (_placed, _mesh) = name switch
        {
            "sphere" => CreateTarget(MeshGenerators.Create("icosphere", 1, 320)),
            "cube" => CreateTarget(PhysicsMeshes.Cube),
            "plate" => CreateTarget(PhysicsMeshes.Cube.Transform(v => v.Stretch(new(1, 1e-6, 1)))),
            "soup" => CreateTarget(CollisionMeshes.TriangleSoup(1, 200, 0.3)),
            "small soup" => CreateTarget(CollisionMeshes.TriangleSoup(2, 200, 0.02)),
            "needles" or "rough grid" => CreateTarget(CollisionMeshes.All[name]()),
            _ => CreateTarget(WithSmallDepth(AssetFractals.Load(name), name)),
        };
        var context = new QueryContext();
        Collider other = _mesh.FaceCount <= 400 ? new SimpleCollider(_mesh) : new HierarchyCollider(_mesh);
        _distance = position => other.TryFindClosest(position, double.PositiveInfinity, context, out var closest)
            ? closest.Distance
            : double.PositiveInfinity;
        if (name is "menger")
        {
            _cells = [.. NaiveFractal.Chains(((FractalModel)_placed.Model).Fractal.Description)];
        }
    }

    /// <summary>Shoots from random positions, and fails unless enough shots hit and none overlaps the target.</summary>
    public void Shoot(int firstSeed, int shots)
    {
        var hits = 0;
        var stepLengths = new Random(firstSeed);
        PhysicsWorld[] worlds = [.. Enumerable.Range(0, 4).Select(i =>
            TestWorlds.Create(i == 0 ? Vector.Zero : TestWorlds.Gravity, Math.Pow(10, stepLengths.Between(-4, -1)), _placed))];
        for (var seed = firstSeed; seed < firstSeed + shots; seed++)
        {
            Seeded.RunOne(seed, random =>
                hits += ShootOnce(random, worlds[random.Next(worlds.Length)], _mesh, _distance, IsInside) ? 1 : 0);
        }

        // Some begin too close, others are deflected by so little that they don't count.
        Assert.InRange(hits, shots / 5, shots);
    }

    /// <summary>Shoots a sphere at a random face, and fails if it overlaps anything.</summary>
    /// <returns>True when the sphere hit something.</returns>
    public static bool ShootOnce(
        Random random, PhysicsWorld world, Mesh mesh, Func<Vector, double> distance, Func<Vector, bool>? isInside = null)
    {
        var size = mesh.Bounds.Diagonal;
        var radius = size * Math.Pow(10, random.Between(-3, -0.7));
        var (a, b, c) = mesh.Face(random.Next(mesh.FaceCount));
        var aim = 1 / 3.0 * (a + b + c);
        var speed = size * Math.Pow(10, random.Between(0, 2.7));
        // It arrives within ten steps.
        var startDistance = Math.Max(1.5 * radius, Math.Min(random.Between(0.1, 1) * size, 10 * speed * world.Settings.TimeStep));
        var start = aim + (startDistance * random.Direction());
        // Some random fractals are smaller than the rounding of where they are.
        if (start == aim || distance(start) < radius * (1 + 1e-6) || isInside?.Invoke(start) == true)
        {
            return false;
        }

        var velocity = speed * (aim - start).UnitVector();
        world.Reset();
        var body = world.Add(new(start, radius)
        {
            Velocity = velocity,
            Restitution = random.Next(3) switch { 0 => 0, 1 => 1, _ => random.NextDouble() },
            Friction = random.Next(2) * random.NextDouble(),
        });
        for (var step = 0; step < 20 && (body.Position - mesh.Bounds.Centre).Length() < 3 * size; step++)
        {
            world.Step();
            var gap = distance(body.Position);
            var minGap = (radius * (1 - ShotTests.MaxOverlap)) - (Rounding * body.Position.MaxAbsComponent());
            if (!(gap >= minGap) || isInside?.Invoke(body.Position) == true || body.IsStuck)
            {
                var settings = $"step {world.Settings.TimeStep:R}, gravity {world.Gravity}, after {world.StepCount}";
                var state = $"{gap:R} from the surface, inside: {isInside?.Invoke(body.Position)}, stuck: {body.IsStuck}";
                throw new XunitException($"{body.Description}, {settings}: at {body.Position}, {state}");
            }
        }

        return Vector.Cross(body.Velocity - (world.Time * world.Gravity), velocity).Length() > 1e-6 * speed * speed
            || Vector.Dot(body.Velocity, velocity) <= 0;
    }

    /// <summary>True inside one of the solid cubes, for targets that consist of cubes.</summary>
    private bool IsInside(Vector position)
    {
        foreach (var cell in _cells)
        {
            // The maps of the sponge only translate and scale.
            var offset = position - new Vector(cell[0][3], cell[1][3], cell[2][3]);
            if (offset.MaxAbsComponent() < 0.5 * cell[0][0])
            {
                return true;
            }
        }

        return false;
    }

    private static (PlacedModel, Mesh) CreateTarget(Mesh mesh) => (TestWorlds.Place(mesh), mesh);

    private static (PlacedModel, Mesh) CreateTarget(Fractal fractal) =>
        (TestWorlds.Place(fractal), FractalGenerator.Flatten(fractal, 1_000_000));

    private static Fractal WithSmallDepth(Fractal asset, string name) =>
        asset.WithDepth(name switch { "menger" => 2, "sierpinski" or "tetrahedron" or "terrain" => 4, "snowflake" => 2, _ => 1 });
}
