using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Physics.Solving;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Solving;

/// <summary>
/// Impulses of contacts, as the mechanics of rigid bodies says: of few, and of so many that they are solved as
/// balls.
/// </summary>
public sealed class ContactSolverTests
{
    private const int MaxRounds = 250;

    // Small islands converge to rounding of numbers about 1.
    private const double Rounding = 1e-12;

    // Kilograms and scene units.
    private const double Mass = 2;
    private const double Radius = 0.5;

    // The moment of inertia of a solid ball: 2/5·m·r².
    private const double Inertia = 0.4 * Mass * Radius * Radius;

    [Theory]
    [InlineData(1)]
    [InlineData(12)]
    public void Solve_OfTwoBallsThatMeet_LeavesThemTheVelocityOfTheirCentre(int count)
    {
        var solver = new ContactSolver(2 * count);
        var rows = new ContactRow[count];
        for (var i = 0; i < count; i++)
        {
            solver.Bodies[2 * i] = new() { Velocity = new(3, 1, 0), InverseMass = 1 / 2.0, InverseInertia = 5 };
            solver.Bodies[(2 * i) + 1] = new() { Velocity = new(-5, 2, 0), InverseMass = 1 / 6.0, InverseInertia = 2 };
            rows[i] = Row(2 * i, (2 * i) + 1, -Vector.I);
        }

        Solve(solver, rows);
        for (var i = 0; i < count; i++)
        {
            // (2·3 − 6·5)/8, and across nothing changes without friction.
            Near.Equal(new(-3, 1, 0), solver.Bodies[2 * i].Velocity, Rounding);
            Near.Equal(new(-3, 2, 0), solver.Bodies[(2 * i) + 1].Velocity, Rounding);
            Near.Equal(12, rows[i].NormalImpulse, Rounding);
            Assert.Equal((Vector.Zero, Vector.Zero), (solver.Bodies[2 * i].Spin, rows[i].FrictionImpulse));
        }
    }

    /// <summary>An impulse of exactly one, on one kilogram.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(12)]
    public void Solve_OfAUnitImpulse_StopsTheBall(int count)
    {
        var solver = new ContactSolver(count);
        var rows = new ContactRow[count];
        for (var i = 0; i < count; i++)
        {
            solver.Bodies[i] = new() { Velocity = -Vector.J, InverseMass = 1, InverseInertia = 1 };
            rows[i] = Row(i, ContactRow.Immovable, Vector.J);
        }

        Solve(solver, rows);
        for (var i = 0; i < count; i++)
        {
            Near.Equal(Vector.Zero, solver.Bodies[i].Velocity, Rounding);
            Near.Equal(1, rows[i].NormalImpulse, Rounding);
        }
    }

    [Theory]
    [InlineData(1)]
    [InlineData(12)]
    public void Solve_OfWhatSeparates_DoesNotPull(int count)
    {
        var solver = new ContactSolver(count);
        var rows = new ContactRow[count];
        for (var i = 0; i < count; i++)
        {
            solver.Bodies[i] = new() { Velocity = new(3, 0.5, 0), Spin = new(0, 0, 9), InverseMass = 1, InverseInertia = 1 };
            rows[i] = Row(i, ContactRow.Immovable, Vector.J) with { Friction = 1, RollingArm = 1, SpinningArm = 1 };
        }

        Solve(solver, rows);
        for (var i = 0; i < count; i++)
        {
            Assert.Equal((new(3, 0.5, 0), new(0, 0, 9)), (solver.Bodies[i].Velocity, solver.Bodies[i].Spin));
            Assert.Equal((0.0, Vector.Zero, Vector.Zero), (rows[i].NormalImpulse, rows[i].FrictionImpulse, rows[i].TurnImpulse));
        }
    }

    /// <summary>
    /// A ball that falls at an angle rolls on with 5/7 of its speed, or loses the friction times that of its
    /// fall.
    /// </summary>
    [Theory]
    [InlineData(1, 0.9, 5.0)]
    [InlineData(12, 0.9, 5.0)]
    [InlineData(1, 0.1, 6.6)]
    [InlineData(12, 0.1, 6.6)]
    [InlineData(1, 0, 7.0)]
    [InlineData(12, 0, 7.0)]
    public void Solve_OfABallThatFallsObliquely_RollsOrSlides(int count, double friction, double speed)
    {
        var solver = new ContactSolver(count);
        var rows = new ContactRow[count];
        for (var i = 0; i < count; i++)
        {
            solver.Bodies[i] = new() { Velocity = new(7, -4, 0), InverseMass = 1 / Mass, InverseInertia = 1 / Inertia };
            rows[i] = Row(i, ContactRow.Immovable, Vector.J) with { Friction = friction, FirstRadius = Radius };
        }

        Solve(solver, rows);
        for (var i = 0; i < count; i++)
        {
            Near.Equal(new(speed, 0, 0), solver.Bodies[i].Velocity, Rounding);
            // The impulse across acts at the radius.
            Near.Equal(new(0, 0, -Mass * (7 - speed) * Radius / Inertia), solver.Bodies[i].Spin, Rounding);
            Near.Equal(new(-Mass * (7 - speed), 0, 0), rows[i].FrictionImpulse, Rounding);
            Near.Equal(4 * Mass, rows[i].NormalImpulse, Rounding);
        }
    }

