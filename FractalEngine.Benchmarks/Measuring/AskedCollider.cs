using System.Diagnostics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// A collider and the positions that it is asked for, without a limit of distance. Positions are timed in runs of about a fifth of a
/// millisecond, each with the best time of all rounds: a run is short enough to be left alone by a busy machine at least once.
/// </summary>
internal sealed class AskedCollider
{
    private readonly QueryContext _record = new();
    private readonly Collider _collider;
    private readonly Vector[] _positions;
    private readonly int _run;
    private readonly double[] _best;

    /// <summary>Asks all positions once, for the counts.</summary>
    /// <param name="collider">Built.</param>
    /// <param name="positions">Not empty.</param>
    public AskedCollider(Collider collider, Vector[] positions)
    {
        (_collider, _positions, _run, _best) = (collider, positions, positions.Length, [0]);
        Ask();
        (FaceTests, BoundTests) = ((double)_record.FaceTests / positions.Length, (double)_record.BoundTests / positions.Length);
        // About what a face and a bound take, in nanoseconds: enough to choose the length of a run.
        _run = (int)Math.Clamp(200_000 / ((20 * FaceTests) + (5 * BoundTests) + 100), 1, 64);
        _best = [.. Enumerable.Repeat(double.PositiveInfinity, (positions.Length + _run - 1) / _run)];
    }

    /// <summary>Mean of a query.</summary>
    public double FaceTests { get; }

    /// <summary>Mean of a query.</summary>
    public double BoundTests { get; }

    /// <summary>What the collider keeps.</summary>
    public long Bytes => _collider.StorageBytes;

    /// <summary>Microseconds a query, to a tenth of a nanosecond; after at least one more round.</summary>
    public double Microseconds => Math.Round(1e6 * _best.Sum() / _positions.Length, 4);

    /// <summary>Asks all positions: a round.</summary>
    public void Ask()
    {
        for (var run = 0; run < _best.Length; run++)
        {
            var start = Stopwatch.GetTimestamp();
            foreach (var position in _positions.AsSpan(run * _run, Math.Min(_run, _positions.Length - (run * _run))))
            {
                _collider.TryFindClosest(position, double.PositiveInfinity, _record, out _);
            }

            _best[run] = Math.Min(_best[run], Stopwatch.GetElapsedTime(start).TotalSeconds);
        }
    }
}
