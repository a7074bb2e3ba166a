using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>Clips the ears of a polygon in the plane, one after the other. One instance is reused for many polygons.</summary>
/// <remarks>
/// A corner is an ear if it is convex and no reflex corner lies in its triangle. The test of a corner goes through the reflex corners in
/// order and stops at the first that blocks it. It goes on from there once that one is no longer reflex: reflex corners only become
/// fewer, so those before can't block it later. A corner is tested afresh only when one of its neighbours was clipped. This bounds all
/// tests together by O(n·r).
/// </remarks>
internal sealed class EarClipper
{
    private const int Unblocked = -1;

    // Tests that are repeated for corners at one place, a corner of the polygon: enough unless very many lie at one place.
    private const int MaxRepeatedTestsPerCorner = 8;

    private int _count;
    private int[] _previous = [];
    private int[] _next = [];
    private readonly CornerSet _untested = new();
    private readonly CornerSet _flat = new();
    private readonly ReflexCorners _reflex = new();

    // The reflex corner that blocks a corner, and the reflex corner from which the next test of the corner begins.
    private int[] _blockers = [];
    private int[] _testStarts = [];

    // The corners at one place form a ring.
    private int[] _twins = [];
    private int[] _byPlace = [];
    private long _repeatedTestsLeft;
    private (double X, double Y)[] _points = [];

    /// <summary>Cuts a polygon into triangles.</summary>
    /// <param name="points">Corners, more than three; anticlockwise where the x axis points right and the y axis up.</param>
    /// <param name="triangles">Receives indices of corners, three a triangle, in the order of the corners.</param>
    public void Clip(List<(double X, double Y)> points, List<int> triangles)
    {
        Prepare(points);
        var corner = 0;
        for (var remaining = _count; remaining > 3; remaining--)
        {
            corner = FindEar(corner);
            var (previous, next) = (_previous[corner], _next[corner]);
            triangles.AddRange([previous, corner, next]);
            Remove(corner, previous, next);
            // Continuing two corners later spreads the ears and avoids long thin fans.
            corner = _next[next];
        }

        triangles.AddRange([_previous[corner], corner, _next[corner]]);
    }

    /// <summary>Computes twice the signed area of a triangle, positive when it is anticlockwise.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static double TwiceSignedArea((double X, double Y) a, (double X, double Y) b, (double X, double Y) c) =>
        ((b.X - a.X) * (c.Y - a.Y)) - ((b.Y - a.Y) * (c.X - a.X));

    private void Prepare(List<(double X, double Y)> points)
    {
        _count = points.Count;
        if (_points.Length < _count)
        {
            _points = new (double X, double Y)[_count];
            _previous = new int[_count];
            _next = new int[_count];
            _blockers = new int[_count];
            _testStarts = new int[_count];
            _twins = new int[_count];
            _byPlace = new int[_count];
        }

        points.CopyTo(_points);
        _untested.Reset(_count);
        _flat.Reset(_count);
        for (var i = 0; i < _count; i++)
        {
            _previous[i] = i == 0 ? _count - 1 : i - 1;
            _next[i] = i == _count - 1 ? 0 : i + 1;
        }

        for (var i = 0; i < _count; i++)
        {
            RepeatTest(i);
        }

        _reflex.Collect(_points.AsSpan(0, _count), this);
        LinkTwins();
        _repeatedTestsLeft = (long)MaxRepeatedTestsPerCorner * _count;
    }

    /// <summary>Tells whether a corner turns inwards or goes straight on: only such corners can reach into an ear.</summary>
    /// <remarks>Clipping ears makes no other corner reflex.</remarks>
    internal bool IsReflex(int corner) => TwiceSignedAreaAt(corner) <= 0;

    private double TwiceSignedAreaAt(int corner) =>
        TwiceSignedArea(_points[_previous[corner]], _points[corner], _points[_next[corner]]);

    private void LinkTwins()
    {
        var order = _byPlace.AsSpan(0, _count);
        for (var i = 0; i < _count; i++)
        {
            order[i] = i;
        }

        var points = _points;
        order.Sort((a, b) => points[a].CompareTo(points[b]));
        for (var start = 0; start < order.Length;)
        {
            var end = start + 1;
            while (end < order.Length && points[order[end]] == points[order[start]])
            {
                end++;
            }

            for (var i = start; i < end; i++)
            {
                _twins[order[i]] = order[i + 1 < end ? i + 1 : start];
            }

            start = end;
        }
    }

