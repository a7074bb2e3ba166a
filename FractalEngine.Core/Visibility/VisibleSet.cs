using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility;

/// <summary>The visible instances of a scene's fractals in one frame.</summary>
/// <remarks>
/// A set is created once and filled again for each frame: after the first frames it allocates nothing on one thread, and some 2 KB a frame
/// on several. The same view gives the same instances, in the same order, on any number of threads. A frame is culled in vertical strips,
/// each independent of the others.
/// </remarks>
public sealed class VisibleSet
{
    // The number does not depend on the machine, so that the result does not either.
    private const int StripCount = 8;

    // Minimum sizes are steps of a geometric series, three times as long from the fifth on: frames far above the budget take long to cull.
    private const double CoarseningFactor = 1.5;
    private const int FineStepCount = 4;

    private readonly StripOutput[] _strips = [.. Enumerable.Range(0, StripCount).Select(static _ => new StripOutput())];

    // One for each thread that has culled a strip: the pixels of a strip of a large depth map take 8 MB.
    private readonly Stack<StripCuller> _cullers = new(StripCount);
    private readonly InstanceList _sharedInstances = new(hasPathHashes: false);
    private readonly HashSet<(int Rank, ulong PathHash)> _mergedKeys = [];
    private readonly ParallelOptions _parallelOptions = new();
    private readonly Action<int> _cullStrip;
    private readonly CulledObjectBvh _objectBvh = new();
    private IReadOnlyList<CulledObject> _objects = [];
    private CullingSettings _settings = new();
    private CullingView _view;
    private int[] _order = [];
    private int[] _ranks = [];
    private double[] _sortKeys = [];
    private int _coarseningStep;
    private int _instanceBudget;
    private int _foundCount;
    private bool _usesObjectBvh;
    private volatile bool _isOverBudget;

    /// <summary>Creates an empty set.</summary>
    public VisibleSet() => _cullStrip = CullStrip;

    /// <summary>Number of floats of one instance.</summary>
    /// <remarks>They are the rows of a 3×4 map from the drawn mesh's frame to world axes about the camera.</remarks>
    public static int FloatsPerInstance => InstanceList.FloatsPerInstance;

    /// <summary>Number of chunks that the instances of each object come in.</summary>
    public static int ChunkCount => StripCount + 1;

    /// <summary>Whether many objects are culled by a hierarchy over them: the same result as without, sooner.</summary>
    internal bool HasObjectBvh { get; init; } = true;

    /// <summary>Statistics of the last frame.</summary>
    public CullingStatistics Statistics { get; private set; }

    /// <summary>Number of visible instances of all objects.</summary>
    public int InstanceCount { get; private set; }

    /// <summary>Minimum projected size in pixels: that of the settings, or more where the instance budget required it.</summary>
    public double MinProjectedSize { get; private set; }

    /// <summary>Finds the visible instances of a frame.</summary>
    /// <param name="view">Camera and frame.</param>
    /// <param name="objects">Objects of the scene.</param>
    /// <param name="settings">Settings of culling.</param>
    public void Cull(in CullingView view, IReadOnlyList<CulledObject> objects, CullingSettings settings)
    {
        _view = view;
        _objects = objects;
        _settings = settings;
        // However coarse, each object is one instance, or one for each of its roots.
        var minInstanceCount = 0;
        for (var i = 0; i < objects.Count; i++)
        {
            minInstanceCount += objects[i].Roots?.Length ?? 1;
        }

        _instanceBudget = Math.Max(settings.InstanceBudget, minInstanceCount);
        _parallelOptions.MaxDegreeOfParallelism = Math.Max(1, settings.ThreadCount);
        SortObjects();
        _usesObjectBvh = HasObjectBvh && settings.FrustumCulling && _objectBvh.TryUpdate(objects);
        // The smallest step that fits is searched for near that of the frame before.
        var step = Math.Max(0, _coarseningStep - 1);
        var fits = TryCull(step);
        while (fits && step > 0 && TryCull(step - 1))
        {
            step--;
        }

        if (fits && step > 0)
        {
            // The last attempt did not fit, and has overwritten the result of the one that did.
            fits = TryCull(step);
        }

        while (!fits)
        {
            fits = TryCull(++step);
        }

        _coarseningStep = step;
    }

