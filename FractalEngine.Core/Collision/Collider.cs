using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Finds the point of a shape nearest to a position (paper §4.4.2–4.4.3). Immutable: any number of threads may ask at once, each with a
/// record of its own. Queries allocate nothing.
/// </summary>
public abstract class Collider
{
    /// <summary>False for colliders that may miss the nearest point.</summary>
    public abstract bool IsExact { get; }

    /// <summary>Bytes that the collider keeps beside the mesh or the fractal it was made from.</summary>
    public abstract long StorageBytes { get; }

    /// <summary>Finds the nearest point.</summary>
    /// <param name="position">In the shape's frame, scene units, finite.</param>
    /// <param name="maxDistance">Nothing farther away is looked at; may be infinite.</param>
    /// <param name="context">Receives the costs and the instance.</param>
    /// <param name="closest">The answer, if there is one.</param>
    /// <param name="epsilon">
    /// How much farther than the nearest the answer may be: at most by the factor 1 + ε. Colliders that are not faster for it answer
    /// exactly.
    /// </param>
    /// <returns>False when nothing lies within the distance.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite, or the distance or ε is negative or NaN.</exception>
    public bool TryFindClosest(Vector position, double maxDistance, QueryContext context, out ClosestPoint closest, double epsilon = 0)
    {
        ThrowIfInvalid(position, maxDistance, epsilon);
        return FindClosestCore(position, maxDistance, epsilon, context, out closest);
    }

    /// <summary>True when <see cref="FindClosestTransformed"/> works.</summary>
    internal virtual bool SupportsTransformedQueries => false;

    /// <summary>Finds the nearest point of the shape's image under any map, which costs more than in the shape's own frame.</summary>
    /// <param name="position">In the frame of the image, finite.</param>
    /// <param name="map">From the shape's frame to that of the image; not singular.</param>
    /// <param name="maxDistance">As in <see cref="TryFindClosest"/>.</param>
    /// <param name="epsilon">As in <see cref="TryFindClosest"/>.</param>
    /// <param name="context">Receives the costs and the instance.</param>
    /// <param name="closest">The answer in the frame of the image, if there is one.</param>
    internal virtual bool FindClosestTransformed(Vector position, AffineMap map, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest) =>
        throw new NotSupportedException($"{GetType().Name} finds points in the shape's own frame only");

    /// <summary>
    /// True when a search that found nothing must be repeated without ε: measured against the limit itself, ε leaves out what is a little
    /// nearer.
    /// </summary>
    private protected static bool NeedsExactRetry(double maxDistance, double epsilon) => epsilon > 0 && double.IsFinite(maxDistance);

    /// <summary>Throws when a query's arguments are not allowed.</summary>
    internal static void ThrowIfInvalid(Vector position, double maxDistance, double epsilon)
    {
        if (!position.IsFinite())
        {
            throw new ArgumentOutOfRangeException(nameof(position), position, "expected finite coordinates");
        }

        if (!(maxDistance >= 0))
        {
            throw new ArgumentOutOfRangeException(nameof(maxDistance), maxDistance, "expected no negative number");
        }

        if (!(epsilon >= 0))
        {
            throw new ArgumentOutOfRangeException(nameof(epsilon), epsilon, "expected no negative number");
        }
    }

    /// <summary>The query itself, its arguments checked.</summary>
    private protected abstract bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest);
}