    /// <summary>
    /// Friction stops the slip of two balls that spin against each other: both points of contact are as fast.
    /// </summary>
    [Theory]
    [InlineData(1)]
    [InlineData(12)]
    public void Solve_OfTwoBallsThatSpin_StopsTheirSlip(int count)
    {
        var solver = new ContactSolver(2 * count);
        var rows = new ContactRow[count];
        for (var i = 0; i < count; i++)
        {
            solver.Bodies[2 * i] = new() { Velocity = new(0, -40, 0), Spin = new(3, 0, 2), InverseMass = 1, InverseInertia = 4 };
            solver.Bodies[(2 * i) + 1] = new() { Velocity = new(1, 40, -2), Spin = new(0, 1, 5), InverseMass = 0.5, InverseInertia = 1 };
            rows[i] = Row(2 * i, (2 * i) + 1, Vector.J) with { Friction = 1, FirstRadius = 0.5, SecondRadius = 0.25 };
        }

        Solve(solver, rows);
        for (var i = 0; i < count; i++)
        {
            var (first, second) = (solver.Bodies[2 * i], solver.Bodies[(2 * i) + 1]);
            var atFirst = first.Velocity + Vector.Cross(first.Spin, -0.5 * Vector.J);
            var atSecond = second.Velocity + Vector.Cross(second.Spin, 0.25 * Vector.J);
            Near.Equal(atFirst, atSecond, 1e-11);
            // Momentum, and the angular momentum about the point of contact, of masses 1 and 2.
            Near.Equal(new(2, 40, -4), first.Velocity + (2 * second.Velocity), 1e-11);
            Near.Equal(
                (new Vector(3, 0, 2) / 4) + Vector.Cross(0.5 * Vector.J, new(0, -40, 0)),
                (first.Spin / 4) + Vector.Cross(0.5 * Vector.J, first.Velocity), 1e-11);
            Near.Equal(
                new Vector(0, 1, 5) + (2 * Vector.Cross(-0.25 * Vector.J, new(1, 40, -2))),
                second.Spin + (2 * Vector.Cross(-0.25 * Vector.J, second.Velocity)), 1e-11);
        }
    }

    [Theory]
    [InlineData(1)]
    [InlineData(12)]
    public void Solve_OnASurfaceThatMoves_TakesTheBallAlong(int count)
    {
        var solver = new ContactSolver(count);
        var rows = new ContactRow[count];
        for (var i = 0; i < count; i++)
        {
            solver.Bodies[i] = new() { InverseMass = 1, InverseInertia = 0 };
            rows[i] = Row(i, ContactRow.Immovable, Vector.J) with { Friction = 0.5, FirstRadius = 1 };
            rows[i].SetSurface(new(i % 2 == 0 ? 9 : 0.25, 2, 0), Vector.Zero);
        }

        Solve(solver, rows);
        for (var i = 0; i < count; i++)
        {
            // Half of the impulse along the normal at most.
            Near.Equal(new(i % 2 == 0 ? 1 : 0.25, 2, 0), solver.Bodies[i].Velocity, Rounding);
        }
    }