    /// <summary>Instances of an object in one chunk, [n × 12].</summary>
    /// <param name="objectIndex">Index of the object in the list of <see cref="Cull"/>.</param>
    /// <param name="chunk">Index of the chunk, less than <see cref="ChunkCount"/>.</param>
    public ReadOnlySpan<float> Instances(int objectIndex, int chunk) => ListOf(chunk).RowsOf(RankOf(objectIndex));

    /// <summary>Gradient factors from 0 to 1, one for each of <see cref="Instances"/>, of an object with a gradient.</summary>
    /// <param name="objectIndex">Index of the object in the list of <see cref="Cull"/>.</param>
    /// <param name="chunk">Index of the chunk, less than <see cref="ChunkCount"/>.</param>
    public ReadOnlySpan<float> GradientFactors(int objectIndex, int chunk) => ListOf(chunk).GradientFactorsOf(RankOf(objectIndex));

    /// <summary>
    /// Sides that are never seen, of an object whose hierarchy has <see cref="LodHierarchy.HasCoveredSides"/>. For each of
    /// <see cref="Instances"/> the sum of 1, 2 and 4 for those towards +x, +y and +z of the base mesh and 8, 16 and 32 for −x, −y and
    /// −z, [n].
    /// </summary>
    /// <param name="objectIndex">Index of the object in the list of <see cref="Cull"/>.</param>
    /// <param name="chunk">Index of the chunk, less than <see cref="ChunkCount"/>.</param>
    public ReadOnlySpan<float> CoveredSides(int objectIndex, int chunk) => ListOf(chunk).CoveredSidesOf(RankOf(objectIndex));

    /// <summary>
    /// Tints, one for each of <see cref="Instances"/>, of an object whose maps have colours: what they add to its colour in linear light,
    /// and the share that it keeps, [n × 4].
    /// </summary>
    /// <param name="objectIndex">Index of the object in the list of <see cref="Cull"/>.</param>
    /// <param name="chunk">Index of the chunk, less than <see cref="ChunkCount"/>.</param>
    public ReadOnlySpan<float> Tints(int objectIndex, int chunk) => ListOf(chunk).TintsOf(RankOf(objectIndex));

    /// <summary>
    /// Colours of <see cref="Instances"/> of an object with a palette, linear light: red, green, blue and 0, [n × 4].
    /// </summary>
    /// <param name="objectIndex">Index of the object in the list of <see cref="Cull"/>.</param>
    /// <param name="chunk">Index of the chunk, less than <see cref="ChunkCount"/>.</param>
    public ReadOnlySpan<float> PaletteColours(int objectIndex, int chunk) => ListOf(chunk).PaletteColoursOf(RankOf(objectIndex));

    /// <summary>
    /// Parts of the sky from 0 to 1 that the sides of each of <see cref="Instances"/> see, towards +x, +y, +z, −x, −y, −z of the base
    /// mesh, [n × 6]; 1 for sides that the camera does not see. Meaningful where <see cref="CullingSettings.SkyVisibility"/> is on and
    /// the object's hierarchy has masks.
    /// </summary>
    /// <param name="objectIndex">Index of the object in the list of <see cref="Cull"/>.</param>
    /// <param name="chunk">Index of the chunk, less than <see cref="ChunkCount"/>.</param>
    public ReadOnlySpan<float> SkyParts(int objectIndex, int chunk) => ListOf(chunk).SkyPartsOf(RankOf(objectIndex));

    /// <summary>Counts the visible instances of an object.</summary>
    /// <param name="objectIndex">Index of the object in the list of <see cref="Cull"/>.</param>
    public int InstanceCountOf(int objectIndex)
    {
        var sum = 0;
        for (var chunk = 0; chunk < ChunkCount; chunk++)
        {
            sum += ListOf(chunk).RangeOf(RankOf(objectIndex)).Count;
        }

        return sum;
    }

