using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>The maps of a set together with what a search needs of them, kept once however many levels have the set.</summary>
internal sealed class MapSet
{
    private const double Rounding = 1e-15;

    /// <summary>For a set.</summary>
    public MapSet(TransformationSet set)
        : this([.. set.Maps])
    {
    }

    /// <summary>For maps.</summary>
    public MapSet(AffineMap[] maps)
    {
        Maps = maps;
        Inverses = [.. Maps.Select(map => map.Inverse())];
        ScalesSquared = [.. Maps.Select(map => map.Linear.V1.LengthSquared())];
        IdentityIndex = Array.IndexOf(Maps, AffineMap.Identity);
        OperatorNormBounds = [.. Maps.Select(map => BoundingSphere.OperatorNormBound(map.Linear) * (1 + Rounding))];
        AreSimilarities = Maps.All(map => Similarity.IsSimilarity(map.Linear));
    }

    /// <summary>The set of the identity alone.</summary>
    public static MapSet Identity { get; } = new([AffineMap.Identity]);

    /// <summary>In the order of the set.</summary>
    public AffineMap[] Maps { get; }

    /// <summary>Of the maps.</summary>
    public AffineMap[] Inverses { get; }

    /// <summary>Squares of the factors by which the maps lengthen, where they are similarities.</summary>
    public double[] ScalesSquared { get; }

    /// <summary>At most by these factors do the maps lengthen anything.</summary>
    public double[] OperatorNormBounds { get; }

    /// <summary>The first place of the identity in the set, or −1.</summary>
    public int IdentityIndex { get; }

    /// <summary>True when all maps are multiples of rotations and mirrors.</summary>
    public bool AreSimilarities { get; }

    /// <summary>Bytes of the arrays.</summary>
    public long StorageBytes => Maps.Length * 26 * sizeof(double);
}