    /// <summary>
    /// Finds the next ear from a corner on. Where there is none, which only happens where the polygon touches or crosses itself, it is
    /// a corner whose triangle has no area, and otherwise that corner itself.
    /// </summary>
    private int FindEar(int start)
    {
        for (var corner = _untested.FindFrom(start); corner >= 0; corner = _untested.FindFrom(corner))
        {
            if (IsEar(corner))
            {
                return corner;
            }

            _untested.Set(corner, false);
        }

        return _flat.FindFrom(start) is >= 0 and var flat ? flat : start;
    }

    /// <summary>Tests whether a convex corner is an ear, and notes what blocks it.</summary>
    private bool IsEar(int corner)
    {
        var (a, b, c) = (_points[_previous[corner]], _points[corner], _points[_next[corner]]);
        for (var position = _reflex.PositionOf(_testStarts[corner]); ; position++)
        {
            position = _reflex.FindInside(a, b, c, position);
            if (position < 0)
            {
                return true;
            }

            var other = _reflex[position];
            if (Blocks(other, a, b, c))
            {
                _blockers[corner] = other;
                _testStarts[corner] = other;
                return false;
            }
        }
    }

    /// <summary>Tells whether a reflex corner in a triangle blocks it. One at a corner of it does so if its edges lead inside.</summary>
    private bool Blocks(int other, (double X, double Y) a, (double X, double Y) b, (double X, double Y) c)
    {
        var point = _points[other];
        return point == a ? LeadsBetween(other, b, c)
            : point == b ? LeadsBetween(other, c, a)
            : point != c || LeadsBetween(other, a, b);
    }

    private bool LeadsBetween(int corner, (double X, double Y) right, (double X, double Y) left)
    {
        var point = _points[corner];
        return IsBetween(_points[_next[corner]]) || IsBetween(_points[_previous[corner]]);

        bool IsBetween((double X, double Y) target) =>
            TwiceSignedArea(point, right, target) > 0 && TwiceSignedArea(point, target, left) > 0;
    }

    /// <summary>Takes a corner out of the polygon.</summary>
    private void Remove(int corner, int previous, int next)
    {
        _next[previous] = next;
        _previous[next] = previous;
        _untested.Set(corner, false);
        _flat.Set(corner, false);
        EndReflex(corner);
        foreach (var neighbour in (ReadOnlySpan<int>)[previous, next])
        {
            RepeatTest(neighbour);
            if (!IsReflex(neighbour))
            {
                EndReflex(neighbour);
            }

            RepeatTestsAt(neighbour);
        }
    }

    /// <summary>Removes a corner from the reflex ones; corners that it blocked are tested on.</summary>
    private void EndReflex(int corner)
    {
        if (!_reflex.Remove(corner))
        {
            return;
        }

        var blockers = _blockers.AsSpan(0, _count);
        for (var start = 0; blockers[start..].IndexOf(corner) is >= 0 and var offset; start += offset + 1)
        {
            blockers[start + offset] = Unblocked;
            _untested.Set(start + offset, true);
        }
    }

    /// <summary>Lets the corners at the same place, and their neighbours, be tested again after a change of an edge there.</summary>
    private void RepeatTestsAt(int corner)
    {
        for (var twin = _twins[corner]; twin != corner && _repeatedTestsLeft > 0; twin = _twins[twin])
        {
            // Corners that are clipped already remain in the ring.
            _repeatedTestsLeft--;
            if (_next[_previous[twin]] == twin && _previous[_next[twin]] == twin)
            {
                RepeatTest(twin);
                RepeatTest(_previous[twin]);
                RepeatTest(_next[twin]);
            }
        }
    }

    /// <summary>Notes that a corner is to be tested, or that its triangle has no area. Nothing is known to block it.</summary>
    private void RepeatTest(int corner)
    {
        _blockers[corner] = Unblocked;
        _testStarts[corner] = 0;
        var area = TwiceSignedAreaAt(corner);
        _untested.Set(corner, !(area <= 0));
        _flat.Set(corner, area == 0);
    }
}
