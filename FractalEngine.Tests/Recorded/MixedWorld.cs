using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Physics;
using FractalEngine.Tests.Support;
using static FractalEngine.Tests.Recorded.RecordedWorlds;

namespace FractalEngine.Tests.Recorded;

/// <summary>What a mixed world consists of besides balls in a room.</summary>
[Flags]
internal enum WorldParts
{
    Balls = 0,
    Compounds = 1,
    Movers = 2,
    Character = 4,
    Layers = 8,
    Triggers = 16,
    Sleepers = 32,
    Fractal = 64,
    Shrinking = 128,
    Kinds = 256,
}

/// <summary>A world drawn by a seed, in which callers act on what is in it before each step.</summary>
internal sealed class MixedWorld
{
    private const double RoomSize = 2.4;

    private static readonly ColliderKind[] KindsOfMeshes =
        [ColliderKind.Exact, ColliderKind.Hierarchy, ColliderKind.BoundingBox, ColliderKind.Simple];

    private readonly Random _random;
    private readonly WorldParts _parts;
    private readonly CharacterController? _character;
    private readonly StaticObject[] _movers;
    private double _queries = 1;

    public MixedWorld(int seed, WorldParts parts, int count = 14)
    {
        _random = new(seed);
        _parts = parts;
        var isSleepy = Has(WorldParts.Sleepers);
        var settings = new PhysicsSettings
        {
            ReportsContacts = true, MaxThreads = 1 + (seed % 3), SleepSpeed = isSleepy ? 0.6 : null,
            TimeBeforeSleep = isSleepy ? 0.06 : 0.5, TimeStep = 1 / (seed % 2 == 0 ? 60.0 : 45.0),
            RestitutionThreshold = seed % 4 == 1 ? 0.05 : null,
        };
        World = new(CreateScene(), settings);
        World.AddStatic(PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, RoomSize), Transformation.At(new Vector(0, 0.5 * RoomSize, 0)));
        if (Has(WorldParts.Fractal))
        {
            World.AddStatic(PhysicsMeshes.CreateSponge(2), Transformation.At(new Vector(0.5, 0.4, 0.4), 0.8));
        }

        World.AddStatic(Shapes.Sphere(1), Transformation.At(new Vector(-0.6, 0.1, 0.5), 0.8));
        World.AddStatic(Slope(30), Transformation.At(new Vector(0.2, 0.05, -0.2)));
        _movers = Has(WorldParts.Movers) ? [.. Enumerable.Range(0, 3).Select(AddMover)] : [];
        if (Has(WorldParts.Triggers))
        {
            World.AddStatic(PhysicsMeshes.Cube, Transformation.At(new Vector(0.1, 0.4, 0), 0.9)).IsTrigger = true;
            World.AddStatic(PhysicsMeshes.InwardCube, Transformation.At(new Vector(-0.5, 0.3, -0.6), 0.7)).IsTrigger = true;
        }

        if (Has(WorldParts.Layers))
        {
            World.StaticObjects[1].Layer = 3;
            World.StaticObjects[2].Mask = 5;
        }

