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
    private const int MaxKeptLevels = 4096;
    private const int MaxRounds = 100_000;

    // Maps of a round that are also looked at as a whole.
    private const int MaxComposedMaps = 256;

    private static readonly BoundingVolume Unbounded = new(
        new(Vector.Zero, double.PositiveInfinity),
        new(double.NegativeInfinity * Vector.One, double.PositiveInfinity * Vector.One));

    private readonly BoundingVolume[] _levels;

    private LevelBounds(BoundingVolume[] levels, bool hasExactBoxes) => (_levels, HasExactBoxes) = (levels, hasExactBoxes);

    /// <summary>True when the boxes are exact: all maps send axes to axes.</summary>
    public bool HasExactBoxes { get; }

    /// <summary>
    /// Around what stands below the sets of the levels before <paramref name="level"/>; 0 is the whole fractal. Below the
    /// levels that are kept nothing is known, and the bounds are infinite.
    /// </summary>
    public BoundingVolume At(long level) => level < _levels.Length ? _levels[level] : Unbounded;

    /// <summary>The bounds of a fractal in affine composition. Cost: one step a map and level, until the bounds settle.</summary>
    public static LevelBounds Compute(Fractal fractal)
    {
        var volume = BoundingVolume.FromMesh(fractal.BaseMesh);
        var (isExact, isComplete) = (true, true);
        var kept = new List<BoundingVolume> { volume };
        foreach (var step in fractal.Description.Steps.Reverse())
        {
            var body = step is Repetition repetition ? repetition : new([step], 1);
            var rounds = body.Count ?? MaxRounds;
            var isConverged = false;
            var composedMaps = ComposeRound(body);
            for (var round = 0; round < rounds; round++)
            {
                var previous = volume;
                for (var level = body.LevelsPerRound - 1; level >= 0; level--)
                {
                    var set = body.LevelAt(level);
                    isExact &= set.Maps.All(map => KeepsBoxesAxisAligned(map.Linear));
                    volume = volume.UnionOfTransformed(set.Maps.AsSpan());
                    kept.Add(volume);
                }

                if (composedMaps.Length > 0)
                {
                    // Turned boxes and stretched balls grow from set to set, where the maps of a whole round may shrink.
                    volume = kept[^1] = BoundingVolume.Tighter(volume, previous.UnionOfTransformed(composedMaps));
                }

                if (!volume.IsFinite())
                {
                    // Beyond a double: all that is known of the levels above is that they are no smaller.
                    return new([Unbounded], false);
                }

                if (HasConverged(previous, volume))
                {
                    // The rounds left have the same bounds, so only as many of them are listed as are ever looked at.
                    isConverged = true;
                    var remainingLevels = (rounds - round - 1) * body.LevelsPerRound;
                    isComplete &= remainingLevels <= MaxKeptLevels;
                    for (var copied = Math.Min(remainingLevels, MaxKeptLevels); copied > 0; copied--)
                    {
                        kept.Add(kept[^(int)body.LevelsPerRound]);
                    }

                    break;
                }

                if (kept.Count > (4 * MaxKeptLevels) + body.LevelsPerRound)
                {
                    kept.RemoveRange(0, kept.Count - MaxKeptLevels);
                    isComplete = false;
                }
            }

            if (body.Count is null && !isConverged)
            {
                // The maps don't shrink, or by so little that there is no limit within reach.
                volume = Unbounded;
                kept.Add(volume);
            }
        }

        kept.Reverse();
        return new(isComplete ? [.. kept] : [.. kept.Take(MaxKeptLevels)], isExact);
    }

    /// <summary>All maps of a round of several sets; none where boxes of each set are exact, or where there are too many.</summary>
    private static AffineMap[] ComposeRound(Repetition body)
    {
        if (body.LevelsPerRound == 1)
        {
            return [];
        }

        AffineMap[] maps = [AffineMap.Identity];
        var isExact = true;
        for (var level = 0L; level < body.LevelsPerRound; level++)
        {
            var set = body.LevelAt(level).Maps;
            if ((long)maps.Length * set.Length > MaxComposedMaps)
            {
                return [];
            }

            isExact &= set.All(map => KeepsBoxesAxisAligned(map.Linear));
            maps = [.. from outer in maps from inner in set select outer * inner];
        }

        return isExact ? [] : maps;
    }

    private static bool HasConverged(BoundingVolume previous, BoundingVolume current) => Math.Max(
        Math.Abs(previous.Sphere.Radius - current.Sphere.Radius),
        Math.Max(
            (previous.Box.Minimum - current.Box.Minimum).MaxAbsComponent(),
            (previous.Box.Maximum - current.Box.Maximum).MaxAbsComponent())) <= 1e-15 * current.Box.Size.MaxAbsComponent();

    private static bool KeepsBoxesAxisAligned(Matrix linear) =>
        HasAtMostOneNonzero(linear.V1) && HasAtMostOneNonzero(linear.V2) && HasAtMostOneNonzero(linear.V3);

    private static bool HasAtMostOneNonzero(Vector v) => (v.X != 0 ? 1 : 0) + (v.Y != 0 ? 1 : 0) + (v.Z != 0 ? 1 : 0) <= 1;

    /// <summary>A ball and a box around the same thing.</summary>
    internal readonly record struct BoundingVolume(BoundingSphere Sphere, BoundingBox Box)
    {
        /// <summary>False beyond the range of a double.</summary>
        public bool IsFinite() => Box.Size.IsFinite() && Box.Minimum.IsFinite();

        public static BoundingVolume FromMesh(Mesh mesh)
        {
            var (centre, radius) = (mesh.Bounds.Centre, 0.0);
            for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
            {
                radius = Math.Max(radius, (mesh.Vertex(vertex) - centre).Length());
            }

            return new(new(centre, radius), mesh.Bounds);
        }

        /// <summary>Around the copies that maps make of what this is around.</summary>
        public BoundingVolume UnionOfTransformed(ReadOnlySpan<AffineMap> maps)
        {
            var (box, sphereBox) = (BoundingBox.Empty, BoundingBox.Empty);
            foreach (var map in maps)
            {
                box = BoundingBox.Union(box, Box.Transform(map));
                var sphere = Sphere.Transform(map);
                sphereBox = sphereBox.Including(sphere.Centre - (sphere.Radius * Vector.One))
                    .Including(sphere.Centre + (sphere.Radius * Vector.One));
            }

            box = new(Vector.Max(box.Minimum, sphereBox.Minimum), Vector.Min(box.Maximum, sphereBox.Maximum));
            var radius = 0.0;
            foreach (var map in maps)
            {
                var sphere = Sphere.Transform(map);
                radius = Math.Max(radius, (sphere.Centre - box.Centre).Length() + sphere.Radius);
            }

            return new(new(box.Centre, radius), box);
        }

        /// <summary>Around the same thing as both are.</summary>
        public static BoundingVolume Tighter(in BoundingVolume volume1, in BoundingVolume volume2) => new(
            volume1.Sphere.Radius <= volume2.Sphere.Radius ? volume1.Sphere : volume2.Sphere,
            new(Vector.Max(volume1.Box.Minimum, volume2.Box.Minimum), Vector.Min(volume1.Box.Maximum, volume2.Box.Maximum)));

        /// <summary>An upper bound of <c>Dot(direction, v)</c> over the image of what this is around.</summary>
        public double SupportBound(AffineMap map, Vector direction)
        {
            if (double.IsPositiveInfinity(Sphere.Radius))
            {
                return double.PositiveInfinity;
            }

            var local = map.Linear.Transpose() * direction;
            var sphereSupport = Vector.Dot(local, Sphere.Centre) + (local.Length() * Sphere.Radius);
            var boxSupport = Vector.Dot(local, Box.Centre) + (0.5 * Vector.Dot(local.Absolute(), Box.Size));
            return Math.Min(sphereSupport, boxSupport) + Vector.Dot(direction, map.Translation);
        }
    }
}
