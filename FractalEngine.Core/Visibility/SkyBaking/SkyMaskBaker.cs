using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Core.Visibility.Sky;
using BitOperations = System.Numerics.BitOperations;

namespace FractalEngine.Core.Visibility.SkyBaking;

/// <summary>Computes what the parts of a fractal leave of each other's sky: rays are cast from each part at its siblings.</summary>
public sealed class SkyMaskBaker
{
    // Errors of masks that are kept, by those without: of cells that are spread, and of thirds, which are the last choice.
    private const double MaxErrorOfSpread = 0.5;
    private const double MaxErrorOfThirds = 0.7;

    // From so many remaining levels on, levels with the same maps look alike.
    private const long SettledLevels = 4;

    // Hierarchies with a node of more children have no masks, and neither have those with more children in all.
    private const int MaxChildren = 64;
    private const int MaxTotalChildren = 80;

    // Flat tiles in sheared frames make up a landscape. Their masks are turned wrong by a little at each level, and all directions that
    // matter lie close to the ground: drawn mountains are 3 dB farther from traced ones than without. By the diagonal.
    private const double MaxFlatness = 0.05;
    private const double MaxShearOfTiles = 0.01;

    // Elsewhere directions are turned wrong by as much, and where an axis is stretched, level after level, they leave it: what is open
    // along it turns black. Ratios of axes up to about 1.2 darken no more than none at all.
    private const double MaxShear = 0.4;

    // In each round, so many lines of sight are cast for each child, and one point votes for each mask.
    private const int RoundCount = 7;
    private const int DrawsPerChild = 100;

    // So many lines of sight tell how many nodes rays enter, and the most that they may enter on average.
    private const int ProbedLines = 30;
    private const long MaxMeanVisits = 500;

    // The longest chain of only children that is followed to the next masks: an infinite one has none.
    private const int MaxOnlyChildren = 1000;

    private readonly SkyOccluder _occluder;

    private readonly LodHierarchy _hierarchy;

    private SkyMaskBaker(SkyOccluder occluder, LodHierarchy hierarchy)
    {
        _occluder = occluder;
        _hierarchy = hierarchy;
    }

    /// <summary>
    /// Computes what the parts of a fractal leave of each other's sky, unless that is known, or no use. Takes up to two seconds, on any one
    /// thread; culling may go on meanwhile.
    /// </summary>
    /// <param name="hierarchy">Receives the result.</param>
    /// <param name="windingSign">
    /// 1 where the base mesh is a closed solid wound outwards, −1 inwards, so that nothing is seen from inside; 0 where that is unknown.
    /// </param>
    /// <param name="cancellation">Ends the work early.</param>
    /// <exception cref="OperationCanceledException">The work was cancelled.</exception>
    public static void Bake(LodHierarchy hierarchy, int windingSign, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(hierarchy);
        lock (hierarchy.BakeLock)
        {
            if (!hierarchy.IsSkyBaked)
            {
                hierarchy.HasSkyMasks = TryBake(hierarchy, windingSign, cancellation: cancellation);
                hierarchy.IsSkyBaked = true;
            }
        }
    }

    /// <summary>Gives the nodes of a hierarchy their <see cref="SkyMasks"/>, where these come close to the truth.</summary>
    /// <param name="hierarchy">Hierarchy of a fractal; that of a mesh needs none.</param>
    /// <param name="windingSign">As for <see cref="Bake(LodHierarchy, int, CancellationToken)"/>.</param>
    /// <param name="keepsAll">Whether masks stay that do not pay.</param>
    /// <param name="cancellation">Ends the work early.</param>
    /// <returns>False where the hierarchy has no masks.</returns>
    internal static bool TryBake(LodHierarchy hierarchy, int windingSign, bool keepsAll = false, CancellationToken cancellation = default)
    {
        if (hierarchy.Mesh.FaceCount is 0 or > OccluderMesh.MaxFaceCount)
        {
            return false;
        }

        var baker = new SkyMaskBaker(new(hierarchy, windingSign), hierarchy);
        return !baker.HasShearedMasks() && baker.IsAffordable() && baker.Bake(keepsAll, cancellation);
    }

    /// <summary>Tells whether masks of a level reach those above through maps that turn directions wrong.</summary>
    private bool HasShearedMasks()
    {
        var isFlat = IsFlat(_hierarchy.Mesh.UsedBounds);
        return _occluder.Nodes.Exists(state => state.Node.ChildMaps.Index().Any(child => isFlat
            ? ShearOf(child.Item) > MaxShearOfTiles
            : ShearOf(child.Item) > MaxShear && _occluder.ChildOf(state.Node, state.Levels, child.Index).Node.ChildMaps.Length > 0));
    }

