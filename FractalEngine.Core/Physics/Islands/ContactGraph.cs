using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Finds which bodies touch at the beginning of a step, and groups them: an island is made of two or more awake bodies that touch,
/// directly or through others. Its order is that of the bodies' indices, whatever the order of the search.
/// </summary>
internal sealed partial class ContactGraph(List<Body> bodies, NearbyBodies nearbyBodies)
{
    private const int InitialCapacity = 256;

    private readonly List<int> _neighbours = new(InitialCapacity);
    private readonly List<Island> _islands = new(InitialCapacity);
    private readonly List<int> _islandBodies = new(InitialCapacity);
    private ContactRow[] _found = new ContactRow[InitialCapacity];
    private ContactRow[] _rows = new ContactRow[InitialCapacity];
    private readonly DisjointSets _sets = new();
    private int[] _islandOf = new int[InitialCapacity];
    private int[] _nextBody = new int[InitialCapacity];
    private bool[] _isTouched = new bool[InitialCapacity];
    private double _stepLength;
    private int _count;

    /// <summary>The islands, in the order of their lowest body.</summary>
    public List<Island> Islands => _islands;

    /// <summary>The contacts of an island.</summary>
    public Span<ContactRow> RowsOf(in Island island) => _rows.AsSpan(island.FirstRow, island.RowCount);

    /// <summary>Number of contacts of all islands.</summary>
    public int RowCount { get; private set; }

    /// <summary>A contact of an island.</summary>
    public ref ContactRow Row(int index) => ref _rows[index];

    /// <summary>The bodies of an island, in the order of their indices.</summary>
    public ReadOnlySpan<int> BodiesOf(in Island island) =>
        CollectionsMarshal.AsSpan(_islandBodies).Slice(island.FirstBody, island.BodyCount);

    /// <summary>Finds all contacts and islands. The contacts of bodies with surfaces must be up to date.</summary>
    /// <param name="stepLength">Seconds.</param>
    /// <param name="islands">Wakes bodies that sleep and are hit.</param>
    /// <returns>True where bodies were woken, and nothing else has been done.</returns>
    public bool Build(SleepIslands islands, double stepLength)
    {
        _stepLength = stepLength;
        var hasWoken = false;
        if (_islandOf.Length < bodies.Count)
        {
            _islandOf = new int[2 * bodies.Count];
            _nextBody = new int[2 * bodies.Count];
            _isTouched = new bool[2 * bodies.Count];
        }

        _count = 0;
        _sets.Reset(bodies.Count);
        for (var i = 0; i < bodies.Count; i++)
        {
            _islandOf[i] = -1;
            _isTouched[i] = false;
        }

        for (var i = 0; i < bodies.Count; i++)
        {
            if (CanMove(bodies[i]))
            {
                hasWoken |= AddContactsOf(i, islands);
            }
        }

        if (!hasWoken)
        {
            JoinAhead();
            GroupByIslands();
        }

        return hasWoken;
    }

    private static bool CanMove(Body body) => !body.IsAsleep && !body.IsStuck && body.IsOverlapResolved;

    /// <summary>Adds the contacts of a body; or wakes a sleeping body that it has hit.</summary>
    private bool AddContactsOf(int index, SleepIslands islands)
    {
        var body = bodies[index];
        for (var i = 0; i < body.Contacts.Count; i++)
        {
            if (body.Contacts[i] is { IsBody: false } contact)
            {
                AddSurface(index, in contact, isAhead: false);
            }
        }

        if (body.TouchedSurface is { } touched && !body.Contacts.Has(in touched, body.Position))
        {
            AddSurface(index, in touched, isAhead: false);
        }

        if (body.NearSurface is { } near && !BouncesFrom(body, near.Normal(body.Position)))
        {
            AddSurface(index, in near, isAhead: true);
        }

        _neighbours.Clear();
        var reach = Reach(body);
        nearbyBodies.CollectOverlaps(new(body.Position, body.Position), body.Radius + reach, index, _neighbours);
        _neighbours.Sort();
        foreach (var neighbour in _neighbours)
        {
            var other = bodies[neighbour];
            var gap = (body.Position - other.Position).Length() - body.Radius - other.Radius;
            var isTouching = gap <= ContactTolerances.Slop(body.Radius, body.Position);
            if (isTouching && other.IsAsleep && IsHit(body, other))
            {
                islands.Wake(other);
                return true;
            }

            if (!CanMove(other) || neighbour > index)
            {
                AddBall(index, neighbour, isTouching);
            }
        }

        return false;
    }

