using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>
/// Takes back the overlaps that the solve of an island has left, by displacements alone: one contact after the other, and again, until
/// all of them are negligible.
/// </summary>
internal sealed class OverlapSeparator(ContactGraph graph)
{
    /// <summary>Relative to the smaller radius: overlaps that are left.</summary>
    public const double NegligibleOverlap = 3e-7;

    // Rounds over the contacts that are near touching, and times that these are chosen anew.
    private const int MaxRounds = 60;
    private const int MaxChoices = 4;

    // Gap, relative to the distance at which two touch, beyond which they are not near touching.
    private const double Near = 0.01;

    // Where something pushes bodies together, all of a row come to touch at once.
    private const double PushedNear = 0.25;

    // Squares of shorter offsets lose digits.
    private const double MinDistance = 1e-140;

    // Relative to the distance at which two touch: a shorter displacement makes no others overlap.
    private const double NegligibleShift = 0.1 * NegligibleOverlap;

    private readonly List<SeparationGap> _gaps = [];
    private DisplacedBody[] _movers = [];

    /// <summary>Makes room for the bodies of a world and their contacts.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        _movers = new DisplacedBody[bodyCount];
        _gaps.EnsureCapacity(contactCount);
    }

    /// <summary>Sets the displacement of a body from the beginning of the step, and its inverse mass; 0 where it is held.</summary>
    public void SetBody(int index, Vector displacement, double inverseMass) =>
        _movers[index] = new() { Displacement = displacement, ChosenDisplacement = displacement, InverseMass = inverseMass };

    /// <summary>The displacement of a body after the separation.</summary>
    public Vector DisplacementOf(int index) => _movers[index].Displacement;

    /// <summary>True for a body whose displacement has been changed.</summary>
    public bool HasMoved(int index) => _movers[index].HasMoved;

    /// <summary>Separates all bodies of an island, whose displacements must have been set.</summary>
    /// <param name="island">The island.</param>
    /// <param name="others">Contacts that no plan knew.</param>
    public void Separate(in Island island, ReadOnlySpan<ContactRow> others)
    {
        var maxGap = island.IsPushed ? PushedNear : Near;
        var reach = 0.5 * maxGap * graph.MinRadiusOf(in island);
        // Chosen anew as long as what was not near touching comes to overlap.
        var hasMoved = true;
        for (var choice = 0; choice < MaxChoices && hasMoved; choice++)
        {
            _gaps.Clear();
            Choose(graph.RowsOf(in island), maxGap);
            Choose(others, maxGap);
            hasMoved = MakeRounds(out var isEnded) && !(StaysWithin(reach, in island) && isEnded);
        }

        // Last, since what is immovable gives way to nothing.
        TakeBackSurfaces(graph.RowsOf(in island));
        TakeBackSurfaces(others);
    }

    /// <summary>Chooses the contacts that are near touching.</summary>
    private void Choose(ReadOnlySpan<ContactRow> rows, double maxGap)
    {
        foreach (ref readonly var row in rows)
        {
            var gap = new SeparationGap(in row);
            var offset = OffsetOf(in gap);
            if ((gap.IsPlane ? Vector.Dot(offset, gap.Normal) : offset.Length()) < row.MinDistance * (1 + maxGap))
            {
                _gaps.Add(gap);
            }
        }
    }

    /// <summary>True where no body has been moved so far that contacts come to overlap which were not near when they were chosen.</summary>
    private bool StaysWithin(double reach, in Island island)
    {
        var maxShiftSquared = 0.0;
        foreach (var index in graph.BodiesOf(in island))
        {
            ref var mover = ref _movers[index];
            maxShiftSquared = Math.Max(maxShiftSquared, (mover.Displacement - mover.ChosenDisplacement).LengthSquared());
            mover.ChosenDisplacement = mover.Displacement;
        }

        // Each of the two bodies may have come nearer by so much.
        return maxShiftSquared < reach * reach;
    }

    /// <summary>Makes rounds to and fro: what the floor pushes up reaches the top of a pile in one round.</summary>
    /// <param name="isEnded">Receives true where none overlap any more that are near.</param>
    /// <returns>True where a body has been moved.</returns>
    private bool MakeRounds(out bool isEnded)
    {
        var gaps = CollectionsMarshal.AsSpan(_gaps);
        var hasMoved = false;
        isEnded = false;
        for (var round = 0; round < MaxRounds && !isEnded; round++)
        {
            isEnded = true;
            for (var i = 0; i < gaps.Length; i++)
            {
                isEnded &= !TakeBack(in gaps[round % 2 == 0 ? i : gaps.Length - 1 - i]);
            }

            hasMoved |= !isEnded;
        }

        return hasMoved;
    }

    /// <summary>Moves two overlapping bodies apart, the lighter one farther.</summary>
    /// <returns>True where that may have made others overlap.</returns>
    internal bool TakeBack(in SeparationGap gap)
    {
        var offset = OffsetOf(in gap);
        var distance = gap.IsPlane ? Vector.Dot(offset, gap.Normal) : offset.Length();
        if (distance >= gap.MinDistance - gap.Negligible)
        {
            return false;
        }

        var normal = gap.IsPlane ? gap.Normal : distance > MinDistance ? (1 / distance) * offset : offset.UnitVectorOrZero();
        ref var first = ref _movers[gap.First];
        var firstWeight = first.InverseMass;
        var secondWeight = gap.Second >= 0 ? _movers[gap.Second].InverseMass : 0;
        if (gap.IsOneSided && secondWeight > 0 && firstWeight > 0)
        {
            // The faster one ends where it touches.
            var isFirstFaster = first.Displacement.LengthSquared() >= _movers[gap.Second].Displacement.LengthSquared();
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
            _movers[gap.Second].Displacement -= secondWeight * shift;
            _movers[gap.Second].HasMoved = true;
        }

        return overlap > NegligibleShift * gap.MinDistance;
    }

    private Vector OffsetOf(in SeparationGap gap) => gap.Second >= 0
        ? gap.Offset + (_movers[gap.First].Displacement - _movers[gap.Second].Displacement) : gap.Offset + _movers[gap.First].Displacement;

    private void TakeBackSurfaces(ReadOnlySpan<ContactRow> rows)
    {
        foreach (ref readonly var row in rows)
        {
            if (!row.IsBall)
            {
                _ = TakeBack(new SeparationGap(in row));
            }
        }
    }
}
