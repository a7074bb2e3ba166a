using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo;

/// <summary>A factor of a product of maps: one transformation, or the maps that a matrix, a power or a product makes.</summary>
internal readonly record struct MapFactor
{
    private readonly AffineMap[]? _maps;
    private readonly MapColour[]? _colours;

    /// <summary>Makes the factor of a call.</summary>
    /// <param name="transformation">The transformation.</param>
    /// <param name="colour">What it mixes into colours.</param>
    public MapFactor(Transformation transformation, MapColour colour = default)
    {
        Transformation = transformation;
        _colours = colour.IsNone ? null : [colour];
    }

    /// <summary>Makes the factor of maps that are no transformations.</summary>
    /// <param name="maps">The maps.</param>
    /// <param name="colours">What each mixes into colours; null for nothing.</param>
    public MapFactor(AffineMap[] maps, MapColour[]? colours = null) => (_maps, _colours) = (maps, colours);

    /// <summary>True where a map has a colour.</summary>
    public bool HasColours => _colours is not null;

    /// <summary>The transformation; null where there are other maps.</summary>
    public Transformation? Transformation { get; }

    /// <summary>Number of maps, 1 for a transformation.</summary>
    public int Count => _maps?.Length ?? 1;

    /// <summary>The maps, in their order.</summary>
    public AffineMap[] Maps => _maps ?? [Transformation!.Value.ToAffineMap()];

    /// <summary>What a map mixes into colours.</summary>
    public MapColour ColourOf(int map) => _colours is null ? default : _colours[map];

    /// <summary>Makes all products with the maps of another factor, which are applied first.</summary>
    public MapFactor Times(in MapFactor other)
    {
        var others = other.Maps;
        var inner = other;
        return new(
            [.. Maps.SelectMany(map => others, static (map, inner) => map * inner)],
            HasColours || other.HasColours
                ? [.. Enumerable.Range(0, Count).Select(ColourOf).SelectMany(
                    colour => Enumerable.Range(0, inner.Count).Select(index => colour.Over(inner.ColourOf(index))))]
                : null);
    }

    /// <summary>
    /// Makes a range of powers, from the smallest: each is the one nearer to the identity, times the map or its inverse. What comes back to
    /// the identity, to rounding, is the identity, so that further turns are the same maps again.
    /// </summary>
    /// <param name="from">The smallest exponent.</param>
    /// <param name="to">The largest exponent.</param>
    public MapFactor ToPowers(int from, int to)
    {
        var map = Maps[0];
        var powers = new AffineMap[to - from + 1];
        var nearest = Math.Clamp(0, from, to);
        powers[nearest - from] = map.Power(nearest);
        var turn = new FullTurn();
        for (var exponent = nearest + 1; exponent <= to; exponent++)
        {
            powers[exponent - from] = turn.Close(powers[exponent - from - 1] * map);
        }

        var inverse = from < nearest ? map.Inverse() : map;
        turn = new();
        for (var exponent = nearest - 1; exponent >= from; exponent--)
        {
            powers[exponent - from] = turn.Close(powers[exponent - from + 1] * inverse);
        }

        return new(powers, HasColours ? ColourPowers(from, to) : null);
    }

    /// <summary>The colours of powers that are not negative: as often mixed in.</summary>
    private MapColour[] ColourPowers(int from, int to)
    {
        var colours = new MapColour[to - from + 1];
        var colour = default(MapColour);
        for (var exponent = 0; exponent <= to; exponent++)
        {
            if (exponent >= from)
            {
                colours[exponent - from] = colour;
            }

            colour = colour.Over(ColourOf(0));
        }

        return colours;
    }

    /// <summary>Recognises powers that have come back to the identity, compared with how far the ones before were from it.</summary>
    private struct FullTurn
    {
        // Roundings of a product, of which few add up.
        private const double UnitsPerProduct = 8 * 2.220446049250313e-16;

        private int _count;
        private double _farthestLinear;
        private double _farthestTranslation;

        public AffineMap Close(in AffineMap power)
        {
            var linear = (power.Linear + (-1 * Matrix.Identity)).MaxAbsEntry();
            var translation = power.Translation.MaxAbsComponent();
            var tolerance = UnitsPerProduct * ++_count;
            if (linear <= tolerance * _farthestLinear && translation <= tolerance * _farthestTranslation)
            {
                (_count, _farthestLinear, _farthestTranslation) = (0, 0, 0);
                return AffineMap.Identity;
            }

            _farthestLinear = Math.Max(_farthestLinear, linear);
            _farthestTranslation = Math.Max(_farthestTranslation, translation);
            return power;
        }
    }
}
