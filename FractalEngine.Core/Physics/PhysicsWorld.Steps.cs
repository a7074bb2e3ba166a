using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Physics.Character;

namespace FractalEngine.Core.Physics;

/// <content>How time passes in the world.</content>
public sealed partial class PhysicsWorld
{
    // Times that a body may try to follow its planned path, which others of its island bar until they have moved.
    private const int MaxPasses = 8;

    /// <summary>Makes as many steps of <see cref="PhysicsSettings.TimeStep"/> as fit into the time that has passed.</summary>
    /// <param name="seconds">Time since the last call; a negative one counts as 0. What does not fill a step is kept.</param>
    /// <returns>The number of steps.</returns>
    /// <exception cref="ArgumentException">The time is not finite.</exception>
    /// <exception cref="InvalidOperationException">A body has left the range of a double; the message names it.</exception>
    public int Advance(double seconds)
    {
        ArgumentCheck.Require(double.IsFinite(seconds), "expected a finite time", null, nameof(seconds));
        _accumulatedTime = Math.Min(_accumulatedTime + Math.Max(0, seconds), Settings.MaxStepsPerAdvance * Settings.TimeStep);
        var steps = 0;
        for (; _accumulatedTime >= Settings.TimeStep; steps++)
        {
            _accumulatedTime -= Settings.TimeStep;
            Step();
        }

        return steps;
    }

    /// <summary>Makes one step of <see cref="PhysicsSettings.TimeStep"/>.</summary>
    /// <exception cref="InvalidOperationException">A body has left the range of a double; the message names it.</exception>
    public void Step() => Step(Settings.TimeStep);

    /// <summary>
    /// Makes one step of any length. Steps may differ in length; default thresholds and sleep follow the length of each step.
    /// </summary>
    /// <param name="seconds">Length of the step, positive and finite.</param>
    /// <exception cref="ArgumentOutOfRangeException">The length is NaN, infinite, negative or zero.</exception>
    /// <exception cref="ColliderMismatchException">A collider that is built now does not fit an object.</exception>
    /// <exception cref="FractalLimitException">A fractal is too large for a collider that is built now.</exception>
    /// <exception cref="InvalidOperationException">A body has left the range of a double; the message names it.</exception>
    public void Step(double seconds)
    {
        ArgumentCheck.RequireTimeStep(seconds, nameof(seconds));
        var faceTestsBefore = _queryContext.Statistics.FaceTests;
        var boundTestsBefore = _queryContext.Statistics.BoundTests;
        var character = Character is { IsActive: true } active ? active : null;
        foreach (var body in _bodies)
        {
            body.BeginStep();
        }

        PlanIslands(character, seconds);
        MovePlanned(character, seconds);

        for (var i = 0; i < _bodies.Count; i++)
        {
            if (!_bodies[i].IsAsleep && _bodies[i].IslandIndex < 0)
            {
                StepBody(_bodies[i], character, seconds);
            }
        }

        _energyGuard.Check();
        _islands.PutToSleep(_planner.Graph, Settings.TimeBeforeSleep);

        StepCharacter(character, seconds);
        _clock.Tick(seconds);
        LastStepCost = (_queryContext.Statistics.FaceTests - faceTestsBefore, _queryContext.Statistics.BoundTests - boundTestsBefore);
    }

    /// <summary>Moves all bodies of islands; those that wait for others in a ring, several times.</summary>
    private void MovePlanned(CharacterController? character, double seconds)
    {
        foreach (var index in _planner.Order)
        {
            StepBody(_bodies[index], character, seconds);
        }

        var isWaiting = true;
        for (var pass = 1; pass < MaxPasses && isWaiting; pass++)
        {
            isWaiting = false;
            foreach (var index in _planner.Order)
            {
                if (_bodies[index].IsWaiting)
                {
                    StepBody(_bodies[index], character, seconds);
                    isWaiting |= _bodies[index].IsWaiting;
                }
            }
        }
    }

    /// <summary>Prepares all bodies that are awake, and solves their islands.</summary>
    private void PlanIslands(CharacterController? character, double seconds)
    {
        do
        {
            foreach (var body in _bodies)
            {
                if (!body.IsAsleep && !body.IsPrepared)
                {
                    _stepper.Prepare(body, _statics.CollidersOf(ColliderKindOf(body)), character, _gravity, seconds);
                }
            }
        }
        while (_planner.TryPlan(seconds));
    }

    private void StepBody(Body body, CharacterController? character, double seconds)
    {
        try
        {
            var colliders = _statics.CollidersOf(ColliderKindOf(body));
            if (!body.IsPrepared)
            {
                _stepper.Prepare(body, colliders, character, _gravity, seconds);
            }

            _stepper.Step(body, colliders, character, seconds, StepCount);
        }
        catch (ArgumentOutOfRangeException exception)
        {
            // A query of a position on its way that is none.
            throw new InvalidOperationException($"body {body.Name} has left the range of a double in step {StepCount}", exception);
        }
    }

    private void StepCharacter(CharacterController? character, double seconds)
    {
        try
        {
            character?.Step(seconds);
        }
        catch (ArgumentOutOfRangeException exception)
        {
            throw new InvalidOperationException($"the character has left the range of a double in step {StepCount}", exception);
        }

        if (character is not null && !(character.Position.IsFinite() && character.Velocity.IsFinite()))
        {
            throw new InvalidOperationException($"the character has left the range of a double in step {StepCount}");
        }
    }
}
