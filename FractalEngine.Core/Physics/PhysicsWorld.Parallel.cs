using FractalEngine.Core.Physics.Character;
using FractalEngine.Core.Physics.Islands;

namespace FractalEngine.Core.Physics;

/// <content>What many balls do at the same time, on all threads. Compounds and what has filters act one after the other.</content>
public sealed partial class PhysicsWorld
{
    private readonly ParallelSteppers _parallel;
    private readonly Action<BodyStepper, Body> _prepare;
    private readonly Action<BodyStepper, Body> _findNearSurfaces;
    private readonly Action<BodyStepper, Body> _movePlanned;
    private readonly Action<BodyStepper, Body> _finishPlanned;
    private StaticColliders? _sharedColliders;
    private CharacterController? _sharedCharacter;
    private double _sharedSeconds;

    private ParallelSteppers CreateParallelSteppers(int maxThreads) => new(
        context =>
        {
            var nearbyBodies = new NearbyBodies(_grid, _bodies);
            var obstacles = new Obstacles(_bodies, nearbyBodies, context, _kinematics);
            return new(Settings, _bodies, _grid, nearbyBodies, obstacles, _islands, _planner, context, _contactLog);
        },
        maxThreads);

    /// <summary>Tells whether balls may act at the same time: nothing moves by itself, and all see the same colliders.</summary>
    private bool TryBeginShared(CharacterController? character, double seconds)
    {
        if (!ParallelSteppers.AreMany(_bodies.Count) || _kinematics.Objects.Count > 0 || _nearbyBodies.HasFilters || _statics.HasFilters)
        {
            return false;
        }

        _sharedColliders = CollidersOf(_bodies[0]);
        _sharedCharacter = character;
        _sharedSeconds = seconds;
        return true;
    }

    private bool MayShare(Body body) => !body.IsCompound && ColliderKindOf(body) == ColliderKindOf(_bodies[0]);

    /// <summary>Prepares the balls that are where they may be; all others may change what is around them.</summary>
    private void PrepareShared(CharacterController? character, double seconds)
    {
        if (!TryBeginShared(character, seconds))
        {
            return;
        }

        foreach (var body in _bodies)
        {
            if (body is { IsAsleep: false, IsPrepared: false, IsOverlapResolved: true } && MayShare(body))
            {
                _parallel.Bodies.Add(body);
            }
        }

        _parallel.Run(_prepare);
    }

    private void FindNearSurfacesShared(double seconds)
    {
        if (!TryBeginShared(character: null, seconds))
        {
            return;
        }

        foreach (var body in _bodies)
        {
            if (!body.AreNearSurfacesKnown && _planner.Graph.IsJoined(body.Index) && MayShare(body))
            {
                body.AreNearSurfacesKnown = true;
                _parallel.Bodies.Add(body);
            }
        }

        _parallel.Run(_findNearSurfaces);
    }

    /// <summary>Moves the balls of an island along their planned ways.</summary>
    private void MoveShared(in Island island, int pass, CharacterController? character, double seconds)
    {
        if (!ParallelSteppers.AreMany(island.BodyCount) || !TryBeginShared(character, seconds))
        {
            return;
        }

        foreach (var index in _planner.Graph.BodiesOf(in island))
        {
            if (MustMove(_bodies[index], pass) && MayShare(_bodies[index]))
            {
                _parallel.Bodies.Add(_bodies[index]);
            }
        }

        _parallel.Run(_movePlanned);
    }

    /// <summary>Ends the step of the balls of an island.</summary>
    private void FinishShared(in Island island, double seconds)
    {
        if (!ParallelSteppers.AreMany(island.BodyCount) || !TryBeginShared(character: null, seconds))
        {
            return;
        }

        foreach (var index in _planner.Graph.BodiesOf(in island))
        {
            if (MayShare(_bodies[index]))
            {
                _parallel.Bodies.Add(_bodies[index]);
            }
        }

        _parallel.Run(_finishPlanned);
    }

    private static bool MustMove(Body body, int pass) => !body.IsHeld && (pass == 0 || body.Target != body.CheckedTarget);

    private void MovePlanned(BodyStepper stepper, Body body)
    {
        body.IsMovedAhead = true;
        try
        {
            stepper.MovePlanned(body, _sharedColliders, _sharedCharacter, _sharedSeconds);
        }
        catch (ArgumentOutOfRangeException exception)
        {
            throw CreateRangeException(body, exception);
        }
    }

    // A query of a position on its way that is none.
    private InvalidOperationException CreateRangeException(Body body, ArgumentOutOfRangeException exception) =>
        new($"body {body.Name} has left the range of a double in step {StepCount}", exception);

    private (long Faces, long Bounds) CountTests()
    {
        var (faces, bounds) = _parallel.CountTests();
        return (_queryContext.Statistics.FaceTests + faces, _queryContext.Statistics.BoundTests + bounds);
    }
}
