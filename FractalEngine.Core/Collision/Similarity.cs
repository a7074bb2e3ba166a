using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>A map that keeps all distances in proportion: a rotation or mirror, a uniform scale, a translation.</summary>
/// <param name="Map">From the local frame to the world's.</param>
/// <param name="Inverse">Back.</param>
/// <param name="Scale">World distances divided by local ones, positive.</param>
internal sealed record Similarity(AffineMap Map, AffineMap Inverse, double Scale)
{
    // Of the squared scale: what rotations by double arithmetic miss.
    private const double Tolerance = 1e-13;

    public static Similarity Identity { get; } = new(AffineMap.Identity, AffineMap.Identity, 1);

    /// <summary>True for the linear parts of similarities.</summary>
    public static bool IsSimilarity(Matrix m)
    {
        var scaleSquared = m.V1.LengthSquared();
        var tolerance = Tolerance * scaleSquared;
        return Math.Abs(m.V2.LengthSquared() - scaleSquared) <= tolerance && Math.Abs(m.V3.LengthSquared() - scaleSquared) <= tolerance
            && Math.Abs(Vector.Dot(m.V1, m.V2)) <= tolerance && Math.Abs(Vector.Dot(m.V1, m.V3)) <= tolerance
            && Math.Abs(Vector.Dot(m.V2, m.V3)) <= tolerance;
    }

    /// <summary>False for maps that do not keep distances in proportion.</summary>
    public static bool TryCreate(AffineMap map, out Similarity similarity)
    {
        var isSimilarity = IsSimilarity(map.Linear);
        similarity = isSimilarity ? new(map, map.Inverse(), map.Linear.V1.Length()) : Identity;
        return isSimilarity;
    }

    /// <summary>A position of the world in the local frame.</summary>
    public Vector ToLocal(Vector position) => ReferenceEquals(this, Identity) ? position : Inverse * position;

    /// <summary>
    /// An answer found in the local frame, in the world. The normal goes with the cofactors, as the product of two edges does: by the
    /// winding of the face's image, which a mirror turns.
    /// </summary>
    public ClosestPoint ToWorld(ClosestPoint local)
    {
        if (ReferenceEquals(this, Identity))
        {
            return local;
        }

        return local with
        {
            Point = Map * local.Point,
            Distance = Scale * local.Distance,
            Normal = (Map.Linear.Cofactors() * local.Normal).UnitVector(),
        };
    }
}
