using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// A collider and the positions of its queries, which have no limit of distance. Positions are timed in runs of about a fifth of a
/// millisecond, each with the best time of all rounds. A run is so short that a busy machine leaves it alone at least once.
/// </summary>
internal sealed class ColliderWorkload
{
    private readonly QueryContext _context = new();
    private readonly Collider _collider;
    private readonly Vector[] _positions;
    private readonly TimeProvider _clock;
    private readonly int _runLength;
    private readonly double[] _bestSeconds;

    /// <summary>Runs all queries once, for the counts.</summary>
    /// <param name="collider">The collider that is measured.</param>
    /// <param name="positions">Positions of the queries, at least one.</param>
    /// <param name="clock">Clock that times the runs; the system's by default.</param>
    public ColliderWorkload(Collider collider, Vector[] positions, TimeProvider? clock = null)
    {
        _collider = collider;
        _positions = positions;
        _clock = clock ?? TimeProvider.System;
        foreach (var position in positions)
        {
            collider.TryFindClosest(position, double.PositiveInfinity, _context, out _);
        }

        FaceTests = (double)_context.Statistics.FaceTests / positions.Length;
        BoundTests = (double)_context.Statistics.BoundTests / positions.Length;
        // About the nanoseconds of a face and of a bound, which is good enough for the length of a run.
        _runLength = (int)Math.Clamp(200_000 / ((20 * FaceTests) + (5 * BoundTests) + 100), 1, 64);
        _bestSeconds = [.. Enumerable.Repeat(double.PositiveInfinity, (positions.Length + _runLength - 1) / _runLength)];
    }

    /// <summary>Mean number of face tests in a query.</summary>
    public double FaceTests { get; }

    /// <summary>Mean number of bound tests in a query.</summary>
    public double BoundTests { get; }

    /// <summary>Memory of the collider in bytes.</summary>
    public long StorageBytes => _collider.StorageBytes;

    /// <summary>Microseconds of a query, to a tenth of a nanosecond. Infinite before the first round.</summary>
    public double MicrosecondsPerQuery => Math.Round(1e6 * _bestSeconds.Sum() / _positions.Length, 4);

    /// <summary>Runs a round: the queries of all positions.</summary>
    public void RunQueries()
    {
        for (var run = 0; run < _bestSeconds.Length; run++)
        {
            var start = _clock.GetTimestamp();
            foreach (var position in _positions.AsSpan(run * _runLength, Math.Min(_runLength, _positions.Length - (run * _runLength))))
            {
                _collider.TryFindClosest(position, double.PositiveInfinity, _context, out _);
            }

            _bestSeconds[run] = Math.Min(_bestSeconds[run], _clock.GetElapsedTime(start).TotalSeconds);
        }
    }
}