    /// <summary>
    /// Torque against rolling and spinning is their arm times the impulse along the normal, or less where that
    /// stops it.
    /// </summary>
    [Theory]
    [InlineData(1, 0.01, 0.02)]
    [InlineData(12, 0.01, 0.02)]
    [InlineData(1, 0.02, 0)]
    [InlineData(12, 0.02, 0)]
    [InlineData(1, 0, 0.01)]
    [InlineData(12, 0, 0.01)]
    [InlineData(1, 9, 9)]
    [InlineData(12, 9, 9)]
    public void Solve_OfABallThatTurns_SlowsDownRollingAndSpinning(int count, double rollingArm, double spinningArm)
    {
        var solver = new ContactSolver(count);
        var rows = new ContactRow[count];
        for (var i = 0; i < count; i++)
        {
            solver.Bodies[i] =
                new() { Velocity = new(0, -4, 0), Spin = new(3, -5, 4), InverseMass = 1 / Mass, InverseInertia = 1 / Inertia };
            rows[i] = Row(i, ContactRow.Immovable, Vector.J) with { RollingArm = rollingArm, SpinningArm = spinningArm };
        }

        Solve(solver, rows);
        var rolling = Math.Min(5, 4 * Mass * rollingArm / Inertia);
        var spinning = Math.Min(5, 4 * Mass * spinningArm / Inertia);
        for (var i = 0; i < count; i++)
        {
            // Rolling is that about (3, 0, 4), with 5 radians per second.
            Near.Equal(new(3 - (0.6 * rolling), -5 + spinning, 4 - (0.8 * rolling)), solver.Bodies[i].Spin, 1e-11);
            Near.Equal(
                Inertia * new Vector(-0.6 * rolling, spinning, -0.8 * rolling), rows[i].TurnImpulse, 1e-11);
            Near.Equal(Vector.Zero, solver.Bodies[i].Velocity, Rounding);
        }
    }

    [Theory]
    [InlineData(1)]
    [InlineData(12)]
    public void Solve_OfTwoBallsThatRollOnEachOther_LeavesOneAngularVelocity(int count)
    {
        var solver = new ContactSolver(2 * count);
        var rows = new ContactRow[count];
        for (var i = 0; i < count; i++)
        {
            solver.Bodies[2 * i] = new() { Velocity = -40 * Vector.J, Spin = new(6, 0, 1), InverseMass = 1, InverseInertia = 1 };
            solver.Bodies[(2 * i) + 1] = new() { Velocity = 40 * Vector.J, Spin = new(0, -3, 1), InverseMass = 1, InverseInertia = 0.5 };
            rows[i] = Row(2 * i, (2 * i) + 1, Vector.J) with { RollingArm = 1, SpinningArm = 1 };
        }

        Solve(solver, rows);
        for (var i = 0; i < count; i++)
        {
            // Moments of inertia of 1 and 2.
            Near.Equal(new(2, -2, 1), solver.Bodies[2 * i].Spin, 1e-11);
            Near.Equal(new(2, -2, 1), solver.Bodies[(2 * i) + 1].Spin, 1e-11);
        }
    }

    /// <summary>One that runs into a row of others that touch: all go on together.</summary>
    [Theory]
    [InlineData(3)]
    [InlineData(12)]
    public void Solve_OfARowThatIsHit_LetsAllGoOnTogether(int count)
    {
        var solver = new ContactSolver(count);
        for (var i = 0; i < count; i++)
        {
            solver.Bodies[i] = new() { Velocity = i == 0 ? count * Vector.I : Vector.Zero, InverseMass = 1 };
        }

        ContactRow[] rows = [.. Enumerable.Range(0, count - 1).Select(static i => Row(i, i + 1, -Vector.I))];
        Solve(solver, rows);
        for (var i = 0; i < count; i++)
        {
            Near.Equal(Vector.I, solver.Bodies[i].Velocity, 1e-6);
        }

        for (var i = 0; i < rows.Length; i++)
        {
            // What is left to the others.
            Near.Equal(count - 1 - i, rows[i].NormalImpulse, 1e-5);
        }
    }

    [Fact]
    public void Solve_OfARow_TakesSeveralRounds()
    {
        var solver = new ContactSolver(4);
        for (var i = 0; i < 4; i++)
        {
            solver.Bodies[i] = new() { Velocity = i == 0 ? Vector.I : Vector.Zero, InverseMass = 1 };
        }

        ContactRow[] rows = [Row(0, 1, -Vector.I), Row(1, 2, -Vector.I), Row(2, 3, -Vector.I)];
        for (var i = 0; i < rows.Length; i++)
        {
            solver.ComputeMasses(ref rows[i]);
        }

        Assert.True(solver.Solve(rows));
        Assert.InRange(solver.Rounds, 2, MaxRounds - 1);
    }

