using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Benchmarks.Physics;

/// <summary>
/// What do objects that move by themselves do to balls: how many does a plate pass, which gap is over a lift that descends, which speed
/// does a belt give? All worlds step 60 times a second.
/// </summary>
/// <param name="output">Receives the rows as text.</param>
/// <param name="table">Receives the rows too, unless it is null.</param>
internal sealed class MoverTable(TextWriter output, CsvTable? table)
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns = ["mover", "speed", "balls", "steps", "quantity", "value", "cpu_ms_a_step", "state"];

    private const double Radius = 0.5;
    private const int Side = 5;

    // So much that no ball gets round the plate.
    private const double Width = 2000;
    private const int Steps = 120;

    /// <summary>Writes the rows of all movers.</summary>
    public void Write()
    {
        output.WriteLine("mover    speed   balls   steps   quantity                    value   cpu ms a step");
        foreach (var speed in (double[])[5, 20, 200])
        {
            WritePlate(speed);
        }

        WriteLift(-1);
        WriteLift(2);
        WriteBelt(2);
        output.Flush();
    }

    private void WritePlate(double speed)
    {
        const double Thickness = 0.1;
        var world = CreateFloor(8000);
        world.AddRange(from i in Enumerable.Range(0, Side)
                       from j in Enumerable.Range(0, Side)
                       select new BodyDescription(new(1.02 * i, Radius, 1.02 * (j - (Side / 2))), Radius) { Friction = 0.3 });
        var plate = world.AddStatic(Shapes.Box(new(new(-3, 0.05, -Width), new(-3 + Thickness, Width, Width))));
        plate.SetMotion(speed * Vector.I);
        Write("plate", speed, world, "balls passed", () => world.Bodies.Count(
            body => body.Position.X < plate.Placement.Position.X - 3 + (0.5 * Thickness)));
    }

    private void WriteLift(double speed)
    {
        var world = new PhysicsWorld();
        var lift = world.AddStatic(Shapes.Box(new(new(-2, -1, -2), new(2, 0, 2))));
        world.Add(new(new(0, Radius, 0), Radius) { Friction = 0.5 });
        lift.SetMotion(speed * Vector.J);
        // What lies on it falls after it first, where it begins to descend.
        var gap = 0.0;
        Write("lift", speed, world, "largest gap", () => gap, () =>
            gap = world.StepCount <= Steps ? 0 : Math.Max(gap, Math.Abs(world.Bodies[0].Position.Y - Radius - lift.Placement.Position.Y)));
    }

    private void WriteBelt(double speed)
    {
        var world = CreateFloor(100);
        world.StaticObjects[0].SetBelt(speed * Vector.I);
        world.Add(new(new(0, Radius, 0), Radius) { Friction = 0.5, RollingFriction = 0.1 });
        Write("belt", speed, world, "speed of the ball", () => world.Bodies[0].Velocity.X);
    }

    private static PhysicsWorld CreateFloor(double length)
    {
        var world = new PhysicsWorld();
        world.AddStatic(Shapes.Box(new(new(-length, -1, -Width), new(length, 0, Width))));
        return world;
    }

    private void Write(
        string mover, double speed, PhysicsWorld world, string quantity, Func<double> measure, Action? afterStep = null)
    {
        var start = Environment.CpuUsage.UserTime;
        for (var step = 0; step < 2 * Steps; step++)
        {
            world.Step();
            afterStep?.Invoke();
        }

        var milliseconds = (Environment.CpuUsage.UserTime - start).TotalMilliseconds / (2 * Steps);
        var value = measure();
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"{mover,-6} {speed,7} {world.Bodies.Count,7} {2 * Steps,7}   {quantity,-18} {value,14:G6} {milliseconds,15:F3}"));
        table?.Add(mover, speed, world.Bodies.Count, 2 * Steps, quantity, value, Math.Round(milliseconds, 3), world.StateHash);
    }
}