    /// <summary>
    /// Tells by some lines of sight whether rays enter few nodes. Where the parts of a fractal overlap, level within level, they enter
    /// nearly all, and the masks would take hours.
    /// </summary>
    private bool IsAffordable()
    {
        if (_occluder.Nodes is not [var (whole, levels), ..])
        {
            return true;
        }

        var random = new Random(0);
        var sample = new SkySample();
        var visitCount = 0L;
        var rayCount = 0;
        for (var i = 0; i < ProbedLines && visitCount <= MaxMeanVisits * ProbedLines; i++)
        {
            var isFound = _occluder.TrySample(whole, levels, random, sample);
            visitCount += sample.VisitCount;
            rayCount++;
            if (isFound)
            {
                var above = SkyDirections.Above(sample.Normal);
                visitCount += _occluder.FreeDirections(whole, levels, -1, sample.Point, above).VisitCount;
                rayCount += BitOperations.PopCount(above);
            }
        }

        return visitCount <= MaxMeanVisits * rayCount;
    }

    private static bool IsFlat(BoundingBox box) =>
        Math.Min(box.Size.X, Math.Min(box.Size.Y, box.Size.Z)) < MaxFlatness * box.Diagonal;

    /// <summary>Measures how far a map is from a similarity, by the squares of lengths: 0 for one.</summary>
    private static double ShearOf(SimdAffineMap map)
    {
        var (x, y, z) = (SimdAffineMap.ToVector(map.V1), SimdAffineMap.ToVector(map.V2), SimdAffineMap.ToVector(map.V3));
        var size = map.FrobeniusNormSquared() / 3;
        return (Math.Abs(x.LengthSquared() - size) + Math.Abs(y.LengthSquared() - size) + Math.Abs(z.LengthSquared() - size)
            + Math.Abs(Vector.Dot(x, y)) + Math.Abs(Vector.Dot(y, z)) + Math.Abs(Vector.Dot(z, x))) / size;
    }

    private bool Bake(bool keepsAll, CancellationToken cancellation)
    {
        var sources = FindSources();
        var children = sources.Where(static pair => pair.Source < 0).Sum(pair => _occluder.Nodes[pair.Index].Node.ChildMaps.Length);
        if (children > MaxTotalChildren || _occluder.Nodes.Exists(static state => state.Node.ChildMaps.Length > MaxChildren))
        {
            return false;
        }

        // The masks of a node are compared with rays together with those below it, which are there first.
        var lastMasks = new SkyMasks?[_occluder.LastLevels + 1];
        _hierarchy.SetLastSkyMasks(lastMasks);
        var hidesAnything = false;
        var fromTheLast = sources.OrderBy(pair => _occluder.Nodes[pair.Index].Levels).ThenByDescending(static pair => pair.Index);
        foreach (var (index, source) in fromTheLast)
        {
            var (node, levels) = _occluder.Nodes[index];
            if (source < 0)
            {
                // Where surfaces of large children touch, a smaller cell tells less than a larger one.
                hidesAnything |= SetMasks(node, levels, isSpread: true) || SetMasks(node, levels, isSpread: false);
            }
        }

        foreach (var (index, source) in sources.Where(static pair => pair.Source >= 0))
        {
            _occluder.Nodes[index].Node.SkyMasks = _occluder.Nodes[source].Node.SkyMasks;
        }

        return hidesAnything;

        bool SetMasks(LodNode node, long levels, bool isSpread)
        {
            var masks = Compute(node, levels, isSpread, cancellation);
            Set(node, levels, masks);
            var isUseful = masks.HideAnything && (keepsAll || SkyMaskTest.IsUseful(
                _occluder, _hierarchy, node, levels, isSpread ? MaxErrorOfSpread : MaxErrorOfThirds));
            Set(node, levels, isUseful ? masks : masks.WithoutMasks());
            return isUseful;
        }

        void Set(LodNode node, long levels, SkyMasks masks)
        {
            if (levels < lastMasks.Length)
            {
                lastMasks[levels] = masks;
            }
            else
            {
                node.SkyMasks = masks;
            }
        }
    }

