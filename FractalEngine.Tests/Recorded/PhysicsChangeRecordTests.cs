using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Physics;
using FractalEngine.Tests.Support;
using static FractalEngine.Tests.Recorded.RecordedWorlds;

namespace FractalEngine.Tests.Recorded;

/// <summary>Worlds with objects that move, characters, queries, and what callers do to bodies: what happens, and what it costs.</summary>
public class PhysicsChangeRecordTests
{
    private static readonly int[] Few = [1, 2, 10, 40];

    // A floor two units below the origin.
    private static readonly Mesh Deep = PhysicsMeshes.FloorMesh().Transform(static vertex => vertex - (2 * Vector.J));

    [Fact]
    public void Objects_ThatMove() => RecordedText.Check("physics-moving.txt",
    [
        .. RecordMoving("lift", new(0, 1.5, 0), Vector.Zero, Vector.Zero, Ball(new(0, 0.8, 0), 0.3, 1), Ball(new(0.5, 1.4, 0), 0.3, 2)),
        .. RecordMoving("sinking", new(0, -20, 0), Vector.Zero, Vector.Zero, Ball(new(0, 0.8, 0), 0.3, 1)),
        .. RecordMoving("turntable", new(0.3, 0, 0), new(0, 2, 0), Vector.Zero, Ball(new(0.6, 0.8, 0.3), 0.3, 3),
            Compound(new(-0.5, 0.75, 0), Bar, 2)),
        .. RecordMoving("tilting", Vector.Zero, new(0.4, 0, -0.6), Vector.Zero, Ball(new(0.3, 0.8, 0.3), 0.3, 3),
            Ball(new(-0.5, 0.7, 0), 0.2, 1)),
        .. RecordMoving("belt", Vector.Zero, Vector.Zero, new(2, 0, 1), Ball(new(0, 0.8, 0), 0.3, 3),
            Compound(new(-0.5, 0.75, 0.8), Bar, 4)),
        .. RecordMoving("turning belt", Vector.Zero, new(0, 1, 0), new(1, 0, 0), Ball(new(0.3, 0.8, 0), 0.3, 3)),
        .. RecordMoving("pusher", new(9, 0, 0), Vector.Zero, Vector.Zero, Ball(new(2, 0.3, 0), 0.3, 3),
            Ball(new(2.7, 0.3, 0.1), 0.3, 2), Ball(new(3.4, 0.3, 0), 0.3, 1)),
        .. RecordMoving("blade", Vector.Zero, new(0, 8, 0), Vector.Zero, Ball(new(1.2, 0.2, 1.2), 0.3, 3),
            Compound(new(-1.5, 0.2, 1), Odd, 2)),
        .. RecordMoving("fast blade", new(1, 0, 0), new(3, 60, 0), Vector.Zero, Ball(new(1.3, 0.2, 1.1), 0.3, 3),
            Ball(new(2.2, 0.2, 0.1), 0.1, 3)),
        .. RecordMoving("hammer", new(0, -4, 0), Vector.Zero, Vector.Zero, Ball(new(0, -1.2, 0), 0.3, 3), Ball(new(0.3, -1.7, 0), 0.2, 3)),
        .. Record("to and fro", PathWorld(), Few),
        .. RecordSleepers(),
    ]);

