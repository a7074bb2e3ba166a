using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>
/// The intersection of a few half-spaces n·x ≥ b, onto which points are projected. Where several surfaces are touched, a velocity must
/// satisfy all of them at once: one after the other, a body would creep in a groove.
/// </summary>
/// <remarks>
/// The closest point lies on at most three of the planes, so all sets of up to three are tried. That is exact, and faster than any
/// iteration for so few planes.
/// </remarks>
internal sealed class HalfSpaces
{
    /// <summary>Maximum number of half-spaces.</summary>
    public const int Capacity = 8;

    // Relative to the largest number involved: by how much rounding may violate a plane.
    private const double RelativeTolerance = 1e-13;

    // Sine of the angle, or volume of the normals, below which planes count as parallel.
    private const double ParallelTolerance = 1e-9;

    private readonly Vector[] _normals = new Vector[Capacity];
    private readonly double[] _offsets = new double[Capacity];

    /// <summary>Number of half-spaces at present.</summary>
    public int Count { get; private set; }

    /// <summary>Removes all half-spaces, so that every point is allowed.</summary>
    public void Clear() => Count = 0;

    /// <summary>Adds a half-space; when there is no room, it replaces the first one.</summary>
    /// <param name="normal">Unit vector n that points into the half-space.</param>
    /// <param name="offset">The b of n·x ≥ b.</param>
    public void Add(Vector normal, double offset)
    {
        var index = Count < Capacity ? Count++ : 0;
        _normals[index] = normal;
        _offsets[index] = offset;
    }

    /// <summary>Finds the point of the intersection that is closest to a target.</summary>
    /// <param name="target">Any finite point.</param>
    /// <param name="closest">The closest point, or the target where there is none.</param>
    /// <returns>False when no point satisfies all half-spaces.</returns>
    public bool TryProject(Vector target, out Vector closest)
    {
        closest = target;
        if (Satisfies(target, target))
        {
            return true;
        }

        var minDistanceSquared = double.PositiveInfinity;
        for (var i = 0; i < Count; i++)
        {
            UpdateIfCloser(ProjectOntoPlane(target, i), target, ref minDistanceSquared, ref closest);
            for (var j = i + 1; j < Count; j++)
            {
                if (!TryProjectOntoLine(target, i, j, out var onLine))
                {
                    continue;
                }

                UpdateIfCloser(onLine, target, ref minDistanceSquared, ref closest);
                for (var k = j + 1; k < Count; k++)
                {
                    if (TryIntersect(i, j, k, out var corner))
                    {
                        UpdateIfCloser(corner, target, ref minDistanceSquared, ref closest);
                    }
                }
            }
        }

        return minDistanceSquared < double.PositiveInfinity;
    }

    /// <summary>Projects a vector onto the intersection; the zero vector where that is empty.</summary>
    public Vector ProjectOrZero(Vector vector) => TryProject(vector, out var projected) ? projected : Vector.Zero;

    private void UpdateIfCloser(Vector candidate, Vector target, ref double minDistanceSquared, ref Vector closest)
    {
        var distanceSquared = (candidate - target).LengthSquared();
        if (distanceSquared < minDistanceSquared && Satisfies(candidate, target))
        {
            minDistanceSquared = distanceSquared;
            closest = candidate;
        }
    }

    private bool Satisfies(Vector point, Vector target)
    {
        var magnitude = Math.Max(point.MaxAbsComponent(), target.MaxAbsComponent());
        for (var i = 0; i < Count; i++)
        {
            if (!(Vector.Dot(_normals[i], point) >= _offsets[i] - (RelativeTolerance * Math.Max(magnitude, Math.Abs(_offsets[i])))))
            {
                return false;
            }
        }

        return true;
    }

    private Vector ProjectOntoPlane(Vector target, int i) => target + ((_offsets[i] - Vector.Dot(_normals[i], target)) * _normals[i]);

    /// <summary>Projects a point onto the line in which two planes meet.</summary>
    /// <returns>False for parallel planes.</returns>
    private bool TryProjectOntoLine(Vector target, int i, int j, out Vector point)
    {
        var n1 = _normals[i];
        var n2 = _normals[j];
        var cosine = Vector.Dot(n1, n2);
        var sineSquared = Vector.Cross(n1, n2).LengthSquared();
        var d1 = _offsets[i] - Vector.Dot(n1, target);
        var d2 = _offsets[j] - Vector.Dot(n2, target);
        point = target + ((((d1 - (cosine * d2)) * n1) + ((d2 - (cosine * d1)) * n2)) / sineSquared);
        return sineSquared > ParallelTolerance * ParallelTolerance;
    }

    /// <summary>Finds the point in which three planes meet.</summary>
    /// <returns>False where two of them are parallel, or all three are parallel to one line.</returns>
    private bool TryIntersect(int i, int j, int k, out Vector point)
    {
        var (n1, n2, n3) = (_normals[i], _normals[j], _normals[k]);
        var (c1, c2, c3) = (Vector.Cross(n2, n3), Vector.Cross(n3, n1), Vector.Cross(n1, n2));
        var volume = Vector.Dot(n1, c1);
        point = ((_offsets[i] * c1) + (_offsets[j] * c2) + (_offsets[k] * c3)) / volume;
        return Math.Abs(volume) > ParallelTolerance;
    }
}
