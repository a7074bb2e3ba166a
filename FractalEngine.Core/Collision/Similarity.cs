using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>A map that keeps all distances in proportion: a rotation or mirror, a uniform scale and a translation.</summary>
/// <param name="Map">From the local frame to world space.</param>
/// <param name="Inverse">From world space to the local frame.</param>
/// <param name="Scale">Distances in world space divided by those in the local frame, positive.</param>
internal sealed record Similarity(AffineMap Map, AffineMap Inverse, double Scale)
{
    // As a part of the squared scale: more than the rounding error of rotations.
    private const double Tolerance = 1e-13;

    // Beyond these, the matrix's determinant and cofactors leave the range of a double.
    private const double MinScaleSquared = 1e-180;
    private const double MaxScaleSquared = 1e180;

    // Found once, since they cost as much as a short search.
    private readonly Matrix _cofactors = Map.Linear.Cofactors();

    /// <summary>The similarity whose frames are the same.</summary>
    public static Similarity Identity { get; } = new(AffineMap.Identity, AffineMap.Identity, 1);

    /// <summary>Tells whether a matrix is the linear part of a similarity.</summary>
    public static bool IsSimilarity(Matrix m)
    {
        var scaleSquared = m.V1.LengthSquared();
        var tolerance = Tolerance * scaleSquared;
        return Math.Abs(m.V2.LengthSquared() - scaleSquared) <= tolerance && Math.Abs(m.V3.LengthSquared() - scaleSquared) <= tolerance
            && Math.Abs(Vector.Dot(m.V1, m.V2)) <= tolerance && Math.Abs(Vector.Dot(m.V1, m.V3)) <= tolerance
            && Math.Abs(Vector.Dot(m.V2, m.V3)) <= tolerance;
    }

    /// <summary>Creates a similarity from a map.</summary>
    /// <param name="map">From the local frame to world space.</param>
    /// <param name="similarity">The similarity; the identity if the map is none.</param>
    /// <returns>False for maps that do not keep distances in proportion.</returns>
    public static bool TryCreate(AffineMap map, out Similarity similarity)
    {
        var isSimilarity = map.Linear.V1.LengthSquared() is > MinScaleSquared and < MaxScaleSquared && IsSimilarity(map.Linear);
        similarity = isSimilarity ? new(map, map.Inverse(), map.Linear.V1.Length()) : Identity;
        return isSimilarity;
    }

    /// <summary>Maps a position from world space to the local frame.</summary>
    public Vector ToLocal(Vector position) => ReferenceEquals(this, Identity) ? position : Inverse * position;

    /// <summary>Maps a query result from the local frame to world space.</summary>
    /// <remarks>
    /// The normal transforms by the cofactors, like the cross product of two edges. So it follows the winding of the mapped triangle, which
    /// a mirror reverses.
    /// </remarks>
    public ClosestPoint ToWorld(ClosestPoint local) => ReferenceEquals(this, Identity) ? local : local with
    {
        Point = Map * local.Point,
        Distance = Scale * local.Distance,
        Normal = (_cofactors * local.Normal).UnitVector(),
        ErrorBound = (Scale * local.ErrorBound) + (RoundingErrors.Coordinate * Map.Translation.MaxAbsComponent()),
    };
}
