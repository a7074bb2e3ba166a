using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.SceneQueries;

/// <summary>A map that keeps all distances in proportion: a rotation or mirror, a uniform scale and a translation.</summary>
/// <param name="map">From the local frame to world space.</param>
/// <param name="scale">Distances in world space divided by those in the local frame, positive.</param>
internal sealed class Similarity(AffineMap map, double scale)
{
    // Beyond these, the matrix's determinant and cofactors leave the range of a double.
    private const double MinScaleSquared = 1e-180;
    private const double MaxScaleSquared = 1e180;

    private static readonly Similarity Unmoved = new(AffineMap.Identity, 1);

    // Found at the first use, since they cost as much as a short search: twice at worst, with the same result. Most objects of large
    // scenes are never near a query, and these would be more than the map.
    private QueryTerms? _terms;

    /// <summary>The similarity whose frames are the same; its answers are those of the local frame to the bit.</summary>
    public static Similarity Identity { get; } = new(AffineMap.Identity, 1);

    /// <summary>From the local frame to world space.</summary>
    public AffineMap Map { get; } = map;

    /// <summary>Distances in world space divided by those in the local frame, positive.</summary>
    public double Scale { get; } = scale;

    private QueryTerms Terms => _terms ??= new(Map.Inverse(), Map.Linear.Cofactors());

    /// <summary>Creates a similarity from a map.</summary>
    /// <param name="map">From the local frame to world space.</param>
    /// <param name="similarity">The similarity; the identity if the map is none.</param>
    /// <returns>False for maps that do not keep distances in proportion.</returns>
    public static bool TryCreate(AffineMap map, out Similarity similarity)
    {
        var isSimilarity = map.Linear.V1.LengthSquared() is > MinScaleSquared and < MaxScaleSquared && map.Linear.IsSimilarity();
        similarity = !isSimilarity ? Identity
            // Shared, since many objects of large scenes stand where they were made.
            : map == AffineMap.Identity ? Unmoved
            : new(map, map.Linear.V1.Length());
        return isSimilarity;
    }

    /// <summary>Maps a position from world space to the local frame.</summary>
    public Vector ToLocal(Vector position) => ReferenceEquals(this, Identity) ? position : Terms.Inverse * position;

    /// <summary>Maps a query result from the local frame to world space.</summary>
    /// <remarks>
    /// The normal transforms by the cofactors, like the cross product of two edges. So it follows the winding of the mapped triangle, which
    /// a mirror reverses.
    /// </remarks>
    public ClosestPoint ToWorld(ClosestPoint local) => ReferenceEquals(this, Identity) ? local : local with
    {
        Point = Map * local.Point,
        Distance = Scale * local.Distance,
        Normal = (Terms.Cofactors * local.Normal).UnitVector(),
        ErrorBound = (Scale * local.ErrorBound) + (RoundingErrors.Coordinate * Map.Translation.MaxAbsComponent()),
    };

    private sealed record QueryTerms(AffineMap Inverse, Matrix Cofactors);
}
