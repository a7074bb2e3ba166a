using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Fractals.Levels.Rays;

/// <summary>
/// The bounds for rays of all levels of a fractal, made when the first ray comes to a level. Levels that recur share theirs.
/// </summary>
internal sealed class RayLevels
{
    // Up to here levels are found without a search.
    private const int MaxLowestLevel = 63;

    private readonly FractalHierarchy _hierarchy;
    private readonly int[] _slotsOfRegions;
    private readonly int[] _sharedOffsets;
    private readonly RayBounds?[] _slots;
    private readonly RayBounds?[] _lowest;

    /// <summary>Prepares the levels of a fractal.</summary>
    public RayLevels(FractalHierarchy hierarchy)
    {
        _hierarchy = hierarchy;
        var regions = hierarchy.AllLevels.Regions;
        _slotsOfRegions = new int[regions.Length];
        _sharedOffsets = new int[regions.Length];
        var slotCount = 0;
        for (var i = 0; i < regions.Length; i++)
        {
            var region = regions[i];
            // From this many rounds up, all that bounds reach lies in the region too, and recurs with it.
            var reach = RayBoundsBuilder.MaxGenerations * MaxStep(region);
            _sharedOffsets[i] = (int)Math.Min(region.LevelCount, (reach + region.Period - 1) / region.Period * region.Period);
            _slotsOfRegions[i] = slotCount;
            slotCount += (int)Math.Min(region.LevelCount, _sharedOffsets[i] + region.Period);
        }

        _slots = new RayBounds?[slotCount];
        _lowest = new RayBounds?[Math.Min(hierarchy.Levels, MaxLowestLevel) + 1];
    }

    /// <summary>Number of bytes of the bounds that were made so far.</summary>
    public long StorageBytes => _slots.Sum(bounds => bounds?.StorageBytes ?? 0) + (8 * (_slots.Length + _lowest.Length));

    /// <summary>The bounds of the sub-fractal with a number of remaining levels.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public RayBounds At(long remainingLevels) =>
        (ulong)remainingLevels < (ulong)_lowest.Length && _lowest[remainingLevels] is { } bounds ? bounds : Find(remainingLevels);

    [MethodImpl(MethodImplOptions.NoInlining)]
    private RayBounds Find(long level)
    {
        var regions = _hierarchy.AllLevels.Regions;
        var region = regions.Length - 1;
        while (regions[region].FirstLevel > level)
        {
            region--;
        }

        var offset = level - regions[region].FirstLevel;
        var shared = _sharedOffsets[region];
        var slot = _slotsOfRegions[region] + (int)(offset < shared ? offset : shared + ((offset - shared) % regions[region].Period));
        // Where two threads make the same bounds, one of them goes on with its own.
        var bounds = _slots[slot] ??= RayBoundsBuilder.Build(_hierarchy, level);
        if (level < _lowest.Length)
        {
            _lowest[level] = bounds;
        }

        return bounds;
    }

    /// <summary>The largest number of levels that a child of a region's sub-fractals goes down.</summary>
    private long MaxStep(LevelRegion region)
    {
        var maxStep = 1L;
        for (var phase = 0; phase < Math.Min(region.Period, region.LevelCount); phase++)
        {
            foreach (var child in _hierarchy.FindOrNull(region.FirstLevel + phase)?.AllChildren() ?? [])
            {
                if (!child.LevelStep.IsAbsolute)
                {
                    // From a level so high that the difference does not depend on it.
                    maxStep = Math.Max(maxStep, _hierarchy.Levels - child.RemainingLevels(_hierarchy.Levels));
                }
            }
        }

        return maxStep;
    }
}