    /// <summary>
    /// Tells whether the near plane or a section plane clips an instance of an object; the back faces of a solid may then be visible.
    /// </summary>
    /// <param name="objectIndex">Index of the object in the list of <see cref="Cull"/>.</param>
    public bool IsNearClipped(int objectIndex)
    {
        var rank = RankOf(objectIndex);
        foreach (var strip in _strips)
        {
            if (strip.HasNearClippedInstance(rank))
            {
                return true;
            }
        }

        return false;
    }

    private int RankOf(int objectIndex) => _ranks.AsSpan(0, _objects.Count)[objectIndex];

    private InstanceList ListOf(int chunk) => chunk < StripCount ? _strips[chunk].Instances : _sharedInstances;

    /// <summary>Culls all strips with a number of steps of coarsening.</summary>
    /// <returns>False when there are more instances than the budget.</returns>
    private bool TryCull(int step)
    {
        _isOverBudget = false;
        _foundCount = 0;
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
        SumStatistics();
        return InstanceCount <= _instanceBudget;
    }

    /// <summary>Sorts the objects by the distance of their centres, so that close ones occlude those behind.</summary>
    private void SortObjects()
    {
        var count = _objects.Count;
        if (_order.Length < count)
        {
            _order = new int[count];
            _ranks = new int[count];
            _sortKeys = new double[count];
        }

        for (var i = 0; i < count; i++)
        {
            var item = _objects[i];
            var box = item.Hierarchy.NodeAt(item.Hierarchy.LevelCount).Box;
            _order[i] = i;
            _sortKeys[i] = box.IsEmpty ? 0 : ((item.ObjectToWorld * box.Centre) - _view.Position).LengthSquared();
        }

        _sortKeys.AsSpan(0, count).Sort(_order.AsSpan(0, count));
        for (var rank = 0; rank < count; rank++)
        {
            _ranks[_order[rank]] = rank;
        }
    }

    private void CullStrip(int stripIndex)
    {
        // One strip that gives up is enough to try again with a larger minimum size.
        if (_isOverBudget)
        {
            return;
        }

        var left = stripIndex * _view.Width / StripCount;
        var right = (stripIndex + 1) * _view.Width / StripCount;
        var frame = new StripFrame(in _view, _settings, MinProjectedSize, _instanceBudget, left, right);
        var strip = _strips[stripIndex];
        var culler = TakeCuller();
        culler.Cull(
            in frame, _objects, _order.AsSpan(0, _objects.Count), _ranks.AsSpan(0, _objects.Count), _usesObjectBvh ? _objectBvh : null,
            strip);
        lock (_cullers)
        {
            _cullers.Push(culler);
        }

        if (Interlocked.Add(ref _foundCount, strip.Instances.Count) > _instanceBudget || strip.IsOverBudget)
        {
            _isOverBudget = true;
        }
    }

    private StripCuller TakeCuller()
    {
        lock (_cullers)
        {
            return _cullers.TryPop(out var culler) ? culler : new();
        }
    }

    /// <summary>Collects the instances that several strips may have found, each of them once.</summary>
    private void MergeSharedInstances()
    {
        _sharedInstances.Clear();
        _mergedKeys.Clear();
        for (var rank = 0; rank < _objects.Count; rank++)
        {
            foreach (var strip in _strips)
            {
                var candidates = strip.SharedInstances;
                var (start, count) = candidates.RangeOf(rank);
                for (var i = start; i < start + count; i++)
                {
                    if (_mergedKeys.Add((rank, candidates.PathHashes[i])))
                    {
                        _sharedInstances.AddFrom(candidates, i);
                    }
                }
            }

            _sharedInstances.EndObject();
        }
    }

    private void SumStatistics()
    {
        Statistics = default;
        InstanceCount = _sharedInstances.Count;
        foreach (var strip in _strips)
        {
            Statistics += strip.Statistics;
            InstanceCount += strip.Instances.Count;
        }
    }
}
