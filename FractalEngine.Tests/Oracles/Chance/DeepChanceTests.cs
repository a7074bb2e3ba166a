using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
using FractalEngine.Parsing;
using FractalEngine.Tests.Support;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Fractals by chance of 10²⁰ parts and more, against a search that knows nothing but the rule of the manual.</summary>
public sealed class DeepChanceTests : IDisposable
{
    private const int Seed = 11;

    private readonly TemporaryFolder _folder = new();

    /// <inheritdoc/>
    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Points_OfDust_AreTheClosest(bool isByLevel) => Check(
        "a. ((-1, -0.5, 0.3), (0, 20, 0), (0.5)) colour (1, 0, 0) 0.1\nb. ((1, -0.5, -0.2), (0, 0, 30), (0.5))\n"
        + "c. ((0, 1, 0), (10, 0, 0), (0.5))\nz<box>. 3: [a., b., c.] box | 2: [a., c.] box | 1: [c.] box + [b.] box\n<$>. z 60",
        [new(-1, -0.5, 0.3), new(1, -0.5, -0.2), new(0, 1, 0)], [new(0, 20, 0), new(0, 0, 30), new(10, 0, 0)],
        [(3, [0, 1, 2]), (2, [0, 2]), (1, [2, 1])], 60, 1e-11,
        // All lies within three units around it.
        static (offset, scale) => offset.Length() - (3 * scale), isByLevel);

    [Fact]
    public void Points_OfASpongeThatEndsBySize_AreTheClosest()
    {
        Vector[] corners = [.. Enumerable.Range(0, 8).Select(static i =>
            new Vector((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, (i >> 2) - 0.5) * 0.5)];
        var names = string.Concat(corners.Select(static (v, i) => FormattableString.Invariant(
            $"m{i}. (({v.X}, {v.Y}, {v.Z}), #, (0.5))\n")));
        const string set = "m0., m1., m2., m3., m4., m5., m6., m7.";
        // √3 · 2⁻²² is the last size that is large enough.
        Check(
            $"{names}z<box>. 5: [{set}] box | 2: [m0., m3., m5., m6.] box\n<$>. z until 0.0000004",
            corners, [.. corners.Select(static _ => Vector.Zero)],
            [(5, [0, 1, 2, 3, 4, 5, 6, 7]), (2, [0, 3, 5, 6])], 23, 4e-7,
            // All lies in the unit cube.
            static (offset, scale) => Vector.Max(offset.Absolute() - (0.5 * scale * Vector.One), Vector.Zero).Length());
    }

    private void Check(
        string text, Vector[] positions, Vector[] rotations,
        ImmutableArray<(double Weight, int[] Maps)> choice, int depth, double tolerance,
        Func<Vector, double, double> boundOf, bool isByLevel = false)
    {
        var fractal = FractalFile.Read(_folder.Write("a.fdo", $"seed {Seed}{(isByLevel ? " by level" : "")}\n{text}\n"));
        Assert.True(fractal.CountRange(0)!.Value.Most > BigInteger.Pow(10, 19));
        AffineMap[] maps = [.. positions.Zip(rotations, static (position, rotation) =>
            new Transformation(position, rotation, 0.5 * Vector.One).ToAffineMap())];
        var collider = new ExactFractalCollider(fractal);
        var caster = RayCaster.For(fractal);
        var random = new Random(1);
        for (var i = 0; i < 100; i++)
        {
            var position = 4 * new Vector(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5);
            Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, out var found));
            Near.Equal(DistanceTo(position), found.Distance, tolerance);
            Assert.InRange(DistanceTo(found.Point), 0, tolerance);
            var from = 4 * position.UnitVector();
            if (caster.TryFindNearest(new(from, -from), out var hit))
            {
                Assert.InRange(DistanceTo(hit.Point), 0, tolerance);
            }
        }

        // Goes first into what may be closest.
        double DistanceTo(Vector position)
        {
            var open = new PriorityQueue<(AffineMap Map, ChanceWay Way, int Level), double>();
            open.Enqueue((AffineMap.Identity, default, 0), 0);
            while (open.TryDequeue(out var place, out var bound))
            {
                if (place.Level == depth)
                {
                    return bound;
                }

                var way = isByLevel ? default(ChanceWay).To(place.Level + 1).To(1) : place.Way;
                var chosen = way.Choose(choice.Select(static one => one.Weight), Seed);
                foreach (var (i, map) in choice[chosen].Maps.Index())
                {
                    var child = place.Map * maps[map];
                    open.Enqueue(
                        (child, place.Way.To(chosen + 1).To(1).To(i + 1), place.Level + 1),
                        Math.Max(0, boundOf(position - child.Translation, Math.ScaleB(1, -place.Level - 1))));
                }
            }

            return double.PositiveInfinity;
        }
    }
}
