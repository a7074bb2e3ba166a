using System.Diagnostics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// A collider and the positions that it is asked for, without a limit of distance. Positions are timed in runs of about a fifth of a
/// millisecond, each with the best time of all rounds: a run is short enough to be left alone by a busy machine at least once.
/// </summary>
internal sealed class ColliderWorkload
{
    private readonly QueryContext _context = new();
    private readonly Collider _collider;
    private readonly Vector[] _positions;
    private readonly int _runLength;
    private readonly double[] _bestSeconds;

    /// <summary>Asks all positions once, for the counts.</summary>
    /// <param name="collider">Built.</param>
    /// <param name="positions">Not empty.</param>
    public ColliderWorkload(Collider collider, Vector[] positions)
    {
        (_collider, _positions, _runLength, _bestSeconds) = (collider, positions, positions.Length, [0]);
        RunQueries();
        (FaceTests, BoundTests) = ((double)_context.FaceTests / positions.Length, (double)_context.BoundTests / positions.Length);
        // About what a face and a bound take, in nanoseconds: enough to choose the length of a run.
        _runLength = (int)Math.Clamp(200_000 / ((20 * FaceTests) + (5 * BoundTests) + 100), 1, 64);
        _bestSeconds = [.. Enumerable.Repeat(double.PositiveInfinity, (positions.Length + _runLength - 1) / _runLength)];
    }

    /// <summary>Mean of a query.</summary>
    public double FaceTests { get; }

    /// <summary>Mean of a query.</summary>
    public double BoundTests { get; }

    /// <summary>What the collider keeps.</summary>
    public long StorageBytes => _collider.StorageBytes;

    /// <summary>Microseconds a query, to a tenth of a nanosecond; after at least one more round.</summary>
    public double MicrosecondsPerQuery => Math.Round(1e6 * _bestSeconds.Sum() / _positions.Length, 4);

    /// <summary>Asks all positions: a round.</summary>
    public void RunQueries()
    {
        for (var run = 0; run < _bestSeconds.Length; run++)
        {
            var start = Stopwatch.GetTimestamp();
            foreach (var position in _positions.AsSpan(run * _runLength, Math.Min(_runLength, _positions.Length - (run * _runLength))))
            {
                _collider.TryFindClosest(position, double.PositiveInfinity, _context, out _);
            }

            _bestSeconds[run] = Math.Min(_bestSeconds[run], Stopwatch.GetElapsedTime(start).TotalSeconds);
        }
    }
}
