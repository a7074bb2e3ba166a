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

    // Squares of shorter offsets lose digits.
    private const double MinDistance = 1e-140;

    // Of an overlap: how much of it is taken back at once, since others will push in again.
    private const double Relaxation = 1.3;

    // Of the smaller radius: overlaps at which a displacement ends; and the gap that is left where bodies keep a margin, so that they
    // need not be displaced again soon.
    private const double AimedOverlap = 1e-7;
    private const double AimedGap = 0.3 * ContactTolerances.HeapMargin;

    // Of the distance at which two touch: a shorter displacement makes no others overlap.
    private const double NegligibleShift = 0.1 * NegligibleOverlap;

    private Mover[] _movers = new Mover[InitialCapacity];
    private Gap[] _gaps = new Gap[InitialCapacity];
    private readonly GapQueue _queue = new();
    private double _maxGap = MaxGap;
    private double _aim = AimedOverlap;

    /// <summary>Grows the arrays to the bodies of a world, so that its steps allocate nothing.</summary>
    public void Reserve(int bodyCount)
    {
        if (_movers.Length < bodyCount)
        {
            Array.Resize(ref _movers, Math.Max(bodyCount, 2 * _movers.Length));
            Array.Resize(ref _gaps, Math.Max(ContactsPerBody * _movers.Length, _gaps.Length));
            _queue.Reserve(_movers.Length, _gaps.Length);
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
    /// <param name="keepsMargin">True for a large island, see <see cref="ContactTolerances.HeapMargin"/>.</param>
    public void Separate(Span<ContactRow> rows, Span<ContactRow> others, bool keepsMargin)
    {
        _aim = keepsMargin ? -AimedGap : AimedOverlap;
        if (_gaps.Length < rows.Length + others.Length)
        {
            _gaps = new Gap[2 * (rows.Length + others.Length)];
            _queue.Reserve(_movers.Length, _gaps.Length);
        }

        _maxGap = IsPushed(rows) ? MaxPushedGap : MaxGap;
        // Chosen anew as long as what was not near touching comes to overlap.
        var hasMoved = true;
        for (var choice = 0; choice < MaxChoices && hasMoved; choice++)
        {
            var gaps = _gaps.AsSpan(0, Choose(others, Choose(rows, 0)));
            Enqueue(gaps);
            hasMoved = MakeRound(gaps, isBackwards: false);
            // To and fro: what the floor pushes up reaches the top of a pile in one round.
            for (var round = 1; round < MaxRounds && MakeRound(gaps, isBackwards: round % 2 == 1); round++)
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
            var gap = new Gap(in row, _aim);
            var offset = OffsetOf(in gap);
            var distance = gap.IsPlane ? Vector.Dot(offset, gap.Normal) : offset.Length();
            if (distance < gap.MinDistance * (1 + _maxGap))
            {
                _gaps[count++] = gap;
            }
        }

        return count;
    }

    private void Enqueue(ReadOnlySpan<Gap> gaps)
    {
        foreach (ref readonly var gap in gaps)
        {
            _queue.ClearListsOf(gap.First, gap.Second);
        }

        for (var i = 0; i < gaps.Length; i++)
        {
            _queue.Add(i, gaps[i].First, gaps[i].Second);
        }

        _queue.WaitForAll(gaps.Length);
    }

    /// <summary>Tests all contacts that wait.</summary>
    /// <returns>True where bodies have been moved, so that others wait.</returns>
    private bool MakeRound(ReadOnlySpan<Gap> gaps, bool isBackwards)
    {
        var hasMoved = false;
        var index = isBackwards ? gaps.Length : -1;
        while (isBackwards ? _queue.TryTakePrevious(ref index) : _queue.TryTakeNext(ref index))
        {
            ref readonly var gap = ref gaps[index];
            if (TakeBack(in gap))
            {
                hasMoved = true;
                _queue.WaitForContactsOf(gap.First);
                if (gap.Second >= 0)
                {
                    _queue.WaitForContactsOf(gap.Second);
                }
            }
        }

        return hasMoved;
    }

    private void TakeBackSurfaces(Span<ContactRow> rows)
    {
        foreach (ref readonly var row in rows)
        {
            if (!row.IsBall)
            {
                _ = TakeBack(new Gap(in row, _aim));
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

        var normal = gap.IsPlane ? gap.Normal : distance > MinDistance ? (1 / distance) * offset : offset.UnitVectorOrZero();
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

        return overlap > NegligibleShift * gap.MinDistance;
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

        public Gap(in ContactRow row, double aim)
        {
            First = row.First;
            Second = row.Second;
            Offset = row.HasArms ? row.Offset + row.TurnShift - row.SurfaceWay : row.Offset - row.SurfaceWay;
            Normal = row.Normal;
            MinDistance = row.MinDistance;
            var unit = row.IsBall ? row.MinDistance * row.SmallerRadiusShare : 0;
            Negligible = NegligibleOverlap * unit;
            Aimed = aim * unit;
            Relaxation = row.IsBall && !row.IsAhead ? OverlapSeparator.Relaxation : 1;
            IsPlane = !row.IsBall || row.HasFixedNormal;
            IsOneSided = row.IsBouncingAhead;
        }
    }
}
