using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Takes back the overlaps that the solve of an island has left, by displacements alone: one contact after the other, and again, until
/// all of them are negligible.
/// </summary>
internal sealed class OverlapSeparator
{
    /// <summary>Of the smaller radius: overlaps that are left.</summary>
    public const double NegligibleOverlap = 3e-7;

    private const int InitialCapacity = 256;
    private const int ContactsPerBody = 4;

    // Rounds over the contacts that are near touching, and times that these are chosen anew.
    private const int MaxRounds = 60;
    private const int MaxChoices = 4;

    // Of the distance at which two touch: those farther apart are not near touching.
    private const double MaxGap = 0.01;

    // The same where something pushes bodies together: then all of a row come to touch at once.
    private const double MaxPushedGap = 0.25;

    // Of an overlap: how much of it is taken back at once, since others will push in again.
    private const double Relaxation = 1.3;

    // Of the smaller radius: overlaps at which a displacement ends.
    private const double AimedOverlap = 1e-7;

    private Mover[] _movers = new Mover[InitialCapacity];
    private Gap[] _gaps = new Gap[InitialCapacity];
    private double _maxGap = MaxGap;

    /// <summary>Grows the arrays to the bodies of a world, so that its steps allocate nothing.</summary>
    public void Reserve(int bodyCount)
    {
        if (_movers.Length < bodyCount)
        {
            Array.Resize(ref _movers, Math.Max(bodyCount, 2 * _movers.Length));
            Array.Resize(ref _gaps, Math.Max(ContactsPerBody * _movers.Length, _gaps.Length));
        }
    }

    /// <summary>Sets the way of a body from the beginning of the step, and its inverse mass; 0 where it is held.</summary>
    public void SetBody(int index, Vector way, double inverseMass) => _movers[index] = new() { Way = way, InverseMass = inverseMass };

    /// <summary>The way of a body after the separation.</summary>
    public Vector WayOf(int index) => _movers[index].Way;

    /// <summary>True for a body whose way has been changed.</summary>
    public bool HasMoved(int index) => _movers[index].HasMoved;

    /// <summary>Separates all bodies of an island, whose ways must have been set.</summary>
    /// <param name="rows">Contacts of the island.</param>
    /// <param name="others">Contacts that no plan knew.</param>
    public void Separate(Span<ContactRow> rows, Span<ContactRow> others)
    {
        if (_gaps.Length < rows.Length + others.Length)
        {
            _gaps = new Gap[2 * (rows.Length + others.Length)];
        }

        _maxGap = IsPushed(rows) ? MaxPushedGap : MaxGap;
        // Chosen anew as long as what was not near touching comes to overlap.
        var hasMoved = true;
        for (var choice = 0; choice < MaxChoices && hasMoved; choice++)
        {
            var gaps = _gaps.AsSpan(0, Choose(others, Choose(rows, 0)));
            hasMoved = MakeRound(gaps, isBackwards: false);
            // To and fro: what the floor pushes up reaches the top of a pile in one round.
            for (var round = 1; round < MaxRounds && MakeRound(gaps, round % 2 == 1); round++)
            {
            }
        }

        // Last, since what is firm gives way to nothing.
        TakeBackSurfaces(rows);
        TakeBackSurfaces(others);
    }

    private static bool IsPushed(ReadOnlySpan<ContactRow> rows)
    {
        foreach (ref readonly var row in rows)
        {
            if (row.SurfaceWay != Vector.Zero)
            {
                return true;
            }
        }

        return false;
    }

    private int Choose(Span<ContactRow> rows, int count)
    {
        foreach (ref readonly var row in rows)
        {
            var gap = new Gap(in row);
            var offset = OffsetOf(in gap);
            var distance = gap.IsPlane ? Vector.Dot(offset, gap.Normal) : offset.Length();
            if (distance < gap.MinDistance * (1 + _maxGap))
            {
                _gaps[count++] = gap;
            }
        }

        return count;
    }

    private bool MakeRound(Span<Gap> gaps, bool isBackwards)
    {
        var hasMoved = false;
        for (var i = 0; i < gaps.Length; i++)
        {
            hasMoved |= TakeBack(in gaps[isBackwards ? gaps.Length - 1 - i : i]);
        }

        return hasMoved;
    }

    private void TakeBackSurfaces(Span<ContactRow> rows)
    {
        foreach (ref readonly var row in rows)
        {
            if (!row.IsBall)
            {
                _ = TakeBack(new Gap(in row));
            }
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Vector OffsetOf(in Gap gap) => gap.Second >= 0
        ? gap.Offset + (_movers[gap.First].Way - _movers[gap.Second].Way) : gap.Offset + _movers[gap.First].Way;

    /// <summary>Moves two overlapping bodies apart, the lighter one farther.</summary>
    /// <returns>True where that may have made others overlap.</returns>
    private bool TakeBack(in Gap gap)
    {
        var offset = OffsetOf(in gap);
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

        var normal = gap.IsPlane ? gap.Normal : offset.UnitVectorOrZero();
        ref var first = ref _movers[gap.First];
        var firstWeight = first.InverseMass;
        var secondWeight = gap.Second >= 0 ? _movers[gap.Second].InverseMass : 0;
        if (gap.IsOneSided && secondWeight > 0 && firstWeight > 0)
        {
            // The faster one ends where it touches.
            var isFirstFaster = first.Way.LengthSquared() >= _movers[gap.Second].Way.LengthSquared();
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
        first.Way += firstWeight * shift;
        first.HasMoved = true;
        if (gap.Second >= 0)
        {
            _movers[gap.Second].Way -= secondWeight * shift;
            _movers[gap.Second].HasMoved = true;
        }

        return overlap > NegligibleOverlap * gap.MinDistance;
    }

    /// <summary>What a separation needs of a body.</summary>
    private struct Mover
    {
        public Vector Way;
        public double InverseMass;
        public bool HasMoved;
    }

    /// <summary>What a separation needs of a contact.</summary>
    private readonly struct Gap
    {
        public readonly int First;
        public readonly int Second;
        public readonly Vector Offset;
        public readonly Vector Normal;
        public readonly double MinDistance;
        public readonly double Negligible;
        public readonly double Aimed;
        public readonly double Relaxation;
        public readonly bool IsPlane;
        public readonly bool IsOneSided;

        public Gap(in ContactRow row)
        {
            First = row.First;
            Second = row.Second;
            Offset = row.HasArms ? row.Offset + row.TurnShift - row.SurfaceWay : row.Offset - row.SurfaceWay;
            Normal = row.Normal;
            MinDistance = row.MinDistance;
            var unit = row.IsBall ? row.MinDistance * row.SmallerRadiusShare : 0;
            Negligible = NegligibleOverlap * unit;
            Aimed = AimedOverlap * unit;
            Relaxation = row.IsBall && !row.IsAhead ? OverlapSeparator.Relaxation : 1;
            IsPlane = !row.IsBall || row.HasFixedNormal;
            IsOneSided = row.IsBouncingAhead;
        }
    }
}