    /// <summary>Finds the nodes with children, and for each another one that has the same masks; −1 for none.</summary>
    private List<(int Index, int Source)> FindSources()
    {
        var sources = new List<(int Index, int Source)>();
        for (var i = 0; i < _occluder.Nodes.Count; i++)
        {
            var (node, levels) = _occluder.Nodes[i];
            if (node.ChildMaps.Length > 0)
            {
                var isSettled = levels > _occluder.LastLevels && levels >= SettledLevels;
                var source = isSettled ? sources.FindIndex(pair => pair.Source < 0 && HasSameChildren(pair.Index, node)) : -1;
                sources.Add((i, source < 0 ? -1 : sources[source].Index));
            }
        }

        return sources;

        bool HasSameChildren(int index, LodNode node) =>
            _occluder.Nodes[index].Levels > _occluder.LastLevels && SkyMaskBaker.HasSameChildren(node, _occluder.Nodes[index].Node);
    }

    private static bool HasSameChildren(LodNode node1, LodNode node2)
    {
        var tolerance = 0.05 * node1.Box.Diagonal;
        return MapsOf(node1).SequenceEqual(MapsOf(node2))
            && (node1.Box.Minimum - node2.Box.Minimum).Length() < tolerance
            && (node1.Box.Maximum - node2.Box.Maximum).Length() < tolerance;

        static IEnumerable<AffineMap> MapsOf(LodNode node) => node.ChildMaps.Select(static map => map.ToAffineMap());
    }

    private SkyMasks Compute(LodNode node, long levels, bool isSpread, CancellationToken cancellation)
    {
        var data = new SkyMasks.Child[node.ChildMaps.Length];
        for (var i = 0; i < data.Length; i++)
        {
            var rotation = data.Length > 1 ? RotationOf(ToNextMasks(node, levels, i)) : null;
            data[i] = new(_occluder.ChildOf(node, levels, i).Node.Box, node.ChildMaps[i].ToAffineMap().Linear, rotation);
        }

        if (data.Length == 1)
        {
            return new(null, data);
        }

        // Rounds with sources of their own, so that the result does not depend on the number of threads.
        SkyMaskAccumulator[] votes = [.. data.Select(static _ => new SkyMaskAccumulator())];

        Parallel.For(
            0, RoundCount, new() { CancellationToken = cancellation },
            round => Vote(node, levels, data, isSpread, new(round), votes));
        return new([.. votes.Select(static child => child.ToMasks())], data, isSpread);
    }

    /// <summary>
    /// Lets the points of the surface that are seen from outside vote about the directions that are free for their child, cell and side.
    /// </summary>
    private void Vote(LodNode node, long levels, SkyMasks.Child[] data, bool isSpread, Random random, SkyMaskAccumulator[] votes)
    {
        var sample = new SkySample();
        var hasVoted = new HashSet<(int Child, int Place)>();
        for (var draw = 0; draw < DrawsPerChild * data.Length; draw++)
        {
            if (!_occluder.TrySample(node, levels, random, sample))
            {
                continue;
            }

            var child = sample.Steps[0].Child;
            var inverse = node.ChildMaps[child].ToAffineMap().Inverse();
            var normalInChild = node.ChildMaps[child].ToAffineMap().Linear.Transpose() * sample.Normal;
            var side = AmbientCube.Of(SimdAffineMap.ToVector256(normalInChild));
            var point = SimdAffineMap.ToVector256(inverse * sample.Point);
            var place = SkyMasks.PlaceOf(in data[child], point, side, isSpread ? Vector256<double>.Zero : null);
            if (!hasVoted.Add((child, place)))
            {
                continue;
            }

            var above = SkyDirections.Above(sample.Normal);
            var (free, _) = _occluder.FreeDirections(node, levels, child, sample.Point, above);
            votes[child].Add(place, above, free);
        }
    }

    /// <summary>Maps directions of a node to the frame below a child in which masks are known next: an only child has none.</summary>
    private Matrix ToNextMasks(LodNode node, long levels, int child)
    {
        var linear = node.ChildMaps[child].ToAffineMap().Linear;
        var below = _occluder.ChildOf(node, levels, child);
        for (var i = 0; i < MaxOnlyChildren && below.Node.ChildMaps.Length == 1; i++)
        {
            // Only directions matter: the product of many small maps would underflow.
            linear /= linear.MaxAbsEntry();
            linear *= below.Node.ChildMaps[0].ToAffineMap().Linear;
            below = _occluder.ChildOf(below.Node, below.Levels, 0);
        }

        return (linear / linear.MaxAbsEntry()).Inverse();
    }

    /// <summary>Tells for each direction which one it is under a map; null where it is the same.</summary>
    private static SkyMaskRotation? RotationOf(Matrix map)
    {
        if (SkyDirections.AreParallel(map))
        {
            return null;
        }

        Span<byte> sources = stackalloc byte[SkyDirections.Count];
        for (var i = 0; i < sources.Length; i++)
        {
            sources[i] = (byte)SkyDirections.Nearest(map * SkyDirections.At(i));
        }

        return new(sources);
    }
}
