using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// The paper's method of showing endless detail (§4.3.2–4.3.4): while the camera is within the radius of the closest sub-transformation t,
/// the matrix m becomes m·t.
/// </summary>
/// <remarks>
/// So the whole fractal is drawn in place of its sub-fractal. A queue, the trail, keeps the last few m, and the oldest of them is drawn:
/// what lies behind the camera does not vanish at once. The class exists for comparison with <c>FractalAddress</c>, which loses no
/// precision. Each call starts at the whole fractal again, as in the paper: cost O(depth · maps). World coordinates end at a depth of about
/// 50 for halves.
/// </remarks>
/// <param name="fractal">
/// Fractal whose levels give the sub-transformations; identities are skipped, since m·1 would be repeated without end.
/// </param>
/// <param name="length">
/// Length of the trail, at least 1: 1 keeps no trail, and 3 draws what is two transformations further out (Figure 9).
/// </param>
/// <exception cref="ArgumentOutOfRangeException">The length is less than 1.</exception>
public sealed class FractalTrail(Fractal fractal, int length)
{
    /// <summary>Maximum depth; beyond it a double can't tell the sub-fractals apart.</summary>
    public const int MaxDepth = 1000;

    private readonly Queue<AffineMap> _queue = new();

    /// <summary>Length of the trail.</summary>
    public int Length { get; } = length >= 1
        ? length
        : throw new ArgumentOutOfRangeException(nameof(length), length, "expected a trail of at least one matrix");

    /// <summary>Number of transformations whose radius the camera is within.</summary>
    public int Depth { get; private set; }

    /// <summary>The matrices of the trail: first the head, which is drawn.</summary>
    public IEnumerable<AffineMap> Queue => _queue;

    /// <summary>Follows the camera, and computes the matrix to draw with.</summary>
    /// <param name="placement">The object's own matrix m, which stays unchanged.</param>
    /// <param name="cameraPosition">Camera position, world space.</param>
    /// <returns>The oldest matrix of the trail.</returns>
    public AffineMap Update(AffineMap placement, Vector cameraPosition)
    {
        _queue.Clear();
        for (var i = 0; i < Length; i++)
        {
            _queue.Enqueue(placement);
        }

        var map = placement;
        var maxDepth = Math.Min(fractal.LevelCount ?? MaxDepth, MaxDepth);
        for (Depth = 0; Depth < maxDepth; Depth++)
        {
            if (FindClosest(map, fractal.LevelAt(Depth), cameraPosition) is not { } closest
                || !IsCameraWithinRadius(closest, cameraPosition))
            {
                break;
            }

            map = closest;
            _queue.Dequeue();
            _queue.Enqueue(map);
        }

        return _queue.Peek();
    }

    /// <summary>Finds the m·t of a set whose position is closest to the camera: the paper's ClosestMatrix.</summary>
    /// <returns>Null where the set has only identities.</returns>
    private static AffineMap? FindClosest(AffineMap map, TransformationSet set, Vector cameraPosition)
    {
        AffineMap? closest = null;
        foreach (var transformation in set.Maps)
        {
            var candidate = map * transformation;
            var distanceSquared = (candidate.Translation - cameraPosition).LengthSquared();
            if (transformation != AffineMap.Identity
                && (closest is null || distanceSquared < (closest.Value.Translation - cameraPosition).LengthSquared()))
            {
                closest = candidate;
            }
        }

        return closest;
    }

    private bool IsCameraWithinRadius(AffineMap map, Vector cameraPosition) =>
        (map.Translation - cameraPosition).Length() < fractal.BaseMesh.Radius(map);
}
