using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// A ball and a box around the part of a fractal below each of its outermost levels, in that part's own frame. Built from the
/// inside out in one pass that ends early where further levels change nothing.
/// </summary>
internal sealed class LevelBounds
{
    // Deeper levels are never looked at one by one: each halving of the scale uses up one of a double's 53 bits, so that
    // a search ends long before.
    private const int KeptLevels = 4096;
    private const int LimitRounds = 100_000;

    // Maps of a round that are also looked at as a whole.
    private const int ComposedMaps = 256;

    private static readonly Bound Unknown = new(
        new(Vector.Zero, double.PositiveInfinity),
        new(double.NegativeInfinity * Vector.One, double.PositiveInfinity * Vector.One));

    private readonly Bound[] _levels;

    private LevelBounds(Bound[] levels, bool areExact) => (_levels, AreExact) = (levels, areExact);

    /// <summary>True when the boxes are exact: all maps send axes to axes.</summary>
    public bool AreExact { get; }

    /// <summary>
    /// Around what stands below the sets of the levels before <paramref name="level"/>; 0 is the whole fractal. Below the
    /// levels that are kept nothing is known, and the bounds are infinite.
    /// </summary>
    public Bound At(long level) => level < _levels.Length ? _levels[level] : Unknown;

    /// <summary>The bounds of a fractal in affine composition. Cost: one step a map and level, until the bounds settle.</summary>
    public static LevelBounds Of(Fractal fractal)
    {
        var below = Bound.Of(fractal.BaseMesh);
        var (exact, complete) = (true, true);
        var kept = new List<Bound> { below };
        foreach (var step in fractal.Description.Steps.Reverse())
        {
            var body = step is Repetition repetition ? repetition : new([step], 1);
            var rounds = body.Count ?? LimitRounds;
            var settled = false;
            var composed = ComposedRound(body);
            for (var round = 0; round < rounds; round++)
            {
                var before = below;
                for (var level = body.LevelsPerRound - 1; level >= 0; level--)
                {
                    var set = body.LevelAt(level);
                    exact &= set.Maps.All(map => SendsAxesToAxes(map.Linear));
                    below = below.Under(set.Maps.AsSpan());
                    kept.Add(below);
                }

                if (composed.Length > 0)
                {
                    // Turned boxes and stretched balls grow from set to set, where the maps of a whole round may shrink.
                    below = kept[^1] = Bound.Smaller(below, before.Under(composed));
                }

                if (!below.IsFinite())
                {
                    // Beyond a double: all that is known of the levels above is that they are no smaller.
                    return new([Unknown], false);
                }

                if (IsSettled(before, below))
                {
                    // The rounds left have the same bounds, so only as many of them are listed as are ever looked at.
                    settled = true;
                    var left = (rounds - round - 1) * body.LevelsPerRound;
                    complete &= left <= KeptLevels;
                    for (var more = Math.Min(left, KeptLevels); more > 0; more--)
                    {
                        kept.Add(kept[^(int)body.LevelsPerRound]);
                    }

                    break;
                }

                if (kept.Count > (4 * KeptLevels) + body.LevelsPerRound)
                {
                    kept.RemoveRange(0, kept.Count - KeptLevels);
                    complete = false;
                }
            }

            if (body.Count is null && !settled)
            {
                // The maps don't shrink, or by so little that there is no limit within reach.
                below = Unknown;
                kept.Add(below);
            }
        }

        kept.Reverse();
        return new(complete ? [.. kept] : [.. kept.Take(KeptLevels)], exact);
    }

    /// <summary>All maps of a round of several sets; none where boxes of each set are exact, or where there are too many.</summary>
    private static AffineMap[] ComposedRound(Repetition body)
    {
        if (body.LevelsPerRound == 1)
        {
            return [];
        }

        AffineMap[] maps = [AffineMap.Identity];
        var exact = true;
        for (var level = 0L; level < body.LevelsPerRound; level++)
        {
            var set = body.LevelAt(level).Maps;
            if ((long)maps.Length * set.Length > ComposedMaps)
            {
                return [];
            }

            exact &= set.All(map => SendsAxesToAxes(map.Linear));
            maps = [.. from outer in maps from inner in set select outer * inner];
        }

        return exact ? [] : maps;
    }

    private static bool IsSettled(Bound before, Bound now) => Math.Max(
        Math.Abs(before.Sphere.Radius - now.Sphere.Radius),
        Math.Max(
            (before.Box.Minimum - now.Box.Minimum).MaximumComponent(),
            (before.Box.Maximum - now.Box.Maximum).MaximumComponent())) <= 1e-15 * now.Box.Size.MaximumComponent();

    private static bool SendsAxesToAxes(Matrix linear) =>
        IsAlongAnAxis(linear.V1) && IsAlongAnAxis(linear.V2) && IsAlongAnAxis(linear.V3);

    private static bool IsAlongAnAxis(Vector v) => (v.X != 0 ? 1 : 0) + (v.Y != 0 ? 1 : 0) + (v.Z != 0 ? 1 : 0) <= 1;

    /// <summary>A ball and a box around the same thing.</summary>
    internal readonly record struct Bound(BoundingSphere Sphere, BoundingBox Box)
    {
        /// <summary>False beyond the range of a double.</summary>
        public bool IsFinite() => Box.Size.IsFinite() && Box.Minimum.IsFinite();

        public static Bound Of(Mesh mesh)
        {
            var (centre, radius) = (mesh.Bounds.Centre, 0.0);
            for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
            {
                radius = Math.Max(radius, (mesh.Vertex(vertex) - centre).Length());
            }

            return new(new(centre, radius), mesh.Bounds);
        }

        /// <summary>Around the copies that maps make of what this is around.</summary>
        public Bound Under(ReadOnlySpan<AffineMap> maps)
        {
            var (box, ballBox) = (BoundingBox.Empty, BoundingBox.Empty);
            foreach (var map in maps)
            {
                box = BoundingBox.Union(box, Box.Transform(map));
                var ball = Sphere.Transform(map);
                ballBox = ballBox.Including(ball.Centre - (ball.Radius * Vector.One)).Including(ball.Centre + (ball.Radius * Vector.One));
            }

            box = new(Vector.Max(box.Minimum, ballBox.Minimum), Vector.Min(box.Maximum, ballBox.Maximum));
            var radius = 0.0;
            foreach (var map in maps)
            {
                var ball = Sphere.Transform(map);
                radius = Math.Max(radius, (ball.Centre - box.Centre).Length() + ball.Radius);
            }

            return new(new(box.Centre, radius), box);
        }

        /// <summary>Around the same thing as both are.</summary>
        public static Bound Smaller(in Bound bound1, in Bound bound2) => new(
            bound1.Sphere.Radius <= bound2.Sphere.Radius ? bound1.Sphere : bound2.Sphere,
            new(Vector.Max(bound1.Box.Minimum, bound2.Box.Minimum), Vector.Min(bound1.Box.Maximum, bound2.Box.Maximum)));

        /// <summary>An upper bound of <c>Dot(direction, v)</c> over the image of what this is around.</summary>
        public double Farthest(AffineMap map, Vector direction)
        {
            if (double.IsPositiveInfinity(Sphere.Radius))
            {
                return double.PositiveInfinity;
            }

            var local = map.Linear.Transpose() * direction;
            var ball = Vector.Dot(local, Sphere.Centre) + (local.Length() * Sphere.Radius);
            var box = Vector.Dot(local, Box.Centre) + (0.5 * Vector.Dot(local.Absolute(), Box.Size));
            return Math.Min(ball, box) + Vector.Dot(direction, map.Translation);
        }
    }
}
