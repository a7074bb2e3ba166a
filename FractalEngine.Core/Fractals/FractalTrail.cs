using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// The paper's way of showing endless detail (§4.3.2–4.3.4): while the camera is within the radius of the nearest sub-transformation t, m
/// becomes m·t, so that the whole fractal is drawn where its part was; a queue keeps the last few m, and the oldest of them is drawn, so
/// that what lies behind the camera does not vanish at once.
/// </summary>
/// <remarks>
/// Kept beside <see cref="FractalAddress"/>, which loses nothing, to be compared with it. Each call begins at the top again, as in the
/// paper: cost O(depth · maps). World coordinates end at a depth of about 50 for halves.
/// </remarks>
/// <param name="fractal">
/// Its levels give the sub-transformations; identities are passed over, since m·1 would be repeated without end.
/// </param>
/// <param name="length">Of the queue, at least 1: 1 keeps no trail, and 3 draws what is two transformations further out (Figure 9).</param>
public sealed class FractalTrail(Fractal fractal, int length)
{
    /// <summary>Beyond this a double can't tell the parts of a fractal apart.</summary>
    public const int MaxDepth = 1000;

    private readonly Queue<AffineMap> _queue = new();

    /// <summary>Of the queue.</summary>
    public int Length => length;

    /// <summary>How many transformations the camera is within.</summary>
    public int Depth { get; private set; }

    /// <summary>The queue as it stands: the head, which is drawn, first.</summary>
    public IEnumerable<AffineMap> Queue => _queue;

    /// <summary>The matrix that is drawn.</summary>
    /// <param name="placement">The object's own matrix m, which is left as it is.</param>
    /// <param name="cameraPosition">World space.</param>
    public AffineMap Update(AffineMap placement, Vector cameraPosition)
    {
        _queue.Clear();
        for (var i = 0; i < length; i++)
        {
            _queue.Enqueue(placement);
        }

        var map = placement;
        var maxDepth = Math.Min(fractal.LevelCount ?? MaxDepth, MaxDepth);
        for (Depth = 0; Depth < maxDepth && FindClosest(map, fractal.LevelAt(Depth), cameraPosition) is { } closest
            && IsCameraWithinRadius(closest, cameraPosition); Depth++)
        {
            map = closest;
            _queue.Dequeue();
            _queue.Enqueue(map);
        }

        return _queue.Peek();
    }

    /// <summary>
    /// The paper's ClosestMatrix over a set: of all m·t the one whose position is nearest to the camera; null where there is only the
    /// identity.
    /// </summary>
    private static AffineMap? FindClosest(AffineMap map, TransformationSet set, Vector cameraPosition)
    {
        AffineMap? closest = null;
        foreach (var transformation in set.Maps)
        {
            var candidate = map * transformation;
            if (transformation != AffineMap.Identity
                && (closest is null
                || (candidate.Translation - cameraPosition).LengthSquared() < (closest.Value.Translation - cameraPosition).LengthSquared()))
            {
                closest = candidate;
            }
        }

        return closest;
    }

    private bool IsCameraWithinRadius(AffineMap map, Vector cameraPosition) =>
        (map.Translation - cameraPosition).Length() < fractal.BaseMesh.Radius(map);
}
