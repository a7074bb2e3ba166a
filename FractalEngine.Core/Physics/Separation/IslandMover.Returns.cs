using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Separation;

/// <content>How bodies return to where their step began, which overlap others.</content>
internal sealed partial class IslandMover
{
    // Relative to the smaller radius: overlaps for which bodies return.
    private const double MaxOverlap = 9e-7;

    private const int PairsPerJob = 1024;

    private Place[] _places = [];
    private int _bodiesPerCellJob;
    private volatile bool _hasOverlap;

    /// <summary>Puts an island back to where its step began, unless others have come there.</summary>
    public bool TryReturn(in Island island)
    {
        var members = _graph.BodiesOf(in island);
        foreach (var index in members)
        {
            _bodies[index].CheckedTarget = _bodies[index].Position;
            _bodies[index].MovedOrientation = _bodies[index].Orientation;
            PutBack(_bodies[index]);
        }

        var isFree = true;
        foreach (var index in members)
        {
            isFree &= !OverlapsOthers(_bodies[index]);
        }

        foreach (var index in isFree ? [] : members)
        {
            _bodies[index].Position = _bodies[index].CheckedTarget;
            _bodies[index].SetOrientation(_bodies[index].MovedOrientation);
            _grid.Update(index);
        }

        return isFree;
    }

    /// <summary>True where a body overlaps one that is not of its island.</summary>
    private bool OverlapsOthers(Body body)
    {
        _neighbours.Clear();
        _nearbyBodies.CollectOverlaps(body.Position, body.Radius * (1 - MaxOverlap), body.Index, _neighbours);
        foreach (var neighbour in _neighbours)
        {
            if (_bodies[neighbour].IslandIndex != body.IslandIndex && BallPairs.AreOverlapping(body, _bodies[neighbour], MaxOverlap))
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>
    /// Puts bodies back to where they were that now overlap others, after those of all islands have moved. What returns may overlap
    /// others in turn, which return as well; where all began, none overlapped.
    /// </summary>
    public void ReturnOverlapping()
    {
        if (_graph.Islands.Count == 0)
        {
            return;
        }

        UpdateCells();
        while (ReturnPairs() || ReturnBeyondReach())
        {
        }
    }

    /// <summary>Tells the grid where bodies are: on all threads for those that stay in their cell, and then for all others.</summary>
    private void UpdateCells()
    {
        _bodiesPerCellJob = Math.Max(BodiesPerJob, (_bodies.Count + MaxCellJobs - 1) / MaxCellJobs);
        var jobCount = (_bodies.Count + _bodiesPerCellJob - 1) / _bodiesPerCellJob;
        WorkerSet.Shared.Run(jobCount, _maxThreads, _updateCells);
        foreach (var left in _leftCells.AsSpan(0, jobCount))
        {
            foreach (var index in left)
            {
                _grid.Update(index);
            }
        }
    }

    private void UpdateCells(int job)
    {
        _leftCells[job].Clear();
        var end = Math.Min(_bodies.Count, (job + 1) * _bodiesPerCellJob);
        for (var i = job * _bodiesPerCellJob; i < end; i++)
        {
            var body = _bodies[i];
            _places[i] = new(body.Position, body.IsCompound ? double.NaN : body.Radius);
            if (body.IslandIndex >= 0 && !_grid.TryUpdateWithinCell(i))
            {
                _leftCells[job].Add(i);
            }
        }
    }

    private bool ReturnPairs()
    {
        _hasOverlap = false;
        WorkerSet.Shared.Run((_graph.Pairs.Length + PairsPerJob - 1) / PairsPerJob, _maxThreads, _testPairs);
        if (!_hasOverlap)
        {
            return false;
        }

        var hasReturned = false;
        foreach (ref readonly var pair in _graph.Pairs)
        {
            var first = _bodies[pair.First];
            var second = _bodies[pair.Second];
            if (BallPairs.AreOverlapping(first, second, MaxOverlap))
            {
                hasReturned |= Return(first);
                hasReturned |= Return(second);
            }
        }

        return hasReturned;
    }

    /// <summary>Tells whether one of a group of pairs overlaps, as hardly ever happens.</summary>
    private void TestPairs(int job)
    {
        var pairs = _graph.Pairs;
        foreach (ref readonly var pair in pairs[(job * PairsPerJob)..Math.Min(pairs.Length, (job + 1) * PairsPerJob)])
        {
            // For compounds, it is not known before their balls are compared.
            if (!AreApart(in _places[pair.First], in _places[pair.Second])
                && BallPairs.AreOverlapping(_bodies[pair.First], _bodies[pair.Second], MaxOverlap))
            {
                _hasOverlap = true;
                return;
            }
        }
    }

    private static bool AreApart(in Place first, in Place second)
    {
        var minDistance = first.Radius + second.Radius - (MaxOverlap * Math.Min(first.Radius, second.Radius));
        return (first.Position - second.Position).LengthSquared() >= minDistance * minDistance;
    }

    /// <summary>Puts bodies back that have got farther than any pair foresees and overlap any other, and that one with them.</summary>
    private bool ReturnBeyondReach()
    {
        var hasReturned = false;
        foreach (var island in _graph.Islands)
        {
            foreach (var index in _graph.BodiesOf(in island))
            {
                if (_graph.IsBeyondReach(_bodies[index]))
                {
                    hasReturned |= ReturnAmongAll(_bodies[index]);
                }
            }
        }

        return hasReturned;
    }

    private bool ReturnAmongAll(Body body)
    {
        _neighbours.Clear();
        _nearbyBodies.CollectOverlaps(
            body.Position, body.Radius * (1 - MaxOverlap), body.Index, _neighbours);
        var hasReturned = false;
        foreach (var neighbour in _neighbours)
        {
            if (BallPairs.AreOverlapping(body, _bodies[neighbour], MaxOverlap))
            {
                hasReturned |= Return(body);
                hasReturned |= Return(_bodies[neighbour]);
            }
        }

        return hasReturned;
    }

    private bool Return(Body body)
    {
        if (body.IslandIndex < 0
            || (body.Position == body.PlannedStart && (!body.IsCompound || body.Orientation == body.PlannedStartOrientation)))
        {
            return false;
        }

        ReturnCount++;
        PutBack(body);
        return true;
    }

    private void PutBack(Body body)
    {
        body.Position = body.PlannedStart;
        _places[body.Index] = _places[body.Index] with { Position = body.Position };
        _grid.Update(body.Index);
        body.SetOrientation(body.PlannedStartOrientation);
    }

    /// <summary>Where a body is: pairs are compared without the bodies.</summary>
    /// <param name="Position">Its centre, world space.</param>
    /// <param name="Radius">Its radius; not a number for a compound.</param>
    private readonly record struct Place(Vector Position, double Radius);
}
