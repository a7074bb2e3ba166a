using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo;

/// <summary>A factor of a product of maps: one transformation, or the maps that a matrix, a power or a product makes.</summary>
internal readonly record struct MapFactor
{
    private readonly AffineMap[]? _maps;

    /// <summary>Makes the factor of a call.</summary>
    public MapFactor(Transformation transformation) => Transformation = transformation;

    /// <summary>Makes the factor of maps that are no transformations.</summary>
    public MapFactor(AffineMap[] maps) => _maps = maps;

    /// <summary>The transformation; null where there are other maps.</summary>
    public Transformation? Transformation { get; }

    /// <summary>Number of maps, 1 for a transformation.</summary>
    public int Count => _maps?.Length ?? 1;

    /// <summary>The maps, in their order.</summary>
    public AffineMap[] Maps => _maps ?? [Transformation!.Value.ToAffineMap()];

    /// <summary>Makes all products with the maps of another factor, which are applied first.</summary>
    public MapFactor Times(in MapFactor other)
    {
        var others = other.Maps;
        return new([.. Maps.SelectMany(map => others, static (map, inner) => map * inner)]);
    }

    /// <summary>Makes a range of powers, from the smallest: each is the one nearer to the identity, times the map or its inverse.</summary>
    /// <param name="from">The smallest exponent.</param>
    /// <param name="to">The largest exponent.</param>
    public MapFactor ToPowers(int from, int to)
    {
        var map = Maps[0];
        var powers = new AffineMap[to - from + 1];
        var nearest = Math.Clamp(0, from, to);
        powers[nearest - from] = map.Power(nearest);
        for (var exponent = nearest + 1; exponent <= to; exponent++)
        {
            powers[exponent - from] = powers[exponent - from - 1] * map;
        }

        var inverse = from < nearest ? map.Inverse() : map;
        for (var exponent = nearest - 1; exponent >= from; exponent--)
        {
            powers[exponent - from] = powers[exponent - from + 1] * inverse;
        }

        return new(powers);
    }
}
