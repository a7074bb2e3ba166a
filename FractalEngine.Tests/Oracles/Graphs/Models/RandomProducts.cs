using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>Draws sets of maps: similar, mirrored, skewed and nearly flat ones, identities, powers, ranges and products.</summary>
internal sealed class RandomProducts
{
    private const double FlatScale = 1e-3;
    private readonly Random _random;
    private readonly bool _isForImages;
    private readonly bool _hasEmptySets;
    private readonly ImmutableArray<MapLeaf> _leaves;

    public RandomProducts(Random random, GraphOptions options)
    {
        _random = random;
        _isForImages = options.IsForImages;
        _hasEmptySets = options is { HasEmptySets: true, IsForImages: false };
        // Few, so that sets share some of them.
        _leaves = [.. Enumerable.Range(0, random.Next(2, 7)).Select(_ => CreateLeaf())];
    }

    /// <summary>Draws a set, which is empty in rare cases.</summary>
    public ImmutableArray<MapProduct> CreateSet(int minCount)
    {
        var count = Math.Max(minCount, _random.Draw((40, 1), (35, 2), (20, 3), (4, 5), (_hasEmptySets ? 1 : 0, 0)));
        return [.. Enumerable.Range(0, count).Select(_ => CreateProduct())];
    }

    private MapProduct CreateProduct() => _random.Draw<Func<MapProduct>>(
        (14, () => new([new(new MapLeaf.Identity())])),
        (60, () => new([new(DrawLeaf())])),
        (14, () => new([CreatePower()])),
        (12, () => new([.. Enumerable.Range(0, _random.Next(2, 4)).Select(_ => CreateFactor())])))();

    private MapPower CreateFactor() => _random.Next(3) == 0 ? CreatePower() : new(DrawThickLeaf());

    private MapPower CreatePower()
    {
        if (_random.Next(2) == 0)
        {
            var exponent = _random.Draw((1, -2), (2, -1), (1, 0), (3, 2), (2, 3), (1, 5));
            return new(DrawThickLeaf(), exponent, exponent);
        }

        var low = _random.Draw((6, 0), (1, 1), (1, -1), (1, -2));
        return new(DrawThickLeaf(), low, low + _random.Next(0, 4));
    }

    private MapLeaf DrawLeaf() => _leaves[_random.Next(_leaves.Length)];

    // Products and inverses of what is nearly flat have no inverse in doubles.
    private MapLeaf DrawThickLeaf()
    {
        var thick = _leaves.Where(static leaf => leaf is not MapLeaf.Placement { Scale.Y: FlatScale }).ToArray();
        return thick.Length == 0 ? CreateSkewed() : thick[_random.Next(thick.Length)];
    }

    private MapLeaf CreateLeaf() => _random.Happens(20)
        ? CreateSkewed()
        : new MapLeaf.Placement(CreatePosition(), CreateAngles(), CreateScale());

    private Vector? CreatePosition() => _random.Draw<Vector?>(
        (18, null),
        (60, Round(_random.Vector(2), 2)),
        (18, _random.Vector(2)),
        (_isForImages ? 0 : 3, Round(Math.Pow(10, _random.Next(1, 6)) * _random.Direction(), 1)));

    private Vector? CreateAngles() => _random.Draw<Vector?>(
        (35, null),
        (15, 90.0 * new Vector(_random.Next(-2, 3), _random.Next(-2, 3), _random.Next(-2, 3))),
        (20, new(0, 15 * _random.Next(-11, 12), 0)),
        (20, Round(_random.Degrees(), 0)),
        (10, _random.Degrees()));

    private Vector? CreateScale()
    {
        var factor = Math.Round(_random.Between(_isForImages ? 0.5 : 0.25, 0.95), 2);
        var others = Round(new(_random.Between(0.4, 1.1), _random.Between(0.4, 1.1), _random.Between(0.4, 1.1)), 2);
        var signs = new Vector(_random.Next(2), _random.Next(2), _random.Next(2));
        return _random.Draw<Vector?>(
            (25, null),
            (40, factor * Vector.One),
            (12, others),
            (12, factor * (Vector.One - (2 * signs))),
            (6, others.Stretch(Vector.One - (2 * signs))),
            (_isForImages ? 0 : 5, Math.Round(_random.Between(1.05, 1.6), 2) * Vector.One),
            (_isForImages ? 0 : 1, new(1, FlatScale, 0.7)));
    }

    /// <summary>Creates a map that stretches a rotated frame, so that right angles are lost.</summary>
    private MapLeaf.Columns CreateSkewed()
    {
        var size = _random.Between(0.5, 1);
        while (true)
        {
            var (x, y, z) = (Round(size * _random.Vector(), 2), Round(size * _random.Vector(), 2), Round(size * _random.Vector(), 2));
            var volume = Math.Abs(Vector.Dot(x, Vector.Cross(y, z)));
            if (volume > 0.15 * x.Length() * y.Length() * z.Length() && volume > (_isForImages ? 0.1 : 0.02))
            {
                return new(x, y, z, CreatePosition() ?? Vector.Zero);
            }
        }
    }

    private static Vector Round(Vector v, int digits) => new(Math.Round(v.X, digits), Math.Round(v.Y, digits), Math.Round(v.Z, digits));
}
