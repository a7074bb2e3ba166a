using System.Globalization;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <content>Steps, sleep and waking.</content>
public sealed partial class PhysicsWorld
{
    // Of the radii: what slept on a body touched it to some rounding.
    private const double Touching = 1 + 1e-6;

    private static readonly Vector[] OneSphere = [Vector.Zero];

    /// <summary>Lets time pass: as many steps as fit.</summary>
    /// <param name="seconds">Since the last call.</param>
    /// <returns>How many steps were made.</returns>
    /// <exception cref="ArgumentException">The time is not finite.</exception>
    public int Advance(double seconds)
    {
        if (!double.IsFinite(seconds))
        {
            throw new ArgumentException("expected a finite time", nameof(seconds));
        }

        _pending = Math.Min(_pending + Math.Max(0, seconds), Settings.MostStepsAtOnce * Settings.Step);
        var steps = 0;
        for (; _pending >= Settings.Step; steps++)
        {
            _pending -= Settings.Step;
            Step();
        }

        return steps;
    }

    /// <summary>Makes one step.</summary>
    /// <exception cref="InvalidOperationException">A body has left the range of a double; the message names it.</exception>
    public void Step()
    {
        var (faceTests, boundTests) = (_record.FaceTests, _record.BoundTests);
        for (var i = 0; i < _bodies.Count; i++)
        {
            var body = _bodies[i];
            (body.PreviousPosition, body.PreviousScale, body.FaceTests, body.BoundTests) = (body.Position, body.Scale, 0, 0);
            if (!body.IsAsleep)
            {
                Step(body);
            }
        }

        if (Walker is { IsActive: true } walker)
        {
            walker.Step(Settings.Step);
        }

        StepCount++;
        Cost = (_record.FaceTests - faceTests, _record.BoundTests - boundTests);
    }

    /// <summary>Ends the sleep of a body and of all that touch it.</summary>
    internal void Wake(Body body)
    {
        body.Wake();
        _waking.Push(body);
        while (_waking.TryPop(out var next))
        {
            _touching.Clear();
            _grid.Collect(new(next.Position, next.Position), next.Radius * Touching, next.Index, _touching);
            foreach (var index in _touching)
            {
                if (_bodies[index].IsAsleep)
                {
                    _bodies[index].Wake();
                    _waking.Push(_bodies[index]);
                }
            }
        }
    }

    private void Step(Body body)
    {
        var (faceTests, boundTests, step) = (_record.FaceTests, _record.BoundTests, Settings.Step);
        var description = body.Description;
        if (body.IsShrinking)
        {
            body.Scale = Math.Max(description.MinimumScale, body.Scale - (description.Shrinkage * step));
        }

        var acceleration = Gravity + (body.Force / description.Mass);
        if (description.Damping > 0)
        {
            body.Velocity *= Math.Exp(-description.Damping * step);
        }

        var reach = new Motion(body.Position, body.Velocity, acceleration).LengthWithin(step);
        _obstacles.Begin(SurfacesOf(_collider ?? description.Collider), OneSphere, body.Radius, body.Clearance, 2 * reach, Walker is { IsActive: true } ? Walker : null);
        var size = acceleration.Length();
        _mover.Move(body, acceleration, step, Settings.RestSpeed ?? 0.5 * size * step);
        if (!body.Position.IsFinite() || !body.Velocity.IsFinite())
        {
            throw new InvalidOperationException(string.Create(
                CultureInfo.InvariantCulture, $"body {body.Name} has left the range of a double in step {StepCount}: position {body.Position}, velocity {body.Velocity}"));
        }

        _grid.Update(body.Index);
        (body.FaceTests, body.BoundTests) = (_record.FaceTests - faceTests, _record.BoundTests - boundTests);
        LetRest(body, Settings.SleepSpeed ?? 0.02 * Math.Sqrt(size * body.Radius));
    }

    /// <summary>Bodies that barely move fall asleep after a while.</summary>
    private void LetRest(Body body, double sleepSpeed)
    {
        // By how far it gets: what is jammed may be pushed about and go nowhere.
        var way = sleepSpeed * Settings.Step;
        var isSlow = (body.Position - body.PreviousPosition).LengthSquared() < way * way && body.Contacts.Count > 0;
        var rests = sleepSpeed > 0 && !body.IsShrinking && (isSlow || body.IsStuck);
        body.RestTime = rests ? body.RestTime + Settings.Step : 0;
        if (body.RestTime >= Settings.SleepTime && rests)
        {
            (body.IsAsleep, body.Velocity, body.FreeAcceleration) = (true, Vector.Zero, Vector.Zero);
        }
        else if (!rests)
        {
            // What slept on it may have nothing under it any more.
            WakeTouching(body);
        }
    }

    private void WakeTouching(Body body) => WakeAt(body.PreviousPosition, body.PreviousScale * body.Description.Radius, body.Index);

    /// <summary>Wakes what touched a ball.</summary>
    internal void WakeAt(Vector centre, double radius, int except = -1)
    {
        _left.Clear();
        _grid.Collect(new(centre, centre), radius * Touching, except, _left);
        foreach (var index in _left)
        {
            if (_bodies[index].IsAsleep)
            {
                Wake(_bodies[index]);
            }
        }
    }
}
