using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Draws sets of maps of all the sorts that break bounds: moves alone, tiles, rotations, mirrors, uneven and large scales, nearly flat
/// ones, identities, equal maps in other words, and outliers.
/// </summary>
internal static class RandomMapSets
{
    /// <summary>Draws a set.</summary>
    /// <param name="random">The numbers.</param>
    /// <param name="width">Number of maps.</param>
    /// <param name="excluded">What the maps must not have.</param>
    public static TransformationSet Create(Random random, int width, MapTraits excluded = MapTraits.None)
    {
        var maps = random.Draw<Func<Random, int, MapTraits, Transformation[]>>(
            (35, CreateMoves), (10, CreateTiles), (55, CreateMixed))(random, width, excluded);
        Exchange(MapTraits.Outliers, 12, CreateOutlier);
        Exchange(MapTraits.Equal, 8, _ => maps[random.Next(width)]);
        Exchange(MapTraits.Equal, 8, _ => Respell(random, maps[random.Next(width)]));
        Exchange(MapTraits.Identities, 20, _ => Transformation.Identity);
        Exchange(MapTraits.Identities, 5, _ => Respell(random, Transformation.Identity));
        return TransformationSet.Of(maps);

        void Exchange(MapTraits trait, int percent, Func<Transformation, Transformation> replace)
        {
            // A set of an identity alone is rarer than one beside others.
            if (random.Happens(width > 1 ? percent : percent / 4) && (excluded & trait) == 0)
            {
                ref var map = ref maps[random.Next(width)];
                map = replace(map);
            }
        }

        Transformation CreateOutlier(Transformation map)
        {
            var distance = Math.Pow(10, random.Between(6, 14)) * (random.Next(2) == 0 ? 1 : -1);
            return map with
            {
                Position = random.Draw(
                    (2, distance * Vector.I), (1, distance * Vector.J), (1, map.Position + (distance * random.Direction()))),
            };
        }
    }

    /// <summary>Writes a map in other words: what it does to a point differs by rounding at most.</summary>
    public static Transformation Respell(Random random, Transformation map)
    {
        var (position, rotation, scale) = map;
        return random.Next(3) switch
        {
            0 => map with { Rotation = rotation + (360 * random.Draw((1, Vector.I), (1, Vector.J), (1, -Vector.K))) },
            1 => new(position, rotation + (180 * Vector.K), scale.Stretch(new(-1, -1, 1))),
            _ => map with { Rotation = new(rotation.X + 180, 180 - rotation.Y, rotation.Z + 180) },
        };
    }

    /// <summary>Creates moves with one even scale for all, without rotation. Half of them have positions on a grid.</summary>
    private static Transformation[] CreateMoves(Random random, int width, MapTraits excluded)
    {
        var scale = random.Draw((2, 0.6), (2, 0.5), (4, random.Between(0.1, 0.9)));
        var isOnGrid = random.Next(2) == 0;
        // A fifth stays in a plane.
        var size = random.Happens(20) ? new Vector(1, 0, 1) : Vector.One;
        HashSet<Vector> positions = [];
        return CreateEach(width, () =>
        {
            Vector position;
            do
            {
                position = random.Vector(2).Stretch(size);
                position = isOnGrid ? RoundToEighths(position) : position;
            }
            while (!positions.Add(position) && (excluded & MapTraits.Equal) != 0);
            return Transformation.At(position, scale);
        });
    }

    /// <summary>Creates tiles of a square, or of a cube, in any order: neighbours share edges where the base mesh does.</summary>
    private static Transformation[] CreateTiles(Random random, int width, MapTraits excluded)
    {
        var count = random.Next(2, 4);
        var place = 0;
        return CreateEach(width, () =>
        {
            var index = place++;
            return Transformation.At(new Vector(index % count, index / count / count, index / count % count) / count, 1.0 / count);
        });
    }

    private static Transformation[] CreateMixed(Random random, int width, MapTraits excluded) => CreateEach(width, () =>
    {
        var scale = random.Draw(
            (80, CreateScale(random, 0.1, 0.9, excluded)),
            (Weight(10, MapTraits.LargeScales), CreateScale(random, 1, 2.5, excluded)),
            (Weight(5, MapTraits.NearlyFlat), CreateNearlyFlatScale(random)),
            (5, CreateScale(random, 1e-4, 1e-2, excluded)));
        var mirrors = random.Draw(
            (70, Vector.One), (Weight(15, MapTraits.Mirrors), new(-1, 1, 1)), (Weight(5, MapTraits.Mirrors), new(1, 1, -1)),
            (Weight(10, MapTraits.Mirrors), -Vector.One));
        Vector rightAngles = new(90 * random.Next(-2, 3), 90 * random.Next(4), 90 * random.Next(4));
        var rotation = random.Draw((40, Vector.Zero), (45, random.Degrees()), (15, rightAngles));
        return new(random.Vector(2), rotation, scale.Stretch(mirrors));

        int Weight(int weight, MapTraits trait) => (excluded & trait) == 0 ? weight : 0;
    });

    /// <summary>Creates factors, which are the same along all axes in half of all cases.</summary>
    private static Vector CreateScale(Random random, double min, double max, MapTraits excluded)
    {
        var (x, y, z) = (random.Between(min, max), random.Between(min, max), random.Between(min, max));
        return random.Next(2) == 0 || (excluded & MapTraits.UnevenScales) != 0 ? x * Vector.One : new(x, y, z);
    }

    private static Vector CreateNearlyFlatScale(Random random)
    {
        var thin = Math.Pow(10, -random.Next(3, 13));
        var (wide, other) = (random.Between(0.3, 0.8), random.Happens(30) ? thin : random.Between(0.3, 0.8));
        return random.Draw<Vector>((1, new(thin, wide, other)), (1, new(other, thin, wide)), (1, new(wide, other, thin)));
    }

    private static Transformation[] CreateEach(int width, Func<Transformation> create) =>
        [.. Enumerable.Range(0, width).Select(_ => create())];

    private static Vector RoundToEighths(Vector v) => new Vector(Math.Round(8 * v.X), Math.Round(8 * v.Y), Math.Round(8 * v.Z)) / 8;
}
