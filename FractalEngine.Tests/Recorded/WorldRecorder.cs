using System.Globalization;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Separation;
using FractalEngine.Core.Physics.Solving;

namespace FractalEngine.Tests.Recorded;

/// <summary>Steps a world, and sums up where its bodies are, what acts on them, and the work that it took.</summary>
/// <param name="name">Name of the world in the recorded lines.</param>
/// <param name="world">Stepped by this object only.</param>
internal sealed class WorldRecorder(string name, PhysicsWorld world)
{
    private const double GoldenFraction = 0.6180339887498949;

    // Sums over all steps so far.
    private readonly Total _events = new();
    private readonly Total _forces = new();
    private (long Faces, long Bounds) _tests;
    private long _islands;
    private long _pairs;
    private long _bodies;
    private long _eventCount;

    /// <summary>Makes steps up to given numbers of them.</summary>
    /// <param name="steps">Numbers of steps, ascending: a line for each.</param>
    /// <param name="beforeEach">Acts before each step, whose index it gets.</param>
    public IEnumerable<string> Run(int[] steps, Action<int>? beforeEach = null)
    {
        foreach (var end in steps)
        {
            while (world.StepCount < end)
            {
                beforeEach?.Invoke((int)world.StepCount);
                world.Step();
                Count();
            }

            yield return Line();
        }
    }

    /// <summary>Counts what the last step did.</summary>
    public void Count()
    {
        var (faces, bounds) = world.LastStepCost;
        _tests = (_tests.Faces + faces, _tests.Bounds + bounds);
        var islands = PlannerOf(StepperOf(world)).Islands;
        _pairs += islands.Graph.Pairs.Length + (1000L * islands.Graph.Sets.JoinedCount);
        for (var i = 0; i < islands.All.Count; i++)
        {
            var island = islands.All[i];
            _islands += (i + 1) * (island.RowCount + (3 * island.BodyCount) + (7 * island.PartCount)
                + Bits(island.IsFree, island.HasMovingSurface, island.HasCompound));
            foreach (ref readonly var row in islands.RowsOf(in island))
            {
                _forces.Add(row.NormalImpulse);
                _forces.Add(row.FrictionImpulse);
                _forces.Add(row.TurnImpulse);
            }
        }

        foreach (var body in world.Bodies)
        {
            _bodies += (body.Index + 1) * (body.FaceTests + (2 * body.BoundTests) + (3 * body.Contacts.Count)
                + (5 * body.NearSurfaces.Count) + (7 * body.SleepCount)
                + Bits(body.IsAsleep, body.IsStuck, body.IsIdle, body.MayTouchBodies, body.HasHeapMargin, body.IsTouching));
            _forces.Add(body.SleepTimer);
        }

        foreach (var one in world.ContactEvents)
        {
            _eventCount += 1000 + Identify(one);
            _events.Add(one.Point);
            _events.Add(one.Normal);
            _events.Add(one.Impulse);
        }
    }

    /// <summary>Writes the state of the bodies now, and the work until now.</summary>
    public string Line()
    {
        var (places, velocities, turns, spins) = (new Total(), new Total(), new Total(), new Total());
        foreach (var body in world.Bodies)
        {
            places.Add(body.Position);
            places.Add(body.Scale);
            velocities.Add(body.Velocity);
            turns.Add(body.Orientation.Cosine);
            turns.Add(body.Orientation.Axis);
            spins.Add(body.AngularVelocity);
            for (var i = 0; i < body.Contacts.Count; i++)
            {
                _forces.Add(body.Contacts[i].Gap(body.Position));
                _forces.Add(body.Contacts[i].Normal(body.Position));
            }
        }

        foreach (var target in world.StaticObjects)
        {
            places.Add(target.InterpolatedMap(0.4).Translation);
            velocities.Add(target.Velocity);
        }

        if (world.Character is { } character)
        {
            places.Add(character.Position);
            velocities.Add(character.Velocity);
            turns.Add(character.CarriedAngle);
            _bodies += Bits(character.IsGrounded);
        }

        var (solves, rounds, unconverged) = world.IslandStatistics;
        return string.Create(
            CultureInfo.InvariantCulture,
            $"{name} {world.StepCount}: at {places} by {velocities} turned {turns} spin {spins} force {_forces} events {_eventCount} "
            + $"{_events} tests {_tests.Faces} {_tests.Bounds} solves {solves} {rounds} {unconverged} islands {_islands} pairs {_pairs} "
            + $"returns {MoverOf(StepperOf(world)).ReturnCount} bodies {_bodies} asleep {world.Bodies.Count(static body => body.IsAsleep)} "
            + $"{world.IsMoving}");
    }

    /// <summary>Number of faces and bounds that have been tested since the world was made, those of queries included.</summary>
    public static (long Faces, long Bounds) CountTests(PhysicsWorld world) => CountTests(StepperOf(world));

    private static int Identify(in ContactEvent one) =>
        ((int)one.Phase * 7) + (one.Body.Index * 3) + ((one.OtherBody?.Index ?? -1) * 5) + ((one.StaticObject?.Index ?? -1) * 11);

    private static int Bits(params ReadOnlySpan<bool> flags)
    {
        var bits = 0;
        foreach (var flag in flags)
        {
            bits = (2 * bits) + (flag ? 1 : 0);
        }

        return bits;
    }

    [UnsafeAccessor(UnsafeAccessorKind.Method, Name = "CountTests")]
    private static extern (long Faces, long Bounds) CountTests(WorldStepper stepper);

    [UnsafeAccessor(UnsafeAccessorKind.Field, Name = "_stepper")]
    private static extern ref WorldStepper StepperOf(PhysicsWorld world);

    [UnsafeAccessor(UnsafeAccessorKind.Field, Name = "_planner")]
    private static extern ref IslandPlanner PlannerOf(WorldStepper stepper);

    [UnsafeAccessor(UnsafeAccessorKind.Field, Name = "_islandMover")]
    private static extern ref IslandMover MoverOf(WorldStepper stepper);

    /// <summary>
    /// A sum in which each number has another weight between 1 and 2, so that none can stand for another. It begins at 1: a tolerance is
    /// relative to that where all is at rest but for rounding.
    /// </summary>
    private sealed class Total
    {
        private double _sum = 1;
        private int _count;

        public void Add(double number)
        {
            _count++;
            var weight = _count * GoldenFraction;
            _sum += (1 + weight - Math.Floor(weight)) * number;
        }

        public void Add(Vector vector)
        {
            Add(vector.X);
            Add(vector.Y);
            Add(vector.Z);
        }

        public override string ToString() => RecordedText.Text(_sum);
    }
}
