using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;

namespace FractalEngine.Benchmarks.Physics;

/// <summary>
/// What do objects that move let pass, how well do they carry, and what does a step cost? Each row is one kind of object at one speed. All
/// runs make the same steps, bit for bit.
/// </summary>
/// <param name="rounds">Number of rounds, the best of which counts.</param>
/// <param name="output">Receives the rows as text.</param>
/// <param name="table">Receives the rows too, unless it is null.</param>
internal sealed class MoverTable(int rounds, TextWriter output, CsvTable? table)
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
    [
        "mover", "speed", "balls", "steps", "balls_passed", "worst_overlap", "worst_gap", "mean_speed_of_balls", "cpu_ms_a_step_mean",
        "cpu_ms_a_step_worst", "state",
    ];

    private const double Radius = 0.5;
    private const double HalfThickness = 0.05;

    // Steps in which what is carried falls after a lift that starts at once, or gains the speed of a belt.
    private const int SettlingSteps = 300;
    private const int Steps = 120;

    /// <summary>Writes the rows of all kinds of objects.</summary>
    public void Write()
    {
        output.WriteLine("mover   speed   balls   passed   worst overlap   worst gap   mean speed   cpu ms a step   worst");
        foreach (var speed in (ReadOnlySpan<double>)[5, 20, 200])
        {
            Write("plate", speed, () => CreatePlate(speed));
        }

        Write("lift down", 1, () => CreateCarrier(new(0, -1, 0), Vector.Zero));
        Write("lift up", 2, () => CreateCarrier(new(0, 2, 0), Vector.Zero));
        Write("belt", 2, () => CreateCarrier(Vector.Zero, new(2, 0, 0)));
        output.Flush();
    }

    private static Case CreatePlate(double speed)
    {
        var world = new PhysicsWorld();
        AddBox(world, new(0, -0.5, 0), new(4000, 1, 40));
        var plate = AddBox(world, new(-3.3, 2.05, 0), new(2 * HalfThickness, 4, 24));
        world.AddRange(from i in Enumerable.Range(0, 10)
                       from j in Enumerable.Range(0, 20)
                       select new BodyDescription(new(1.02 * i, Radius, 1.02 * (j - 9.5)), Radius) { Friction = 0.3, Restitution = 0.2 });
        plate.SetMotion(new(speed, 0, 0));
        return new(world, body => body.Position.X - plate.Placement.Position.X - HalfThickness - Radius, 0, CanLeave: true);
    }

    private static Case CreateCarrier(Vector velocity, Vector belt)
    {
        var world = new PhysicsWorld();
        var floor = AddBox(world, new(0, -0.5, 0), new(400, 1, 400));
        world.AddRange(from i in Enumerable.Range(0, 15)
                       from j in Enumerable.Range(0, 15)
                       select new BodyDescription(new(1.2 * i, Radius, 1.2 * j), Radius) { Friction = 0.5, RollingFriction = 0.1 });
        floor.SetMotion(velocity);
        floor.SetBelt(belt);
        return new(world, body => body.Position.Y - floor.Placement.Position.Y - 0.5 - Radius, SettlingSteps, CanLeave: false);
    }

    private static StaticObject AddBox(PhysicsWorld world, Vector centre, Vector size) =>
        world.AddStatic(Shapes.Box(new(-0.5 * size, 0.5 * size)), new Transformation(centre, Vector.Zero, Vector.One));

    private void Write(string name, double speed, Func<Case> create)
    {
        var best = new double[Steps];
        Array.Fill(best, double.PositiveInfinity);
        var result = default(Result);
        string? stateHash = null;
        var count = 0;
        for (var round = 0; round < rounds; round++)
        {
            var mover = create();
            result = Run(mover, best);
            count = mover.World.Bodies.Count;
            stateHash ??= mover.World.StateHash;
            if (mover.World.StateHash != stateHash)
            {
                throw new InvalidOperationException("two rounds of the same steps differ");
            }
        }

        var text = $"{name,-10} {speed,4} {count,7} {result.Passed,8} {result.Overlap,15:E1} {result.Gap,11:E1} {result.Speed,12:F6}";
        WriteLine($"{text} {best.Average(),15:F3} {best.Max(),7:F3}");
        table?.Add(
            name, speed, count, Steps, result.Passed, result.Overlap, result.Gap, Math.Round(result.Speed, 9),
            Math.Round(best.Average(), 4), Math.Round(best.Max(), 4), stateHash);
    }

    private static Result Run(Case mover, double[] best)
    {
        var (world, leadOf, settlingSteps, canLeave) = mover;
        for (var step = 0; step < settlingSteps; step++)
        {
            world.Step();
        }

        var (passed, overlap, gap) = (0, 0.0, 0.0);
        for (var step = 0; step < Steps; step++)
        {
            var start = Environment.CpuUsage.UserTime;
            world.Step();
            best[step] = Math.Min(best[step], (Environment.CpuUsage.UserTime - start).TotalMilliseconds);
            passed = 0;
            foreach (var body in world.Bodies)
            {
                var lead = leadOf(body);
                passed += lead < -Radius ? 1 : 0;
                overlap = Math.Max(overlap, -lead);
                gap = canLeave ? 0 : Math.Max(gap, lead);
            }
        }

        return new(passed, overlap, gap, world.Bodies.Average(static body => body.Velocity.Length()));
    }

    private void WriteLine(FormattableString text) => output.WriteLine(text.ToString(CultureInfo.InvariantCulture));

    /// <summary>An object that moves, and the balls that it meets.</summary>
    /// <param name="World">Holds both.</param>
    /// <param name="LeadOf">How far a ball is in front of the object; negative where they overlap.</param>
    /// <param name="SettlingSteps">Steps before the first that counts.</param>
    /// <param name="CanLeave">True where balls may fly ahead of the object.</param>
    private sealed record Case(PhysicsWorld World, Func<Body, double> LeadOf, int SettlingSteps, bool CanLeave);

    /// <summary>What a run has come to.</summary>
    /// <param name="Passed">Balls whose centre is behind the face of the object at the end.</param>
    /// <param name="Overlap">Largest depth of any ball after any step, scene units.</param>
    /// <param name="Gap">Largest distance of any ball that is carried, scene units.</param>
    /// <param name="Speed">Mean speed of the balls at the end, units per second.</param>
    private readonly record struct Result(int Passed, double Overlap, double Gap, double Speed);
}
