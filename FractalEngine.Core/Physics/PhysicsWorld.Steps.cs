using System.Globalization;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <content>Steps, sleep and waking.</content>
public sealed partial class PhysicsWorld
{
    // Of the radii: what slept on a body touched it to some rounding.
    private const double TouchRadiusFactor = 1 + 1e-6;

    private static readonly Vector[] SingleSphereOffset = [Vector.Zero];

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

        _accumulatedTime = Math.Min(_accumulatedTime + Math.Max(0, seconds), Settings.MaxStepsPerAdvance * Settings.TimeStep);
        var steps = 0;
        for (; _accumulatedTime >= Settings.TimeStep; steps++)
        {
            _accumulatedTime -= Settings.TimeStep;
            Step();
        }

        return steps;
    }

    /// <summary>Makes one step.</summary>
    /// <exception cref="InvalidOperationException">A body has left the range of a double; the message names it.</exception>
    public void Step()
    {
        var (faceTestsBefore, boundTestsBefore) = (_queryContext.FaceTests, _queryContext.BoundTests);
        for (var i = 0; i < _bodies.Count; i++)
        {
            var body = _bodies[i];
            (body.PreviousPosition, body.PreviousScale, body.FaceTests, body.BoundTests) = (body.Position, body.Scale, 0, 0);
            if (!body.IsAsleep)
            {
                Step(body);
            }
        }

        if (Character is { IsActive: true } character)
        {
            character.Step(Settings.TimeStep);
        }

        StepCount++;
        LastStepCost = (_queryContext.FaceTests - faceTestsBefore, _queryContext.BoundTests - boundTestsBefore);
    }

    /// <summary>Ends the sleep of a body and of all that touch it.</summary>
    internal void WakeIsland(Body body)
    {
        body.Wake();
        _wakeStack.Push(body);
        while (_wakeStack.TryPop(out var next))
        {
            _wakeNeighbours.Clear();
            _grid.CollectOverlaps(new(next.Position, next.Position), next.Radius * TouchRadiusFactor, next.Index, _wakeNeighbours);
            foreach (var index in _wakeNeighbours)
            {
                if (_bodies[index].IsAsleep)
                {
                    _bodies[index].Wake();
                    _wakeStack.Push(_bodies[index]);
                }
            }
        }
    }

    private void Step(Body body)
    {
        var (faceTestsBefore, boundTestsBefore, step) = (_queryContext.FaceTests, _queryContext.BoundTests, Settings.TimeStep);
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

        var maxTravel = new Motion(body.Position, body.Velocity, acceleration).MaxTravelDistance(step);
        _obstacles.SetMover(GetStaticObjects(_colliderOverride ?? description.Collider), SingleSphereOffset, body.Radius, body.SafeDistance,
            2 * maxTravel, Character is { IsActive: true } ? Character : null);
        var accelerationMagnitude = acceleration.Length();
        _mover.Move(body, acceleration, step, Settings.RestitutionThreshold ?? 0.5 * accelerationMagnitude * step);
        if (!body.Position.IsFinite() || !body.Velocity.IsFinite())
        {
            throw new InvalidOperationException(string.Create(
                CultureInfo.InvariantCulture,
                $"body {body.Name} has left the range of a double in step {StepCount}: position {body.Position}, velocity {body.Velocity}"));
        }

        _grid.Update(body.Index);
        (body.FaceTests, body.BoundTests) = (_queryContext.FaceTests - faceTestsBefore, _queryContext.BoundTests - boundTestsBefore);
        UpdateSleep(body, Settings.SleepSpeed ?? 0.02 * Math.Sqrt(accelerationMagnitude * body.Radius));
    }

    /// <summary>Bodies that barely move fall asleep after a while.</summary>
    private void UpdateSleep(Body body, double sleepSpeed)
    {
        // By how far it gets: what is jammed may be pushed about and go nowhere.
        var maxDistance = sleepSpeed * Settings.TimeStep;
        var isSlow = (body.Position - body.PreviousPosition).LengthSquared() < maxDistance * maxDistance && body.Contacts.Count > 0;
        var isResting = sleepSpeed > 0 && !body.IsShrinking && (isSlow || body.IsStuck);
        body.SleepTimer = isResting ? body.SleepTimer + Settings.TimeStep : 0;
        if (body.SleepTimer >= Settings.TimeBeforeSleep && isResting)
        {
            (body.IsAsleep, body.Velocity, body.NetAcceleration) = (true, Vector.Zero, Vector.Zero);
        }
        else if (!isResting)
        {
            // What slept on it may have nothing under it any more.
            WakeTouchingBodies(body);
        }
    }

    private void WakeTouchingBodies(Body body) =>
        WakeOverlapping(body.PreviousPosition, body.PreviousScale * body.Description.Radius, body.Index);

    /// <summary>Wakes what touched a ball.</summary>
    internal void WakeOverlapping(Vector centre, double radius, int excludedIndex = -1)
    {
        _wakeCandidates.Clear();
        _grid.CollectOverlaps(new(centre, centre), radius * TouchRadiusFactor, excludedIndex, _wakeCandidates);
        foreach (var index in _wakeCandidates)
        {
            if (_bodies[index].IsAsleep)
            {
                WakeIsland(_bodies[index]);
            }
        }
    }
}
