using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Distances;

/// <summary>
/// A convex piece of a face. The distance from a convex set, such as a face of the other surface, is a convex function. So its maximum over
/// the piece is at a corner, and bounds the largest distance of the piece from the other surface.
/// </summary>
/// <param name="Corners">In order around the piece, at least three.</param>
internal readonly record struct SurfacePiece(Vector[] Corners)
{
    // Smaller parts beyond the edge of a face, as a part of what the bounds are apart, are not cut off: slivers would be left.
    private const double MinOverlap = 0.05;

    /// <summary>The mean of the corners, which is a point of the piece.</summary>
    public Vector Centre => Vector.Mean(Corners);

    /// <summary>Computes an upper bound of the distance of all points by one face of the other surface.</summary>
    public double UpperBound(TargetSurface target, int face)
    {
        var maxDistance = 0.0;
        foreach (var corner in Corners)
        {
            maxDistance = Math.Max(maxDistance, target.DistanceToFace(corner, face));
        }

        return maxDistance;
    }

    /// <summary>Computes an upper bound of the distance of all points by one of them.</summary>
    public double UpperBound(in SurfacePoint point)
    {
        var maxSquared = 0.0;
        foreach (var corner in Corners)
        {
            maxSquared = Math.Max(maxSquared, (corner - point.Position).LengthSquared());
        }

        return point.Distance + Math.Sqrt(maxSquared);
    }

    /// <summary>
    /// Divides the piece along the edges of a face, as they are seen from its front. So coplanar faces cover a piece after a few divisions.
    /// A piece that extends beyond no edge is halved.
    /// </summary>
    /// <param name="target">The other surface.</param>
    /// <param name="face">Its face closest to the centre.</param>
    /// <param name="gap">What the bounds of the piece are apart.</param>
    /// <returns>The parts. They are one where the piece is too small to be divided.</returns>
    public List<SurfacePiece> Divide(TargetSurface target, int face, double gap)
    {
        List<SurfacePiece> parts = [];
        var rest = this;
        var (a, b, c) = target.Face(face);
        var normal = target.Normal(face);
        foreach (var (start, end) in (ReadOnlySpan<(Vector, Vector)>)[(a, b), (b, c), (c, a)])
        {
            rest = rest.CutOff(start, Vector.Cross(end - start, normal), MinOverlap * gap, parts);
        }

        if (parts.Count == 0)
        {
            var (start, end) = LongestEdge();
            rest = CutOff(0.5 * (start + end), end - start, 0, parts);
        }

        parts.Add(rest);
        return parts;
    }

    /// <summary>Splits the piece along a plane.</summary>
    /// <param name="heights">Of each corner above the plane.</param>
    /// <returns>What is above the plane, and what is not.</returns>
    public (SurfacePiece Front, SurfacePiece Back) Split(double[] heights)
    {
        List<Vector> front = [];
        List<Vector> back = [];
        for (var i = 0; i < heights.Length; i++)
        {
            var next = (i + 1) % heights.Length;
            (heights[i] > 0 ? front : back).Add(Corners[i]);
            if (heights[i] > 0 != heights[next] > 0)
            {
                // Always from below, so that an edge of two faces is cut at one position.
                var (from, to) = heights[i] > 0 ? (next, i) : (i, next);
                var crossing = Corners[from] + (heights[from] / (heights[from] - heights[to]) * (Corners[to] - Corners[from]));
                front.Add(crossing);
                back.Add(crossing);
            }
        }

        return (new([.. front]), new([.. back]));
    }

    /// <summary>Cuts off what is in front of a plane.</summary>
    /// <param name="origin">A point of the plane.</param>
    /// <param name="normal">Of any length. Zero cuts nothing.</param>
    /// <param name="minOverlap">The piece is cut where it extends farther than this on both sides.</param>
    /// <param name="parts">Receives what is in front, if the piece is cut.</param>
    /// <returns>The rest.</returns>
    private SurfacePiece CutOff(Vector origin, Vector normal, double minOverlap, List<SurfacePiece> parts)
    {
        var length = normal.Length();
        double[] heights = [.. Corners.Select(corner => Vector.Dot(corner - origin, normal) / length)];
        // False for NaN.
        if (!(heights.Max() > minOverlap && -heights.Min() > minOverlap))
        {
            return this;
        }

        var (front, back) = Split(heights);
        parts.Add(front);
        return back;
    }

    private (Vector Start, Vector End) LongestEdge()
    {
        var longest = (Corners[^1], Corners[0]);
        for (var i = 1; i < Corners.Length; i++)
        {
            if ((Corners[i] - Corners[i - 1]).LengthSquared() > (longest.Item2 - longest.Item1).LengthSquared())
            {
                longest = (Corners[i - 1], Corners[i]);
            }
        }

        return longest;
    }
}
