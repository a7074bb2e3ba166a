using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>The contacts of islands, which are made of pairs and of surfaces that bodies touch or may meet.</summary>
internal sealed class IslandRows(List<Body> bodies, BodyCopies copies)
{
    private ContactRow[] _rows = [];
    private int _count;

    /// <summary>What is among contacts: something immovable, and surfaces that move.</summary>
    [Flags]
    internal enum RowKinds
    {
        None = 0,
        Immovable = 1,
        Moving = 2,
    }

    /// <summary>Number of contacts that there is room for.</summary>
    public int Capacity => _rows.Length;

    /// <summary>Number of contacts so far. Room is made for more by <see cref="Reserve"/>.</summary>
    public int Count { get => _count; set => _count = value; }

    /// <summary>A contact by its index among those of all islands.</summary>
    public ref ContactRow this[int index] => ref _rows[index];

    /// <summary>The contacts of one island or part, which stand side by side.</summary>
    public Span<ContactRow> Range(int first, int count) => _rows.AsSpan(first, count);

    /// <summary>Tells what is among contacts.</summary>
    public static RowKinds Examine(ReadOnlySpan<ContactRow> rows)
    {
        var kinds = RowKinds.None;
        foreach (ref readonly var row in rows)
        {
            kinds |= row.Second >= 0 ? RowKinds.None : RowKinds.Immovable;
            kinds |= row.IsOnMovingSurface ? RowKinds.Moving : RowKinds.None;
        }

        return kinds;
    }

    /// <summary>Adds the contacts of a body with surfaces.</summary>
    public void AddSurfaces(Body body)
    {
        var firstRow = _count;
        for (var ball = 0; ball < body.Balls.Length; ball++)
        {
            Reserve(_count + body.Balls[ball].Contacts.SurfaceCount + body.Balls[ball].NearSurfaces.Count);
            FillSurfaces(body, ball, ref _count);
        }

        if (body.Description.Shape is { IsCapsule: true })
        {
            _count = firstRow + CapsuleRows.RemoveInner(_rows.AsSpan(firstRow, _count - firstRow));
        }
    }

    /// <summary>Makes the contacts of a ball with surfaces, in places for which room has been made.</summary>
    public void FillSurfaces(Body body, int ball, ref int place)
    {
        var (contacts, nearSurfaces) = (body.Balls[ball].Contacts, body.Balls[ball].NearSurfaces);
        for (var i = 0; i < contacts.Count; i++)
        {
            if (!contacts[i].IsBody)
            {
                _rows[place++] = ContactRows.OfSurface(body, ball, in contacts[i]);
            }
        }

        for (var i = 0; i < nearSurfaces.Count; i++)
        {
            _rows[place++] = ContactRows.OfNearSurface(body, ball, in nearSurfaces[i]);
        }
    }

    /// <summary>Adds the contacts of two bodies.</summary>
    public void AddPair(in BodyPair pair)
    {
        if (!copies[pair.First].IsCompound && !copies[pair.Second].IsCompound)
        {
            SetBalls(ref AddRow(), in pair);
            return;
        }

        var body = bodies[pair.First];
        var other = bodies[pair.Second];
        var limit = BodyCopies.DeviationLimit(in copies[pair.First]) + (copies.StepLength * body.AngularVelocity.Length() * body.MaxArm)
            + (copies.StepLength * copies.RelativeVelocity(in pair).Length());
        limit += pair.IsSecondImmovable ? 0
            : BodyCopies.DeviationLimit(in copies[pair.Second]) + (copies.StepLength * other.AngularVelocity.Length() * other.MaxArm);
        for (var i = 0; i < body.BallCount; i++)
        {
            for (var j = 0; j < other.BallCount; j++)
            {
                var gap = BallPairs.Gap(body, i, other, j);
                if (gap <= limit)
                {
                    AddBalls(in pair, i, j, gap > ContactTolerances.Slop(Math.Min(body.BallRadius(i), other.BallRadius(j)), body.Position));
                }
            }
        }
    }

    private void AddBalls(in BodyPair pair, int ball, int otherBall, bool isAhead)
    {
        ref var row = ref AddRow();
        ContactRows.SetBalls(ref row, bodies[pair.First], ball, bodies[pair.Second], otherBall, pair.IsSecondImmovable, isAhead);
        RemoveRestitution(ref row, in pair);
    }

    /// <summary>Sets the contact of two bodies that are one ball each.</summary>
    public void SetBalls(ref ContactRow row, in BodyPair pair)
    {
        ref readonly var first = ref copies[pair.First];
        ref readonly var second = ref copies[pair.Second];
        row.First = pair.First;
        row.Second = pair.IsSecondImmovable ? ContactRow.Immovable : pair.Second;
        row.IsAhead = !pair.IsTouching;
        ContactRows.SetBalls(ref row, first.Position - second.Position, first.Radius, second.Radius);
        ContactRows.SetMaterials(ref row, in copies.MaterialOf(pair.First), in copies.MaterialOf(pair.Second));
        RemoveRestitution(ref row, in pair);
    }

    /// <summary>What bounces first goes as far as it touches only, and would be overrun by what is pushed.</summary>
    private void RemoveRestitution(ref ContactRow row, in BodyPair pair) =>
        row.Restitution = row.IsAhead && copies.IsPushed(in pair) ? 0 : row.Restitution;

    private ref ContactRow AddRow()
    {
        Reserve(_count + 1);
        ContactRow.Clear(ref _rows[_count]);
        return ref _rows[_count++];
    }

    /// <summary>Makes room for so many contacts.</summary>
    public void Reserve(int count)
    {
        if (_rows.Length < count)
        {
            Array.Resize(ref _rows, Math.Max(count, 2 * _rows.Length));
        }
    }
}