    /// <summary>A dumbbell that falls flat onto a floor with one of its balls.</summary>
    [Fact]
    public void Solve_OfACompound_TurnsItAboutItsBall()
    {
        var solver = new ContactSolver(1);
        var shape = CompoundShape.OfBalls([new(-Vector.I, 0.5), new(Vector.I, 0.5)]);
        var body = new Body(new(Vector.Zero, shape) { Mass = 2, Velocity = -Vector.J }, 0);
        solver.Load(0, body);
        var row = Row(0, ContactRow.Immovable, Vector.J) with { FirstRadius = 0.5 };
        row.SetArms(-Vector.I, Vector.Zero);
        ContactRow[] rows = [row];
        Solve(solver, rows);
        // 1/m + a²/I with I = m·(2/5·r² + a²) = 2.2.
        var impulse = 1 / (0.5 + (1 / 2.2));
        Near.Equal(impulse, rows[0].NormalImpulse, Rounding);
        Near.Equal(new(0, -1 + (impulse / 2), 0), solver.Bodies[0].Velocity, Rounding);
        Near.Equal(new(0, 0, -impulse / 2.2), solver.Bodies[0].Spin, Rounding);
        Near.Equal(Vector.Zero, solver.RelativeVelocity(in rows[0]).Stretch(Vector.J), Rounding);
        Near.Equal(1 / (0.5 + (1 / 2.2)), rows[0].NormalMass, Rounding);
    }

    /// <summary>
    /// A compound and a ball that meet off its centre, with much friction: no slip is left, and momentum stays.
    /// </summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Solve_OfACompoundAndABall_KeepsMomentumAndStopsSlip(bool isCompoundFirst)
    {
        var solver = new ContactSolver(2);
        var shape = CompoundShape.OfBalls([new(-Vector.I, 0.5), new(Vector.I, 0.5)]);
        var compound = new Body(new(Vector.Zero, shape) { Mass = 2, AngularVelocity = new(1, 0, 0.5) }, 0);
        var ball = new Body(new(new(1, 0.75, 0), 0.25) { Velocity = new(0.5, -9, 1) }, 1);
        solver.Load(0, compound);
        solver.Load(1, ball);
        var row = isCompoundFirst
            ? Row(0, 1, -Vector.J) with { FirstRadius = 0.5, SecondRadius = 0.25, Friction = 9 }
            : Row(1, 0, Vector.J) with { FirstRadius = 0.25, SecondRadius = 0.5, Friction = 9 };
        row.SetArms(isCompoundFirst ? Vector.I : Vector.Zero, isCompoundFirst ? Vector.Zero : Vector.I);
        ContactRow[] rows = [row];
        Solve(solver, rows);
        // A millionth of the speed: rounds end where they change little.
        Near.Equal(Vector.Zero, solver.RelativeVelocity(in rows[0]).Stretch(Vector.J), 1e-6);
        Near.Equal(Vector.Zero, solver.Slip(in rows[0]), 1e-6);
        var (first, second) = (solver.Bodies[0], solver.Bodies[1]);
        Near.Equal(new(0.5, -9, 1), (2 * first.Velocity) + second.Velocity, 1e-12);
        // About the point of contact at (1, 0.5, 0) no body's angular momentum changes.
        Near.Equal(
            compound.InertiaTensor * new Vector(1, 0, 0.5),
            (compound.InertiaTensor * first.Spin) + (2 * Vector.Cross(new(-1, -0.5, 0), first.Velocity)), 1e-10);
        Near.Equal(
            Vector.Cross(new(0, 0.25, 0), new(0.5, -9, 1)),
            (second.Spin / ball.InverseInertia) + Vector.Cross(new(0, 0.25, 0), second.Velocity), 1e-10);
    }

    [Fact]
    public void ApplyTurn_OfTwoBodies_TurnsThemAgainstEachOther()
    {
        var solver = new ContactSolver(2);
        solver.Bodies[0] = new() { Spin = Vector.I, InverseInertia = 2 };
        solver.Bodies[1] = new() { Spin = Vector.J, InverseInertia = 4 };
        solver.ApplyTurn(new ContactRow { First = 1, Second = 0 }, new(1, 2, 3));
        Assert.Equal((new(-1, -4, -6), new(4, 9, 12)), (solver.Bodies[0].Spin, solver.Bodies[1].Spin));
        solver.ApplyTurn(new ContactRow { First = 0, Second = ContactRow.Immovable }, new(1, 2, 3));
        Assert.Equal((Vector.I, new(4, 9, 12)), (solver.Bodies[0].Spin, solver.Bodies[1].Spin));
    }

    private static ContactRow Row(int first, int second, Vector normal) =>
        new() { First = first, Second = second, Normal = normal, FirstRadius = 0.5, SecondRadius = second < 0 ? 0 : 0.5 };

    private static void Solve(ContactSolver solver, ContactRow[] rows)
    {
        for (var i = 0; i < rows.Length; i++)
        {
            solver.ComputeMasses(ref rows[i]);
        }

        Assert.True(solver.Solve(rows));
    }
}
