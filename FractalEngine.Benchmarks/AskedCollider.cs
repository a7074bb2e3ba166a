using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks;

/// <summary>A collider and the positions that it is asked for, without a limit of distance.</summary>
internal sealed class AskedCollider
{
    private readonly QueryRecord _record = new();
    private readonly Collider _collider;
    private readonly Vector[] _positions;

    /// <summary>Asks all positions once, for the counts.</summary>
    /// <param name="collider">Built.</param>
    /// <param name="positions">Not empty.</param>
    public AskedCollider(Collider collider, Vector[] positions)
    {
        (_collider, _positions) = (collider, positions);
        Ask();
        (FaceTests, BoundTests) = ((double)_record.FaceTests / positions.Length, (double)_record.BoundTests / positions.Length);
    }

    /// <summary>Mean of a query.</summary>
    public double FaceTests { get; }

    /// <summary>Mean of a query.</summary>
    public double BoundTests { get; }

    /// <summary>What the collider keeps.</summary>
    public long Bytes => _collider.StorageBytes;

    /// <summary>Microseconds a query, to a tenth of a nanosecond, where all take seconds.</summary>
    public double Microseconds(double seconds) => Math.Round(1e6 * seconds / _positions.Length, 4);

    /// <summary>Asks all positions.</summary>
    public void Ask()
    {
        foreach (var position in _positions)
        {
            _collider.TryFindClosest(position, double.PositiveInfinity, _record, out _);
        }
    }
}
