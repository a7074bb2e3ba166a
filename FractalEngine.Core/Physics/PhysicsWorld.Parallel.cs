using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Physics.Stepping;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics;

/// <content>What many balls do at the same time, on all threads. Compounds and what has filters act one after the other.</content>
public sealed partial class PhysicsWorld
{
    // Less is done as soon by one thread.
    private const int BodiesPerJob = 1024;

    private readonly ParallelSteppers _parallel;
    private readonly Action<int> _beginPart;
    private readonly Action<BodyStepper, int> _prepare;
    private readonly Action<BodyStepper, int> _findNearSurfaces;
    private readonly Action<BodyStepper, int> _movePlanned;
    private readonly Action<BodyStepper, int> _finishPlanned;
    private StaticColliders? _sharedColliders;
    private CharacterController? _sharedCharacter;
    private Island _sharedIsland;
    private double _sharedSeconds;
    private bool _isFirstPart;
    private bool _hasStepForces;

    // True once there is a compound, or a body with another collider than the first one.
    private bool _areMixed;

    // Threads set it in any order, to the same.
    private volatile bool _hasOthers;
    private int _awakeCount;
    private bool _wasAtRest;

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
        if (_kinematics.Objects.Count > 0 || _nearbyBodies.HasFilters || _statics.HasFilters)
        {
            return false;
        }

        _sharedColliders = CollidersOf(_bodies[0]);
        _sharedCharacter = character;
        _sharedSeconds = seconds;
        return true;
    }

    private bool MayShare(Body body) =>
        !_areMixed || (!body.IsCompound && ColliderKindOf(body) == ColliderKindOf(_bodies[0]));

    /// <summary>Lets all bodies begin a part of a step.</summary>
    private void BeginPartShared()
    {
        _awakeCount = 0;
        WorkerSet.Shared.Run((_bodies.Count + BodiesPerJob - 1) / BodiesPerJob, _parallel.MaxThreads, _beginPart);
        _islands.HasSleeping = _awakeCount < _bodies.Count;
    }

    private void BeginPart(int job)
    {
        var end = Math.Min(_bodies.Count, (job + 1) * BodiesPerJob);
        var awakeCount = 0;
        for (var i = job * BodiesPerJob; i < end; i++)
        {
            var body = _bodies[i];
            if (body.IsIdle && _kinematics.Objects.Count == 0)
            {
                continue;
            }

            if (_isFirstPart)
            {
                body.BeginStep();
                body.IsIdle = body.IsAsleep;
            }

            body.BeginPart();
            awakeCount += body.IsAsleep ? 0 : 1;
        }

        _ = Interlocked.Add(ref _awakeCount, awakeCount);
    }

    /// <summary>Prepares the balls that are where they may be; all others may change what is around them.</summary>
    /// <returns>True where others are left.</returns>
    private bool PrepareShared(CharacterController? character, double seconds) =>
        !ParallelSteppers.AreMany(_awakeCount) || !TryBeginShared(character, seconds) || HasOthersAfter(_bodies.Count, _prepare);

    /// <summary>Finds the surfaces near balls of islands.</summary>
    /// <inheritdoc cref="PrepareShared"/>
    private bool FindNearSurfacesShared(double seconds) =>
        !ParallelSteppers.AreMany(_planner.Graph.JoinedCount) || !TryBeginShared(character: null, seconds)
            || HasOthersAfter(_bodies.Count, _findNearSurfaces);

    /// <summary>Moves the balls of an island along their planned ways.</summary>
    /// <returns>True where others are left.</returns>
    private bool MoveShared(in Island island, CharacterController? character, double seconds)
    {
        _sharedIsland = island;
        return !ParallelSteppers.AreMany(island.BodyCount) || !TryBeginShared(character, seconds)
            || HasOthersAfter(island.BodyCount, _movePlanned);
    }

    /// <summary>Ends the step of the balls of an island.</summary>
    /// <inheritdoc cref="PrepareShared"/>
    private bool FinishShared(in Island island, double seconds)
    {
        _sharedIsland = island;
        return !ParallelSteppers.AreMany(island.BodyCount) || !TryBeginShared(character: null, seconds)
            || HasOthersAfter(island.BodyCount, _finishPlanned);
    }

    private bool HasOthersAfter(int count, Action<BodyStepper, int> act)
    {
        _hasOthers = false;
        _parallel.Run(count, act);
        return _hasOthers;
    }

    private void Prepare(BodyStepper stepper, int index)
    {
        var body = _bodies[index];
        if (body.IsAsleep || body.IsPrepared)
        {
            return;
        }

        if (body.IsOverlapResolved && MayShare(body))
        {
            stepper.Prepare(body, _sharedColliders, _sharedCharacter, _gravity, _sharedSeconds);
        }
        else
        {
            _hasOthers = true;
        }
    }

    private void FindNearSurfaces(BodyStepper stepper, int index)
    {
        var body = _bodies[index];
        if (!_planner.Graph.IsJoined(index) || body.AreNearSurfacesKnown)
        {
            return;
        }

        if (MayShare(body))
        {
            body.AreNearSurfacesKnown = true;
            stepper.FindNearSurfaces(body, _sharedColliders, _planner.Graph.ReachOf(index), _sharedSeconds);
        }
        else
        {
            _hasOthers = true;
        }
    }

    private void MovePlanned(BodyStepper stepper, int place)
    {
        var body = _bodies[_planner.Graph.BodiesOf(in _sharedIsland)[place]];
        if (!MayShare(body))
        {
            _hasOthers = true;
            return;
        }

        body.IsMovedAhead = true;
        try
        {
            stepper.MovePlanned(body, _sharedColliders, _sharedCharacter, _sharedSeconds);
        }
        catch (ArgumentOutOfRangeException exception) when (exception.ActualValue is Vector)
        {
            throw CreateRangeException(body, exception);
        }
    }

    private void FinishPlanned(BodyStepper stepper, int place)
    {
        var body = _bodies[_planner.Graph.BodiesOf(in _sharedIsland)[place]];
        if (!MayShare(body))
        {
            _hasOthers = true;
            return;
        }

        stepper.FinishPlanned(body, _sharedColliders, _sharedSeconds, StepCount);
        if (!stepper.TryCommitPosition(body))
        {
            _hasOthers = true;
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
