using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>The contacts of one part of an island that may overlap, and the displacements that take their overlaps back.</summary>
internal sealed class GapGroup
{
    // Squares of shorter offsets lose digits.
    private const double MinDistance = 1e-140;

    // Relative to the distance at which two touch: a shorter displacement makes no others overlap.
    private const double NegligibleShift = 0.1 * OverlapSeparator.NegligibleOverlap;

    private readonly GapQueue _queue = new();
    private SeparationGap[] _gaps = [];
    private int _count;

    /// <summary>True where a body has been displaced since this was last set.</summary>
    public bool HasMoved { get; set; }

    /// <summary>The contacts of the group.</summary>
    public ReadOnlySpan<SeparationGap> Gaps => _gaps.AsSpan(0, _count);

    /// <summary>Makes room for the bodies of a world, and for so many contacts of the group.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        if (_gaps.Length < contactCount)
        {
            Array.Resize(ref _gaps, contactCount);
        }

        _queue.Reserve(bodyCount, _gaps.Length);
    }

    /// <summary>Removes all contacts of the group.</summary>
    public void Clear() => _count = 0;

    /// <summary>Adds those contacts whose bodies are near touching.</summary>
    /// <param name="rows">Contacts.</param>
    /// <param name="movers">Bodies by their index.</param>
    /// <param name="aim">Tells what is near, and what separations aim at.</param>
    public void AddNear(ReadOnlySpan<ContactRow> rows, ReadOnlySpan<DisplacedBody> movers, in SeparationSettings aim)
    {
        foreach (ref readonly var row in rows)
        {
            var offset = row.Offset + movers[row.First].Displacement;
            offset -= row.Second >= 0 ? movers[row.Second].Displacement : Vector.Zero;
            var maxDistance = row.MinDistance * (1 + aim.MaxGap);
            // The few that are more than balls are compared by their gaps.
            if (row is { IsBall: true, HasFixedNormal: false, HasArms: false } && row.SurfaceDisplacement == Vector.Zero
                && offset.LengthSquared() >= maxDistance * maxDistance)
            {
                continue;
            }

            var gap = new SeparationGap(in row, in aim);
            offset = OffsetOf(in gap, movers);
            var distance = gap.IsPlane ? Vector.Dot(offset, gap.Normal) : offset.Length();
            if (distance < maxDistance)
            {
                if (_count == _gaps.Length)
                {
                    Array.Resize(ref _gaps, Math.Max(1, 2 * _gaps.Length));
                }

                _gaps[_count++] = gap;
            }
        }
    }

    /// <summary>Empties the list of a body's contacts, before the queue is filled.</summary>
    public void ClearListOf(int body) => _queue.ClearListsOf(body, -1);

    /// <summary>Lets all contacts wait to be tested.</summary>
    /// <param name="bodyCount">Number of bodies of the world.</param>
    public void Enqueue(int bodyCount)
    {
        _queue.Reserve(bodyCount, _gaps.Length);
        foreach (ref readonly var gap in Gaps)
        {
            _queue.ClearListsOf(gap.First, gap.Second);
        }

        for (var i = 0; i < _count; i++)
        {
            _queue.Add(i, _gaps[i].First, _gaps[i].Second);
        }

        _queue.WaitForAll(_count);
    }

    /// <summary>Lets the contacts of a body wait, which must be in the queue's lists.</summary>
    public void WaitForContactsOf(int body) => _queue.WaitForContactsOf(body);

    /// <summary>Tests all contacts that wait.</summary>
    /// <param name="movers">Bodies by their index.</param>
    /// <param name="isBackwards">True for the opposite order.</param>
    /// <returns>True where bodies have been moved, so that others wait.</returns>
    public bool MakeRound(Span<DisplacedBody> movers, bool isBackwards)
    {
        var gaps = Gaps;
        var hasMoved = false;
        var index = isBackwards ? gaps.Length : -1;
        while (isBackwards ? _queue.TryTakePrevious(ref index) : _queue.TryTakeNext(ref index))
        {
            ref readonly var gap = ref gaps[index];
            if (TakeBack(in gap, movers))
            {
                hasMoved = true;
                movers[gap.First].HasJustMoved = true;
                _queue.WaitForContactsOf(gap.First);
                if (gap.Second >= 0)
                {
                    movers[gap.Second].HasJustMoved = true;
                    _queue.WaitForContactsOf(gap.Second);
                }
            }
        }

        HasMoved |= hasMoved;
        return hasMoved;
    }

    /// <summary>Moves two overlapping bodies apart, the lighter one farther.</summary>
    /// <returns>True where that may have made others overlap.</returns>
    public static bool TakeBack(in SeparationGap gap, Span<DisplacedBody> movers)
    {
        var offset = OffsetOf(in gap, movers);
        double distance;
        if (gap.IsPlane)
        {
            distance = Vector.Dot(offset, gap.Normal);
            if (distance >= gap.MinDistance - gap.Negligible)
            {
                return false;
            }
        }
        else
        {
            var least = gap.MinDistance - gap.Negligible;
            var lengthSquared = offset.LengthSquared();
            if (lengthSquared >= least * least)
            {
                return false;
            }

            distance = Math.Sqrt(lengthSquared);
        }

        var normal = gap.IsPlane ? gap.Normal : distance > MinDistance ? (1 / distance) * offset : offset.UnitVectorOrZero();
        ref var first = ref movers[gap.First];
        var firstWeight = first.InverseMass;
        var secondWeight = gap.Second >= 0 ? movers[gap.Second].InverseMass : 0;
        if (gap.IsOneSided && secondWeight > 0 && firstWeight > 0)
        {
            // The faster one ends where it touches.
            var isFirstFaster = first.Displacement.LengthSquared() >= movers[gap.Second].Displacement.LengthSquared();
            firstWeight = isFirstFaster ? firstWeight : 0;
            secondWeight = isFirstFaster ? 0 : secondWeight;
        }

        var sum = firstWeight + secondWeight;
        if (sum == 0)
        {
            return false;
        }

        var overlap = gap.MinDistance - distance;
        var shift = ((gap.Relaxation * overlap) - gap.Aimed) / sum * normal;
        first.Displacement += firstWeight * shift;
        first.HasMoved = true;
        if (gap.Second >= 0)
        {
            movers[gap.Second].Displacement -= secondWeight * shift;
            movers[gap.Second].HasMoved = true;
        }

        return overlap > NegligibleShift * gap.MinDistance;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector OffsetOf(in SeparationGap gap, ReadOnlySpan<DisplacedBody> movers) => gap.Second >= 0
        ? gap.Offset + (movers[gap.First].Displacement - movers[gap.Second].Displacement) : gap.Offset + movers[gap.First].Displacement;
}
