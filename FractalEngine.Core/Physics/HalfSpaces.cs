using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// The points x with n·x ≥ b for each of a few planes, and the nearest of them to a given point. Where several surfaces are touched,
/// velocities and places must satisfy all of them at once: one after the other would creep in a groove.
/// </summary>
/// <remarks>
/// The nearest point lies on at most three of the planes, so all sets of up to three are tried: exact, and with few planes faster than any
/// iteration.
/// </remarks>
internal sealed class HalfSpaces
{
    /// <summary>At most so many planes.</summary>
    public const int Capacity = 8;

    // Of the size of the numbers: what rounding may violate a plane by.
    private const double RelativeTolerance = 1e-13;

    // Planes whose normals span less are taken for parallel.
    private const double ParallelTolerance = 1e-9;

    private readonly Vector[] _normals = new Vector[Capacity];
    private readonly double[] _offsets = new double[Capacity];

    /// <summary>How many planes there are.</summary>
    public int Count { get; private set; }

    /// <summary>Takes all planes away.</summary>
    public void Clear() => Count = 0;

    /// <summary>Adds a plane; when there is no room, in the place of the first.</summary>
    /// <param name="normal">Of length 1.</param>
    /// <param name="offset">The b of n·x ≥ b.</param>
    public void Add(Vector normal, double offset)
    {
        var index = Count < Capacity ? Count++ : 0;
        (_normals[index], _offsets[index]) = (normal, offset);
    }

    /// <summary>Finds the nearest point that satisfies all planes.</summary>
    /// <param name="target">Any point.</param>
    /// <param name="closest">The answer, or the target where there is none.</param>
    /// <returns>False when no point satisfies all.</returns>
    public bool TryProject(Vector target, out Vector closest)
    {
        closest = target;
        if (Satisfies(target, target))
        {
            return true;
        }

        var (bestDistanceSquared, bestPoint) = (double.PositiveInfinity, target);
        for (var i = 0; i < Count; i++)
        {
            UpdateIfCloser(ProjectOntoPlane(target, i), target, ref bestDistanceSquared, ref bestPoint);
            for (var j = i + 1; j < Count; j++)
            {
                if (!TryProjectOntoLine(target, i, j, out var onLine))
                {
                    continue;
                }

                UpdateIfCloser(onLine, target, ref bestDistanceSquared, ref bestPoint);
                for (var k = j + 1; k < Count; k++)
                {
                    if (TryIntersect(i, j, k, out var corner))
                    {
                        UpdateIfCloser(corner, target, ref bestDistanceSquared, ref bestPoint);
                    }
                }
            }
        }

        closest = bestPoint;
        return bestDistanceSquared < double.PositiveInfinity;
    }

    private void UpdateIfCloser(Vector candidate, Vector target, ref double bestDistanceSquared, ref Vector bestPoint)
    {
        var distanceSquared = (candidate - target).LengthSquared();
        if (distanceSquared < bestDistanceSquared && Satisfies(candidate, target))
        {
            (bestDistanceSquared, bestPoint) = (distanceSquared, candidate);
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

    /// <summary>The nearest point of the line where two planes meet.</summary>
    private bool TryProjectOntoLine(Vector target, int i, int j, out Vector point)
    {
        var (n1, n2) = (_normals[i], _normals[j]);
        var cosine = Vector.Dot(n1, n2);
        var sineSquared = Vector.Cross(n1, n2).LengthSquared();
        var (d1, d2) = (_offsets[i] - Vector.Dot(n1, target), _offsets[j] - Vector.Dot(n2, target));
        point = target + ((((d1 - (cosine * d2)) * n1) + ((d2 - (cosine * d1)) * n2)) / sineSquared);
        return sineSquared > ParallelTolerance * ParallelTolerance;
    }

    /// <summary>The point where three planes meet.</summary>
    private bool TryIntersect(int i, int j, int k, out Vector point)
    {
        var (n1, n2, n3) = (_normals[i], _normals[j], _normals[k]);
        var (c1, c2, c3) = (Vector.Cross(n2, n3), Vector.Cross(n3, n1), Vector.Cross(n1, n2));
        var volume = Vector.Dot(n1, c1);
        point = ((_offsets[i] * c1) + (_offsets[j] * c2) + (_offsets[k] * c3)) / volume;
        return Math.Abs(volume) > ParallelTolerance;
    }
}
