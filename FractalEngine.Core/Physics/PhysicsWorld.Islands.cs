using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Movement;

namespace FractalEngine.Core.Physics;

/// <content>How the bodies of islands move, which have been planned.</content>
public sealed partial class PhysicsWorld
{
    /// <summary>Moves the bodies of all islands at once.</summary>
    private void MoveIslands(CharacterController? character, double seconds)
    {
        var hasMovedAhead = MoveObstructing(character, seconds);
        foreach (var island in _planner.Graph.Islands)
        {
            MoveIsland(in island, character, seconds);
        }

        _islandMover.ReturnOverlapping(_planner.HasDeepOverlaps || hasMovedAhead);
        foreach (var island in _planner.Graph.Islands)
        {
            _energyGuard.FinishVelocities(in island);
            if (!island.IsFree)
            {
                _islandMover.DampJammed(in island, seconds);
            }

            FinishIsland(in island, seconds);
        }
    }

    /// <summary>Moves the bodies of an island to their targets, or as far as surfaces let them.</summary>
    private void MoveIsland(in Island island, CharacterController? character, double seconds)
    {
        if (!MoveShared(in island, character, seconds))
        {
            return;
        }

        foreach (var index in _planner.Graph.BodiesOf(in island))
        {
            var body = _bodies[index];
            if (!body.IsMovedAhead)
            {
                MoveBody(body, character, seconds, isPlanned: true);
            }

            body.IsMovedAhead = false;
        }
    }

    private void FinishIsland(in Island island, double seconds)
    {
        if (!FinishShared(in island, seconds))
        {
            return;
        }

        foreach (var index in _planner.Graph.BodiesOf(in island))
        {
            if (!_bodies[index].IsFinished)
            {
                _stepper.FinishPlanned(_bodies[index], CollidersOf(_bodies[index]), seconds, StepCount);
            }

            _stepper.CommitPosition(_bodies[index]);
        }
    }

    /// <summary>Moves bodies of no island first that stand where those of islands will be, such as what falls ahead of them.</summary>
    /// <returns>True where there are such.</returns>
    private bool MoveObstructing(CharacterController? character, double seconds)
    {
        var hasMoved = false;
        for (var pair = 0; _islandMover.FindObstructing(ref pair) is { } body; hasMoved = true)
        {
            if (!hasMoved)
            {
                AddStartEnergies(-1);
            }

            StepBody(body, character, seconds);
        }

        if (hasMoved)
        {
            AddStartEnergies(1);
        }

        return hasMoved;
    }

    /// <summary>Takes or gives the energies that bodies have: between both, what has moved ahead may push them.</summary>
    private void AddStartEnergies(double share)
    {
        foreach (var body in _bodies)
        {
            body.PlannedStartEnergy += share * body.KineticEnergy;
        }
    }
}
