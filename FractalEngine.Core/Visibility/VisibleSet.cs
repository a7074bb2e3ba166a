
namespace FractalEngine.Core.Visibility;

/// <summary>
/// What is drawn of a scene's fractals in one picture. Made once and filled again for every picture: after the first ones nothing is
/// allocated. The same view gives the same instances, in the same order, on any number of threads.
/// </summary>
public sealed class VisibleSet
{
    // A number that does not depend on the machine, so that neither does the result.
    private const int StripCount = 8;
    // Steps are three times as long from the fifth on: what is far from fitting takes long to look at.
    private const double CoarseningFactor = 1.5;
    private const int FineStepCount = 4;

    private readonly StripCuller[] _strips = new StripCuller[StripCount];
    private readonly InstanceRows _sharedInstances = new(hasPathHashes: false);
    private readonly HashSet<(int, ulong)> _mergedKeys = [];
    private readonly ParallelOptions _parallelOptions = new();
    private readonly Action<int> _cullStrip;
    private int _coarseningStep;
    private int[] _order = [];
    private double[] _sortKeys = [];
    private int[] _instanceEnds = [];
    private int[] _sharedInstanceEnds = [];
    private int[] _mergedEnds = [];
    private bool[] _isNearClipped = [];
    private IReadOnlyList<CulledObject> _objects = [];
    private CullingSettings _settings = new();
    private CullingView _view;
    private int _instanceBudget;
    private volatile bool _isOverBudget;
    private int _foundCount;

    /// <summary>An empty set.</summary>
    public VisibleSet()
    {
        for (var i = 0; i < StripCount; i++)
        {
            _strips[i] = new();
        }

        _cullStrip = CullStrip;
    }

    /// <summary>Floats of one instance: the three rows of a 3×4 map from the drawn mesh's frame to world axes about the camera.</summary>
    public static int FloatsPerInstance => InstanceRows.FloatsPerInstance;

    /// <summary>What it took.</summary>
    public CullingStatistics Statistics { get; private set; }

    /// <summary>How many instances are drawn.</summary>
    public int InstanceCount { get; private set; }

    /// <summary>What counted as small, pixels: that of the settings, or more where the budget asked for it.</summary>
    public double MinProjectedSize { get; private set; }

    /// <summary>Bytes of the instances' memory.</summary>
    public long StorageBytes =>
        _sharedInstances.StorageBytes + _strips.Sum(strip => strip.Instances.StorageBytes + strip.SharedInstances.StorageBytes);

    /// <summary>Chooses what is drawn.</summary>
    /// <param name="view">How the scene is looked at.</param>
    /// <param name="objects">Of the scene.</param>
    /// <param name="settings">What is left out.</param>
    public void Cull(in CullingView view, IReadOnlyList<CulledObject> objects, CullingSettings settings)
    {
        (_view, _objects, _settings) = (view, objects, settings);
        // However coarse, each object is one instance, or one for each of its roots.
        var minInstanceCount = 0;
        for (var i = 0; i < objects.Count; i++)
        {
            minInstanceCount += objects[i].Roots?.Length ?? 1;
        }

        _instanceBudget = Math.Max(settings.InstanceBudget, minInstanceCount);
        _parallelOptions.MaxDegreeOfParallelism = Math.Max(1, settings.ThreadCount);
        SortObjects();
        // Of a ladder of sizes the smallest that fits, looked for near the one of the picture before.
        var step = Math.Max(0, _coarseningStep - 1);
        var fits = TryCull(step);
        while (fits && step > 0 && TryCull(step - 1))
        {
            step--;
        }

        if (fits && step > 0)
        {
            // The smaller one did not fit, but is what there is now.
            fits = TryCull(step);
        }

        while (!fits)
        {
            fits = TryCull(++step);
        }

        _coarseningStep = step;
    }

    /// <summary>The number of parts that an object's instances come in.</summary>
    public static int ChunkCount => StripCount + 1;

    /// <summary>A part of an object's instances, [n × 12].</summary>
    /// <param name="objectIndex">The object's place in the list.</param>
    /// <param name="chunk">Less than <see cref="ChunkCount"/>.</param>
    public ReadOnlySpan<float> Instances(int objectIndex, int chunk)
    {
        var (start, end) = RangeOf(objectIndex, chunk);
        return (chunk < StripCount
            ? _strips[chunk].Instances
            : _sharedInstances).Span[(start * InstanceRows.FloatsPerInstance)..(end * InstanceRows.FloatsPerInstance)];
    }

    /// <summary>Numbers between two colours, one an instance of <see cref="Instances"/>, of an object that has a gradient.</summary>
    public ReadOnlySpan<float> GradientFactors(int objectIndex, int chunk)
    {
        var (start, end) = RangeOf(objectIndex, chunk);
        // Where there are none, the list may be shorter than what comes before them.
        return start == end ? [] : (chunk < StripCount ? _strips[chunk].Instances : _sharedInstances).GradientFactors[start..end];
    }