    [Fact]
    public void Bodies_ThatAreActedOn()
    {
        var lines = new List<string>();
        var world = OnFloor([.. Pyramid(3), Compound(new(4, 0.3, 0), Bar, 2)]);
        lines.AddRange(Record("acts", world, [1, 5, 10, 60, 110, 130, 160, 200], step =>
        {
            var (ball, bar) = (world.Bodies[2], world.Bodies[^1]);
            switch (step)
            {
                case 3: world.ApplyImpulse(ball, new(0.5, 0.1, 0)); break;
                case 4: world.ApplyImpulse(bar, new(0.1, 0.3, 0.4), bar.Position + new Vector(0.3, 0.1, 0)); break;
                case 5: world.ApplyForce(ball, new(3, 0, 1), ball.Position + new Vector(0, 0.2, 0)); break;
                case 6: world.ApplyForce(bar, new(3, 0, 1), bar.Position + new Vector(0, 0.2, 0)); break;
                case 7: world.SetForce(ball, new(0, 2, 0)); break;
                case 12: world.SetForce(ball, Vector.Zero); break;
                case 110: world.SetVelocity(world.Bodies[0], new(2, 1, 0)); break;
                case 120: world.Gravity = new(0, -5, 1); break;
                case 130: world.AddSphere(new(0, 4, 0.1), 0.2, velocity: new(0, -3, 0)); break;
                case 140: world.ShrinkageOverride = 0.3; break;
                case 150: world.ShrinkageOverride = null; break;
                case 160: world.AddStatic(PhysicsMeshes.Cube, new(new(0.4, 0.2, 0), Vector.Zero, Vector.One)); break;
                case 170: world.StaticObjects[0].MoveTo(Transformation.At(new Vector(0, -0.3, 0))); break;
                case 180: world.StaticObjects[1].Mask = 0; break;
                case 190: world.StaticObjects[1].IsTrigger = true; break;
            }
        }));
        var other = PathWorld();
        lines.AddRange(Record("scene", other, [3, 30]));
        // Bodies of the scene are matched, and those that were added are copied.
        other.AddRange([Ball(new(0.4, 3, 0), 0.2, 2), Compound(new(-1, 2, 0), Odd, 3)]);
        other.Run(5);
        var continued = PathWorld();
        continued.Continue(other);
        lines.Add(new WorldRecorder("continued", continued).Line());
        lines.AddRange(Record("continued", continued, [36, 60]));
        string[] advances = [.. new[] { 0.11, -1, 0.02, 9 }.Select(seconds =>
            $"{continued.Advance(seconds)} {RecordedText.Text(continued.InterpolationAlpha)} {RecordedText.Text(continued.Time)}")];
        lines.AddRange(advances);
        lines.AddRange(continued.GetCurrentScene(0.3).Objects.Concat(continued.GetCurrentScene().Objects).Select(Text));
        continued.Reset();
        lines.AddRange(Record("reset", continued, Few));
        var sleepers = OnFloor([.. Enumerable.Range(0, 9).Select(static i => Ball(new(i % 3, 0.5, i / 3 * 1.0001), 0.5, i) with
        {
            Restitution = 0, Velocity = new(0, 0, i == 8 ? 0.1 : 0), RollingFriction = 0.1,
        })]);
        lines.AddRange(Record("sleepers", sleepers, [20, 40, 80, 81, 90, 140], step =>
        {
            if (step == 80)
            {
                sleepers.Add(Ball(new(1, 1.6, 1), 0.4, 3) with { Velocity = new(0, -4, 0) });
            }
        }));
        var shrinking = Over([PhysicsMeshes.FloorMesh(), Slot(0.8)],
            Ball(new(0, 1, 0), 0.6, 2) with { Shrinkage = 0.4, MinScale = 0.5 }, Ball(new(3, 0.5, 0), 0.5, 3) with { Shrinkage = 0.2 },
            Ball(new(3, 1.5, 0), 0.5, 4) with { Shrinkage = 3, MinScale = 0.3 });
        lines.AddRange(Record("shrinking", shrinking, [1, 10, 40, 80]));
        RecordedText.Check("physics-acts.txt", lines);
    }

