using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Orders planned bodies so that each moves into what others have already left: the lowest of a falling column first. Where bodies wait
/// for each other in a ring, the one with the lowest index begins.
/// </summary>
internal sealed class MoveOrder(List<Body> bodies)
{
    private const int InitialCapacity = 256;

    // Less than any number of followers can raise or lower to 0.
    private const int Placed = int.MinValue / 2;

    private readonly List<int> _order = new(InitialCapacity);

    // By body: how many others it waits for (negative once it has its place), and where its followers begin and end.
    private int[] _waits = new int[InitialCapacity];
    private int[] _firstFollower = new int[InitialCapacity];
    private int[] _lastFollower = new int[InitialCapacity];
    private int[] _followers = new int[InitialCapacity];

    /// <summary>The indices of all bodies so far.</summary>
    public ReadOnlySpan<int> Bodies => CollectionsMarshal.AsSpan(_order);

    /// <summary>Removes all bodies from the order.</summary>
    public void Clear() => _order.Clear();

    /// <summary>Appends the bodies of an island, whose velocities and accelerations are planned.</summary>
    public void Append(ReadOnlySpan<int> island, Span<ContactRow> rows, double stepLength)
    {
        if (_waits.Length < bodies.Count)
        {
            _waits = new int[2 * bodies.Count];
            _firstFollower = new int[2 * bodies.Count];
            _lastFollower = new int[2 * bodies.Count];
        }

        if (_followers.Length < rows.Length)
        {
            _followers = new int[2 * rows.Length];
        }

        FindFollowers(island, rows, stepLength);
        var next = _order.Count;
        var nextToBreak = 0;
        foreach (var index in island)
        {
            Place(index, mustBeFree: true);
        }

        while (true)
        {
            for (; next < _order.Count; next++)
            {
                var leader = _order[next];
                for (var i = _firstFollower[leader]; i < _lastFollower[leader]; i++)
                {
                    _waits[_followers[i]]--;
                    Place(_followers[i], mustBeFree: true);
                }
            }

            for (; nextToBreak < island.Length && _waits[island[nextToBreak]] < 0; nextToBreak++)
            {
            }

            if (nextToBreak == island.Length)
            {
                return;
            }

            Place(island[nextToBreak], mustBeFree: false);
        }
    }

    private void Place(int index, bool mustBeFree)
    {
        if (_waits[index] == 0 || (!mustBeFree && _waits[index] > 0))
        {
            _waits[index] = Placed;
            _order.Add(index);
        }
    }

    private void FindFollowers(ReadOnlySpan<int> island, Span<ContactRow> rows, double stepLength)
    {
        foreach (var index in island)
        {
            _waits[index] = 0;
            _firstFollower[index] = 0;
        }

        foreach (ref var row in rows)
        {
            if (TryOrder(in row, stepLength, out var leader, out var follower))
            {
                _firstFollower[leader]++;
                _waits[follower]++;
            }
        }

        var total = 0;
        foreach (var index in island)
        {
            var count = _firstFollower[index];
            _firstFollower[index] = total;
            _lastFollower[index] = total;
            total += count;
        }

        foreach (ref var row in rows)
        {
            if (TryOrder(in row, stepLength, out var leader, out var follower))
            {
                _followers[_lastFollower[leader]++] = follower;
            }
        }
    }

    /// <summary>Tells which of two bodies must move first, if that matters.</summary>
    private bool TryOrder(in ContactRow row, double stepLength, out int leader, out int follower)
    {
        leader = row.Second;
        follower = row.First;
        if (row.Second < 0)
        {
            return false;
        }

        var free = row.MinDistance - ContactTolerances.Touch(row.MinDistance, bodies[row.First].Position);
        if ((row.Offset + Displacement(row.First, stepLength)).LengthSquared() < free * free)
        {
            return true;
        }

        leader = row.First;
        follower = row.Second;
        return (row.Offset - Displacement(row.Second, stepLength)).LengthSquared() < free * free;
    }

    private Vector Displacement(int index, double stepLength) =>
        stepLength * (bodies[index].Velocity + (0.5 * stepLength * bodies[index].NetAcceleration));
}