        World.AddRange(Enumerable.Range(0, count).Select(Describe));
        if (Has(WorldParts.Character))
        {
            _character = World.AddCharacter(new(new(-0.2, 0.6, 0.1), 0.12, 0.6)
            {
                WalkingSpeedOverride = seed % 3 == 0 ? 9 : null, StepHeightOverride = seed % 4 == 0 ? 0.05 : null,
                JumpSpeedOverride = seed % 5 == 0 ? 2 : null, MaxSlopeAngle = seed % 2 == 0 ? 25 : 50,
            });
            _character.IsActive = true;
        }
    }

    /// <summary>The world that is stepped.</summary>
    public PhysicsWorld World { get; }

    /// <summary>Steps a new world, begins it anew, and steps it once more.</summary>
    public static IEnumerable<string> Record(int seed, WorldParts parts)
    {
        var mixed = new MixedWorld(seed, parts);
        var name = $"{seed} {parts}";
        foreach (var line in new WorldRecorder(name, mixed.World).Run([1, 2, 4, 8, 16], mixed.Act))
        {
            yield return $"{line} queries {RecordedText.Text(mixed._queries)}";
        }

        mixed.World.Reset();
        yield return new WorldRecorder(name, mixed.World).Line();
        foreach (var line in new WorldRecorder(name, mixed.World).Run([1, 3]))
        {
            yield return line;
        }
    }

    private bool Has(WorldParts part) => (_parts & part) != 0;

    private static Scene CreateScene() => new()
    {
        Gravity = new(0.4, -9, -0.3),
        Objects =
        [
            new SceneObject(PhysicsMeshes.Cube)
            {
                Placement = new(new(0.6, 0.1, -0.7), new(0, 20, 0), new(0.5, 0.2, 0.6)), Belt = new(0.5, 0, 0.2),
                Motion = new() { Velocity = new(1.5, 0, 0), Spin = new(0, 60, 0), From = new(0.3, 0.1, -0.7), To = new(0.7, 0.1, -0.7) },
            },
            new PhysicsObject(new MeshModel(PhysicsMeshes.Cube), 0.4)
            {
                Placement = new(new(0.2, 1.2, 0.2), new(10, 20, 30), 0.2 * Vector.One), Friction = 0.4, RollingFriction = 0.01,
            },
            new PhysicsObject(new MeshModel(PhysicsMeshes.Cube), 0.1)
            {
                Placement = new(new(-0.5, 1.3, 0.3), Vector.Zero, new(0.4, 0.15, 0.15)), Shape = BodyShape.Capsule, Friction = 0.2,
                Velocity = new(-1, 0, 0), SpinningFriction = 0.05,
            },
        ],
    };

    private StaticObject AddMover(int i)
    {
        var size = new Vector(0.4 + (0.3 * (i % 2)), 0.15, 0.5);
        var mover = World.AddStatic(PhysicsMeshes.Cube, new(new(0.7 - (0.6 * i), 0.3 + (0.2 * i), 0.5 * (i - 1)), Vector.Zero, size));
        mover.SetMotion(_random.Vector(i == 0 ? 3 : 0.4), i == 1 ? _random.Vector(6) : Vector.Zero);
        if (i == 2)
        {
            mover.SetBelt(new(1, 0, -0.5));
        }

        return mover;
    }

    private BodyDescription Describe(int i)
    {
        var place = new Vector(_random.Between(-1, 1), _random.Between(0.15, 2), _random.Between(-1, 1));
        var isCompound = Has(WorldParts.Compounds) && i % 3 == 0;
        var description = isCompound
            ? Compound(place, i % 2 == 0 ? SmallBar : SmallOdd, i) : Ball(place, _random.Between(0.06, 0.22), i);
        return description with
        {
            Velocity = _random.Vector(i % 5 == 0 ? 9 : 2),
            AngularVelocity = _random.Vector(6),
            RollingFriction = 0.02 * (i % 3),
            SpinningFriction = 0.01 * (i % 4),
            Damping = i % 6 == 1 ? 0.4 : 0,
            IsRotationLocked = i % 7 == 3,
            Shrinkage = Has(WorldParts.Shrinking) && i % 2 == 0 ? 0.7 : 0,
            MinScale = 0.9,
            Layer = Has(WorldParts.Layers) ? i % 4 : 0,
            Mask = Has(WorldParts.Layers) && i % 3 == 0 ? 11 : Layers.All,
            Collider = Has(WorldParts.Kinds) ? KindsOfMeshes[i % KindsOfMeshes.Length] : ColliderKind.Exact,
        };
    }

    private static CompoundShape SmallBar { get; } =
        CompoundShape.Capsule(-0.2 * Vector.I, 0.2 * Vector.I, 0.1);

    private static CompoundShape SmallOdd { get; } =
        CompoundShape.OfBalls([new(-0.15 * Vector.I, 0.1), new(0.15 * Vector.J, 0.12), new(0.2 * Vector.K, 0.08)]);

    private void Act(int step)
    {
        var bodies = World.Bodies;
        var body = bodies[step * 5 % bodies.Count];
        switch (step % 12)
        {
            case 2: World.ApplyImpulse(body, _random.Vector(0.4), body.Position + _random.Vector(0.1)); break;
            case 3: World.ApplyForce(body, _random.Vector(9), body.Position + _random.Vector(0.1)); break;
            case 4: World.SetForce(body, _random.Vector(5)); break;
            case 5: World.SetVelocity(body, _random.Vector(4)); break;
            case 6: World.Add(Ball(new(0.1, 1.9, 0.1), 0.1, step) with { Velocity = -4 * Vector.J }); break;
            case 7: World.StaticObjects[2].MoveTo(Transformation.At(new Vector(-0.4, 0.05, 0.4), 0.7)); break;
            case 9: World.Gravity = new(-1, -8, 0.5); break;
            case 10: World.ShrinkageOverride = Has(WorldParts.Shrinking) ? 0.2 : null; break;
            case 11: World.ColliderOverride = Has(WorldParts.Kinds) ? ColliderKind.Hierarchy : null; break;
        }

        foreach (var mover in step == 8 ? _movers : [])
        {
            mover.SetMotion(-mover.Velocity, _random.Vector(2));
        }

        if (_character is { } character)
        {
            character.MoveInput = step % 5 == 0 ? new(1, 0, 0.4) : step % 5 == 3 ? new(-0.3, 0.2, 0.9) : character.MoveInput;
            if (step % 6 == 1)
            {
                character.Jump();
            }
        }

        Query(step);
    }

    private void Query(int step)
    {
        var (start, way) = (_random.Vector(0.8) + Vector.J, _random.Vector(3));
        var (layer, mask) = (step % 4, step % 2 == 0 ? Layers.All : 0b1001u);
        if (World.TryCastSphere(start, 0.05, way, out var hit, layer, mask))
        {
            Add(in hit);
        }

        if (World.TryCastRay(new Ray(start, way), out hit, step % 3 == 0 ? 0.8 : double.PositiveInfinity, layer, mask))
        {
            Add(in hit);
        }

        if (World.TryFindClosest(start, KindsOfMeshes[step % KindsOfMeshes.Length], out var closest))
        {
            _queries += 1.7 * closest.Distance;
        }
    }

    private void Add(in CastHit hit) => _queries += (1.1 * hit.Distance) + (1.3 * hit.Normal.X) + (1.7 * hit.Normal.Y)
        + (1.9 * Vector.Dot(hit.Point, new(1, 2, 3))) + (3 * (hit.Body?.Index ?? -1)) + (5 * (hit.StaticObject?.Index ?? -1));
}