    [Fact]
    public void Events_OfContactsAndTriggers()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true, SleepSpeed = 0.1, TimeBeforeSleep = 0.2 }).Fill(
            [PhysicsMeshes.FloorMesh()],
            [.. Pyramid(2), Ball(new(3, 1, 0), 0.3, 2), Compound(new(5, 0.5, 0), Bar, 3), Ball(new(5, 1.2, 0), 0.2, 2)]);
        var trigger = world.AddStatic(PhysicsMeshes.Cube, new(new(3, 0.5, 0), Vector.Zero, Vector.One));
        trigger.IsTrigger = true;
        var moving = world.AddStatic(PhysicsMeshes.Cube, new(new(-6, 0.5, 0), Vector.Zero, Vector.One));
        moving.SetMotion(new(4, 0, 0));
        var lines = new List<string>();
        var recorder = new WorldRecorder("events", world);
        foreach (var line in recorder.Run([.. Enumerable.Range(1, 16).Select(static i => 4 * i)]))
        {
            lines.Add(line);
            lines.Add(string.Join(' ', world.ContactEvents.Select(static one =>
                $"{one.Phase}:{one.Body.Index}-{one.OtherBody?.Index}{(one.StaticObject is { } target ? "s" + target.Index : "")}")));
        }

        RecordedText.Check("physics-events.txt", lines);
    }

    [Fact]
    public void Characters_ThatWalk() => RecordedText.Check("physics-characters.txt",
    [
        .. RecordWalk("plain", [PhysicsMeshes.FloorMesh()], null, static step => (new(1, 0, 0.5), step == 20)),
        .. RecordWalk("steps", [PhysicsMeshes.FloorMesh(), .. Steps()], null, static step => (Vector.I, step == 50)),
        .. RecordWalk("slope", [Slope(35), PhysicsMeshes.FloorMesh()], null, static _ => (Vector.I, false)),
        .. RecordWalk("steep", [Slope(60), PhysicsMeshes.FloorMesh()], null, static step => (new(1, 0, 0.2), step % 30 == 0)),
        .. RecordWalk("downhill", [Slope(-40).Transform(static vertex => vertex - (1.2 * Vector.J))], null, static _ => (Vector.I, false)),
        .. RecordWalk("sponge", [PhysicsMeshes.FloorMesh()], PhysicsMeshes.CreateSponge(2), static step => (new(1, 0, 0.3), step == 10)),
        .. RecordWalk("among balls", [PhysicsMeshes.FloorMesh()], null, static step => (Vector.I, step == 30), null,
            Ball(new(1.2, 0.3, 0), 0.3, 2), Ball(new(2, 0.4, 0.1), 0.4, 3), Compound(new(3, 0.25, 0), Bar, 3)),
        .. RecordWalk("carried", [Deep, Shapes.Box(new(new(-3, -1, -3), new(3, 0, 3)))], null,
            static step => (step > 30 ? Vector.K : Vector.Zero, step == 45),
            static world => world.StaticObjects[1].SetMotion(new(0.2, 0.4, 0), new(0, 0.7, 0))),
        .. RecordWalk("pushed", [PhysicsMeshes.FloorMesh(), Shapes.Box(new(new(-3, 0.1, -1), new(-1, 2, 1)))], null,
            static _ => (Vector.Zero, false), static world => world.StaticObjects[1].SetMotion(new(3, 0, 0))),
        .. RecordWalk("under a ceiling", [PhysicsMeshes.FloorMesh(), Shapes.Box(new(new(-9, 2, -9), new(9, 3, 9)))], null,
            static step => (0.5 * Vector.K, step % 7 == 0)),
        .. RecordContinued(),
    ]);

    [Fact]
    public void Queries_OfManyKinds()
    {
        var random = new Random(4);
        var world = World([PhysicsMeshes.FloorMesh(), Shapes.Sphere(1)], TestWorlds.Gravity, PhysicsMeshes.CreateSponge(2),
            [Compound(new(1, 1.5, 0), Odd, 2), .. Balls(6, 6, 2)]);
        var turning = world.AddStatic(PhysicsMeshes.Cube, new(new(2, 1, 1), new(20, 30, 40), new(1, 2, 1.5)));
        turning.SetMotion(new(0.1, 0.2, 0.3), new(1, 2, 3));
        turning.Layer = 2;
        world.Run(5);
        var lines = new List<string>();
        for (var i = 0; i < 40; i++)
        {
            var (start, way) = (random.Vector(3), random.Vector(4));
            var mask = i % 4 == 0 ? 4u : Layers.All;
            var isRayHit = world.TryCastRay(new(start, way), out var ray, i % 3 == 0 ? 2 : double.PositiveInfinity, 0, mask);
            var isSphereHit = world.TryCastSphere(start, 0.05 + (0.01 * i), way, out var sphere, i % 5, mask);
            var isFound = world.TryFindClosest(start, ColliderKind.Exact, out var closest);
            lines.Add($"{i} ray {isRayHit} {Text(ray)} sphere {isSphereHit} {Text(sphere)} "
                + $"closest {isFound} {RecordedText.Text(closest.Distance)} {closest.Feature} tests {WorldRecorder.CountTests(world)}");
        }

        world.Step();
        lines.Add(new WorldRecorder("after", world).Line());
        RecordedText.Check("physics-queries.txt", lines);
    }

    private static IEnumerable<string> RecordMoving(
        string name, Vector velocity, Vector angularVelocity, Vector belt, params BodyDescription[] bodies)
    {
        var world = Over([Deep, Shapes.Box(new(new(-1.4, 0, -1.2), new(1.4, 0.5, 1.2)))], bodies);
        world.StaticObjects[1].SetMotion(velocity, angularVelocity);
        world.StaticObjects[1].SetBelt(belt);
        return Record(name, world, Few);
    }

    private static IEnumerable<string> RecordContinued()
    {
        var (previous, world) = (OnFloor(), OnFloor());
        var jumper = previous.AddCharacter(new(new(0, 1, 0), 0.3, 1.8));
        jumper.IsActive = true;
        jumper.MoveInput = Vector.I;
        jumper.Jump();
        previous.Run(9);
        world.Continue(previous);
        world.Character!.IsActive = true;
        return [new WorldRecorder("continued", world).Line(), .. Record("continued", world, [10, 30])];
    }

    private static IEnumerable<string> RecordSleepers()
    {
        var world = SleeperWorld();
        return Record("sleeper", world, [40, 60, 90], step =>
        {
            if (step == 50)
            {
                world.StaticObjects[1].SetMotion(new(-4, 0, 0), new(0, 1, 0));
            }
        });
    }

    private static IEnumerable<string> RecordWalk(
        string name, Mesh[] meshes, Fractal? fractal, Func<int, (Vector Input, bool Jumps)> act, Action<PhysicsWorld>? prepare = null,
        params BodyDescription[] bodies)
    {
        var world = World(meshes, TestWorlds.Gravity, fractal, bodies);
        var character = world.AddCharacter(new(new(0, fractal is null ? 1 : 1.6, 0), 0.3, 1.8));
        character.IsActive = true;
        prepare?.Invoke(world);
        return Record(name, world, [1, 10, 40, 80], step =>
        {
            (character.MoveInput, var jumps) = act(step);
            if (jumps)
            {
                character.Jump();
            }
        });
    }

    private static string Text(PlacedModel placed)
    {
        var (linear, position) = (placed.ObjectToWorld.Linear, placed.ObjectToWorld.Translation);
        return $"object {Text(position)} {Text(linear * Vector.I)} {Text(linear * Vector.J)}";
    }

    private static string Text(Vector vector) => RecordedText.Text(1 + vector.X + (2 * vector.Y) + (3 * vector.Z));

    private static string Text(in CastHit hit) => hit.Body is null && hit.StaticObject is null && hit.Distance == 0 ? "-"
        : $"{RecordedText.Text(hit.Distance)} {Text(hit.Point)} {Text(hit.Normal)} b{hit.Body?.Index} s{hit.StaticObject?.Index}";
}
