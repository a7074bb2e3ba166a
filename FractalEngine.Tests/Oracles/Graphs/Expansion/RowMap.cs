using FractalEngine.Core.Maths;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Graphs.Expansion;

/// <summary>An affine map as three rows of four numbers, with arithmetic of its own.</summary>
internal sealed class RowMap
{
    private readonly double[] _entries;

    private RowMap(params double[] entries) => _entries = entries;

    public static RowMap Identity { get; } = new(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);

    /// <summary>Image of the origin.</summary>
    public Vector Translation => new(_entries[3], _entries[7], _entries[11]);

    /// <summary>By how much the map scales volumes; negative for a mirror.</summary>
    public double Determinant =>
        (_entries[0] * Cofactor(0, 0)) + (_entries[1] * Cofactor(0, 1)) + (_entries[2] * Cofactor(0, 2));

    /// <summary>Makes the map of a leaf: position + pitch · yaw · roll · scale, with the matrices of the manual by rows.</summary>
    public static RowMap Of(MapLeaf leaf) => leaf switch
    {
        MapLeaf.Placement placement => Place(
            placement.Position ?? Vector.Zero, placement.Rotation ?? Vector.Zero, placement.Scale ?? Vector.One),
        MapLeaf.Columns(var x, var y, var z, var origin) => new(
            x.X, y.X, z.X, origin.X, x.Y, y.Y, z.Y, origin.Y, x.Z, y.Z, z.Z, origin.Z),
        _ => Identity,
    };

    /// <summary>Makes all maps of a product: for each choice of exponents, the first factor outermost.</summary>
    public static IEnumerable<RowMap> AllOf(MapProduct product) => product.Factors.Aggregate(
        (IEnumerable<RowMap>)[Identity],
        static (maps, factor) => [.. maps.SelectMany(map => Powers(factor).Select(map.After))]);

    /// <summary>Composes two maps; the argument is applied first.</summary>
    public RowMap After(RowMap first)
    {
        var product = new double[12];
        for (var row = 0; row < 12; row += 4)
        {
            for (var column = 0; column < 4; column++)
            {
                var sum = column == 3 ? _entries[row + 3] : 0;
                for (var k = 0; k < 3; k++)
                {
                    sum += _entries[row + k] * first._entries[(4 * k) + column];
                }

                product[row + column] = sum;
            }
        }

        return new(product);
    }

    public Vector Apply(Vector v) => Linear(v) + Translation;

    /// <summary>Maps a normal as planes are mapped, by cofactors: its direction is right under every map, its length is not kept.</summary>
    public Vector ApplyToNormal(Vector n) => new(
        (Cofactor(0, 0) * n.X) + (Cofactor(0, 1) * n.Y) + (Cofactor(0, 2) * n.Z),
        (Cofactor(1, 0) * n.X) + (Cofactor(1, 1) * n.Y) + (Cofactor(1, 2) * n.Z),
        (Cofactor(2, 0) * n.X) + (Cofactor(2, 1) * n.Y) + (Cofactor(2, 2) * n.Z));

    /// <summary>Computes the inverse by cofactors.</summary>
    public RowMap Inverse()
    {
        var determinant = Determinant;
        var linear = new double[12];
        for (var i = 0; i < 9; i++)
        {
            linear[(4 * (i / 3)) + (i % 3)] = Cofactor(i % 3, i / 3) / determinant;
        }

        RowMap inverse = new(linear);
        var translation = -inverse.Linear(Translation);
        (linear[3], linear[7], linear[11]) = (translation.X, translation.Y, translation.Z);
        return inverse;
    }

    /// <summary>Makes the same map of the library.</summary>
    public AffineMap ToAffineMap() => new(
        new(
            new(_entries[0], _entries[4], _entries[8]), new(_entries[1], _entries[5], _entries[9]),
            new(_entries[2], _entries[6], _entries[10])),
        Translation);

    private static IEnumerable<RowMap> Powers(MapPower factor)
    {
        for (var exponent = factor.Low; exponent <= factor.High; exponent++)
        {
            var step = exponent < 0 ? Of(factor.Leaf).Inverse() : Of(factor.Leaf);
            yield return Enumerable.Repeat(step, Math.Abs(exponent)).Aggregate(Identity, static (map, next) => map.After(next));
        }
    }

    private static RowMap Place(Vector position, Vector degrees, Vector scale)
    {
        var (sx, cx) = Math.SinCos(degrees.X * Math.PI / 180);
        var (sy, cy) = Math.SinCos(degrees.Y * Math.PI / 180);
        var (sz, cz) = Math.SinCos(degrees.Z * Math.PI / 180);
        RowMap move = new(1, 0, 0, position.X, 0, 1, 0, position.Y, 0, 0, 1, position.Z);
        RowMap pitch = new(1, 0, 0, 0, 0, cx, sx, 0, 0, -sx, cx, 0);
        RowMap yaw = new(cy, 0, -sy, 0, 0, 1, 0, 0, sy, 0, cy, 0);
        RowMap roll = new(cz, sz, 0, 0, -sz, cz, 0, 0, 0, 0, 1, 0);
        RowMap stretch = new(scale.X, 0, 0, 0, 0, scale.Y, 0, 0, 0, 0, scale.Z, 0);
        return move.After(pitch.After(yaw.After(roll.After(stretch))));
    }

    private Vector Linear(Vector v) => new(
        (_entries[0] * v.X) + (_entries[1] * v.Y) + (_entries[2] * v.Z),
        (_entries[4] * v.X) + (_entries[5] * v.Y) + (_entries[6] * v.Z),
        (_entries[8] * v.X) + (_entries[9] * v.Y) + (_entries[10] * v.Z));

    private double Cofactor(int row, int column)
    {
        var (r1, r2) = (4 * ((row + 1) % 3), 4 * ((row + 2) % 3));
        var (c1, c2) = ((column + 1) % 3, (column + 2) % 3);
        return (_entries[r1 + c1] * _entries[r2 + c2]) - (_entries[r1 + c2] * _entries[r2 + c1]);
    }
}
