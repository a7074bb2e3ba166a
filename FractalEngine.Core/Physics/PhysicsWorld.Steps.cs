using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;

namespace FractalEngine.Core.Physics;

/// <content>How time passes in the world.</content>
public sealed partial class PhysicsWorld
{
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
        var testsBefore = CountTests();
        var character = Character is { IsActive: true } active ? active : null;
        _kinematics.BeginStep(_clock.Time, seconds);
        character?.BeginStep();
        var parts = CountSubsteps(seconds);
        for (var part = 0; part < parts; part++)
        {
            _isFirstPart = part == 0;
            StepSubstep(character, part * seconds / parts, seconds / parts);
        }

        for (var i = 0; _hasStepForces && i < _bodies.Count; i++)
        {
            _bodies[i].StepForce = Vector.Zero;
            _bodies[i].StepTorque = Vector.Zero;
        }

        _hasStepForces = false;

        FinishEvents();
        _clock.Tick(seconds);
        var (faces, bounds) = CountTests();
        LastStepCost = (faces - testsBefore.Faces, bounds - testsBefore.Bounds);
    }

    /// <summary>Makes one of the parts of a step.</summary>
    private void StepSubstep(CharacterController? character, double elapsed, double seconds)
    {
        BeginPartShared();
        if (IsAtRest(character))
        {
            return;
        }

        _kinematics.BeginPart(_clock.Time + elapsed, seconds);
        WakeNearKinematics(seconds);
        PlanIslands(character, seconds);
        MoveIslands(character, seconds);
        for (var i = 0; _planner.Graph.IslandBodyCount < _bodies.Count && i < _bodies.Count; i++)
        {
            if (_bodies[i] is { IsAsleep: false, HasMoved: false, IslandIndex: < 0 })
            {
                StepBody(_bodies[i], character, seconds);
            }
        }

        for (var i = 0; _kinematics.Objects.Count > 0 && i < _bodies.Count; i++)
        {
            if (_bodies[i] is { KinematicPush: > 0, IsAsleep: false, IsOverlapResolved: true })
            {
                _stepper.PushOut(_bodies[i], CollidersOf(_bodies[i]), seconds);
            }
        }

        _planner.Graph.PutToSleep(Settings.TimeBeforeSleep);

        StepCharacter(character, seconds);
        _kinematics.EndPart();
    }

    /// <summary>True where nothing can happen in a step: all sleep, and did so in the last one, which had nothing to plan.</summary>
    private bool IsAtRest(CharacterController? character)
    {
        var isAtRest = _awakeCount == 0 && character is null && _kinematics.Objects.Count == 0;
        (isAtRest, _wasAtRest) = (isAtRest && _wasAtRest, isAtRest);
        return isAtRest;
    }

    /// <summary>Prepares all bodies that are awake, and solves their islands.</summary>
    private void PlanIslands(CharacterController? character, double seconds)
    {
        CollectTouching(character, seconds);
        _planner.Graph.JoinTouching();
        _planner.StopApproaches();
        _planner.Graph.JoinForStep();
        FindNearSurfaces(seconds);
        _planner.Plan(seconds);
    }

    /// <summary>Finds the surfaces that bodies of islands may meet, unless they are known.</summary>
    private void FindNearSurfaces(double seconds)
    {
        var hasOthers = _planner.Graph.JoinedCount > 0 && FindNearSurfacesShared(seconds);
        for (var i = 0; hasOthers && i < _bodies.Count; i++)
        {
            var body = _bodies[i];
            if (!body.AreNearSurfacesKnown && _planner.Graph.IsJoined(body.Index))
            {
                body.AreNearSurfacesKnown = true;
                var reach = _planner.Graph.ReachOf(body.Index);
                _stepper.FindNearSurfaces(body, CollidersOf(body), reach, seconds);
            }
        }
    }

    /// <summary>Finds which bodies touch each other, all of them prepared.</summary>
    private void CollectTouching(CharacterController? character, double seconds)
    {
        do
        {
            var hasOthers = PrepareShared(character, seconds);
            for (var i = 0; hasOthers && i < _bodies.Count; i++)
            {
                if (_bodies[i] is { IsAsleep: false, IsPrepared: false } body)
                {
                    _stepper.Prepare(body, CollidersOf(body), character, _gravity, seconds);
                }
            }
        }
        while (_planner.Graph.CollectTouching(_islands, seconds));
    }

    private void StepBody(Body body, CharacterController? character, double seconds)
    {
        if (!body.IsPrepared)
        {
            _stepper.Prepare(body, CollidersOf(body), character, _gravity, seconds);
        }

        body.HasMoved = true;
        MoveBody(body, character, seconds, isPlanned: false);
    }

    private void MoveBody(Body body, CharacterController? character, double seconds, bool isPlanned)
    {
        try
        {
            var colliders = CollidersOf(body);
            if (isPlanned)
            {
                _stepper.MovePlanned(body, colliders, character, seconds);
            }
            else
            {
                _stepper.Step(body, colliders, character, seconds, StepCount);
            }
        }
        catch (ArgumentOutOfRangeException exception) when (exception.ActualValue is Vector)
        {
            throw CreateRangeException(body, exception);
        }
    }

    private void StepCharacter(CharacterController? character, double seconds)
    {
        try
        {
            if (character is not null)
            {
                // The ground carries it first. Then it walks among objects where they are at the end of the step.
                _kinematics.Time = 0;
                character.Carry(seconds);
                _kinematics.Time = seconds;
                _kinematics.IsFrozen = true;
                character.Step(_statics.CollidersOf(CharacterColliderKind), _gravity, seconds);
            }
        }
        catch (ArgumentOutOfRangeException exception) when (exception.ActualValue is Vector)
        {
            throw new InvalidOperationException($"the character has left the range of a double in step {StepCount}", exception);
        }
        finally
        {
            _kinematics.IsFrozen = false;
        }

        if (character is not null && !(character.Position.IsFinite() && character.Velocity.IsFinite()))
        {
            throw new InvalidOperationException($"the character has left the range of a double in step {StepCount}");
        }
    }
}