    /// <summary>How many instances are drawn of an object.</summary>
    public int InstanceCountOf(int objectIndex)
    {
        var count = 0;
        for (var chunk = 0; chunk < ChunkCount; chunk++)
        {
            count += Instances(objectIndex, chunk).Length / InstanceRows.FloatsPerInstance;
        }

        return count;
    }

    private (int Start, int End) RangeOf(int objectIndex, int chunk)
    {
        var ends = chunk < StripCount ? _instanceEnds.AsSpan(chunk * _objects.Count, _objects.Count) : _mergedEnds;
        var rank = Array.IndexOf(_order, objectIndex, 0, _objects.Count);
        return (rank == 0 ? 0 : ends[rank - 1], ends[rank]);
    }

    /// <summary>True when the near plane cuts through an instance of an object: then the inner side of a solid may be seen.</summary>
    public bool IsNearClipped(int objectIndex)
    {
        var rank = Array.IndexOf(_order, objectIndex, 0, _objects.Count);
        for (var stripIndex = 0; stripIndex < StripCount; stripIndex++)
        {
            if (_isNearClipped[(stripIndex * _objects.Count) + rank])
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Chooses with so many steps of coarsening.</summary>
    /// <returns>False when there is more than the budget.</returns>
    private bool TryCull(int step)
    {
        (_isOverBudget, _foundCount) = (false, 0);
        MinProjectedSize = step == 0
            ? _settings.MinProjectedSize
            : Math.Max(_settings.MinProjectedSize, 1) * Math.Pow(CoarseningFactor, step + Math.Max(0, 2 * (step - FineStepCount)));
        if (_settings.ThreadCount > 1)
        {
            Parallel.For(0, StripCount, _parallelOptions, _cullStrip);
        }
        else
        {
            for (var i = 0; i < StripCount; i++)
            {
                CullStrip(i);
            }
        }

        if (_isOverBudget)
        {
            return false;
        }

        MergeSharedInstances();
        return InstanceCount <= _instanceBudget;
    }

    /// <summary>Sorts the objects, the nearest first, so that they hide those behind.</summary>
    private void SortObjects()
    {
        var count = _objects.Count;
        if (_order.Length < count)
        {
            (_order, _sortKeys) = (new int[count], new double[count]);
        }

        if (_instanceEnds.Length < StripCount * count)
        {
            (_instanceEnds, _sharedInstanceEnds, _mergedEnds, _isNearClipped) =
                (new int[StripCount * count], new int[StripCount * count], new int[count], new bool[StripCount * count]);
        }

        for (var i = 0; i < count; i++)
        {
            var item = _objects[i];
            var box = item.Hierarchy.NodeAt(item.Hierarchy.LevelCount).Box;
            (_order[i], _sortKeys[i]) = (i, box.IsEmpty ? 0 : ((item.ObjectToWorld * box.Centre) - _view.Position).LengthSquared());
        }

        _sortKeys.AsSpan(0, count).Sort(_order.AsSpan(0, count));
    }

    private void CullStrip(int stripIndex)
    {
        // One strip too many is enough to begin again.
        if (_isOverBudget)
        {
            return;
        }

        var (strip, count) = (_strips[stripIndex], _objects.Count);
        strip.BeginFrame(in _view, _settings, MinProjectedSize, _instanceBudget, stripIndex * _view.Width / StripCount,
            (stripIndex + 1) * _view.Width / StripCount);
        for (var rank = 0; rank < count; rank++)
        {
            var item = _objects[_order[rank]];
            strip.CullObject(item);
            _instanceEnds[(stripIndex * count) + rank] = strip.Instances.Count;
            _sharedInstanceEnds[(stripIndex * count) + rank] = strip.SharedInstances.Count;
            _isNearClipped[(stripIndex * count) + rank] = strip.IsNearClipped;
        }

        if (Interlocked.Add(ref _foundCount, strip.Instances.Count) > _instanceBudget || strip.IsOverBudget)
        {
            _isOverBudget = true;
        }
    }

    /// <summary>Puts together what several strips have found, each instance once.</summary>
    private void MergeSharedInstances()
    {
        _sharedInstances.Clear();
        _mergedKeys.Clear();
        (Statistics, InstanceCount) = (default, 0);
        var count = _objects.Count;
        for (var rank = 0; rank < count; rank++)
        {
            for (var stripIndex = 0; stripIndex < StripCount; stripIndex++)
            {
                var strip = _strips[stripIndex];
                var start = rank == 0 ? 0 : _sharedInstanceEnds[(stripIndex * count) + rank - 1];
                for (var i = start; i < _sharedInstanceEnds[(stripIndex * count) + rank]; i++)
                {
                    if (_mergedKeys.Add((rank, strip.SharedInstances.PathHashes[i])))
                    {
                        _sharedInstances.Add(strip.SharedInstances, i);
                    }
                }
            }

            _mergedEnds[rank] = _sharedInstances.Count;
        }

        InstanceCount = _sharedInstances.Count;
        foreach (var strip in _strips)
        {
            Statistics += strip.Statistics;
            InstanceCount += strip.Instances.Count;
        }
    }
}