    private void AddSurface(int index, in Contact contact, bool isAhead)
    {
        var body = bodies[index];
        AddRow(new()
        {
            First = index, Second = ContactRow.Firm, Offset = contact.PointToCentre(body.Position), MinDistance = body.Radius,
            Normal = contact.Normal(body.Position), FirstRadius = body.Radius, Friction = body.Description.Friction,
            Restitution = body.Description.Restitution, IsAhead = isAhead, RollingArm = body.Description.RollingFriction * body.Radius,
            SpinningArm = body.Description.SpinningFriction * body.Radius,
        });
    }

    private void AddBall(int index, int neighbour, bool isTouching)
    {
        var body = bodies[index];
        var other = bodies[neighbour];
        var isMovable = CanMove(other);
        var offset = body.Position - other.Position;
        var radius = Math.Min(body.Radius, other.Radius);
        var row = new ContactRow
        {
            First = index, Second = isMovable ? neighbour : ContactRow.Firm, Offset = offset, MinDistance = body.Radius + other.Radius,
            Normal = offset.UnitVectorOrZero(), FirstRadius = body.Radius, SecondRadius = other.Radius, IsBall = true,
            IsAhead = !isTouching,
            Friction = Math.Min(body.Description.Friction, other.Description.Friction),
            Restitution = Math.Min(body.Description.Restitution, other.Description.Restitution),
            RollingArm = radius * Math.Min(body.Description.RollingFriction, other.Description.RollingFriction),
            SpinningArm = radius * Math.Min(body.Description.SpinningFriction, other.Description.SpinningFriction),
        };
        if (isTouching)
        {
            AddRow(in row);
            if (isMovable)
            {
                _isTouched[index] = true;
                _isTouched[neighbour] = true;
                _sets.Join(index, neighbour);
            }
        }
        else if (isMovable && MayMeet(body, other) && (row.Restitution == 0 || !IsHit(body, other)))
        {
            AddRow(in row);
        }
    }

    /// <summary>How far from a body another one may be that it meets in the step: each counts its own way.</summary>
    private double Reach(Body body) => 2 * new Motion(Vector.Zero, body.Velocity, body.FreeAcceleration).MaxTravelDistance(_stepLength);

    private bool MayMeet(Body body, Body other)
    {
        var gap = (body.Position - other.Position).Length() - body.Radius - other.Radius;
        var relative = new Motion(
            Vector.Zero, body.Velocity - other.Velocity, (2 * body.FreeAcceleration.Length() * Vector.I));
        return gap <= relative.MaxTravelDistance(_stepLength);
    }

    private static bool IsHit(Body body, Body other) =>
        -Vector.Dot(body.Velocity - other.Velocity, (body.Position - other.Position).UnitVectorOrZero()) > body.RestitutionThreshold;

    private static bool BouncesFrom(Body body, Vector normal) =>
        body.Description.Restitution > 0 && -Vector.Dot(body.Velocity, normal) > body.RestitutionThreshold;

    /// <summary>Joins bodies that may meet, where one of them touches another already. Alone, both go their exact ways.</summary>
    private void JoinAhead()
    {
        for (var i = 0; i < _count; i++)
        {
            ref var row = ref _found[i];
            if (row.IsAhead && row.Second >= 0 && (_isTouched[row.First] || _isTouched[row.Second]))
            {
                _sets.Join(row.First, row.Second);
            }
        }

        var kept = 0;
        for (var i = 0; i < _count; i++)
        {
            ref var row = ref _found[i];
            if (!row.IsAhead || row.Second < 0 || _sets.RootOf(row.First) == _sets.RootOf(row.Second))
            {
                _found[kept++] = row;
            }
        }

        _count = kept;
    }

    private void AddRow(in ContactRow row)
    {
        if (_count == _found.Length)
        {
            Array.Resize(ref _found, 2 * _found.Length);
        }

        _found[_count++] = row;
    }
}
