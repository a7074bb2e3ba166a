using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Visibility;

/// <summary>
/// Chooses what is drawn in one strip of a picture: walks the levels of each object from the top, nearest first, and leaves out what lies
/// outside, what is hidden, and what is too small to be told apart.
/// </summary>
internal sealed partial class StripCuller
{
    // A sub-fractal at this depth is drawn as it stands: its levels hardly shrink.
    private const int MaxDepth = 1000;
    private const int MaxInsertionSortCount = 24;
    private const float SubPixelsPerPixel = 256;
    private const int MultisampleFactor = 2;

    // Of a whole budget, in one strip.
    private const int MaxNodesPerInstance = 4;
    private const int MinInstancesForNodeLimit = 20_000;

    // Left, right, top, bottom, nearness and depth of each copy.
    private const int FootprintRows = 6;

    // Of a pixel: more than what single precision rounds by.
    private const float PixelPadding = 1f / 256;

    // A sub-fractal is drawn as it stands, too, when its copies would be smaller than this part of what counts as small.
    private const double MinChildSizeRatio = 0.5;

    // Not when it is itself more than so many times what counts as small: copies that are tiny beside what lies between them are no solid.
    private const double MaxProxySizeRatio = 3;

    private readonly OcclusionBuffer _occlusionBuffer = new();
    private float[] _screenX = [];
    private float[] _screenY = [];
    private float[] _inverseDepths = [];
    private float[] _sortKeys = new float[256];
    private float[] _footprints = new float[256 * FootprintRows];
    private int[] _order = new int[256];
    private int _stackTop;
    private CullingView _view;
    private CullingSettings _settings = new();
    private CulledObject _object = null!;
    private OccluderMesh _occluder = null!;
    private SimdAffineMap _viewToWorld;
    private Vector256<double> _vertexOrigin;
    private float _minSampleOffset;
    private float _maxSampleOffset;
    private double _minProjectedSize;
    private double _scaleX;
    private double _scaleY;
    private double _centreX;
    private double _centreY;
    private int _instanceBudget;
    private long _maxNodes;
    private CullingStatistics _statistics;

    /// <summary>The instances found: rows of 3×4 maps from the frame of the drawn mesh to world axes about the camera.</summary>
    public InstanceRows Instances { get; } = new(hasPathHashes: false);

    /// <summary>Those that reach out of the strip, to which others may come as well, with what tells them apart.</summary>
    public InstanceRows SharedInstances { get; } = new(hasPathHashes: true);

    /// <summary>What it took.</summary>
    public CullingStatistics Statistics => _statistics;

    /// <summary>True when the near plane cuts through an instance of the object that was added last.</summary>
    public bool IsNearClipped { get; private set; }

    /// <summary>True when there was more than the budget.</summary>
    public bool IsOverBudget { get; private set; }

    /// <summary>Begins a picture.</summary>
    /// <param name="view">Of the whole picture.</param>
    /// <param name="settings">What is left out.</param>
    /// <param name="minProjectedSize">What counts as small.</param>
    /// <param name="instanceBudget">More instances are not looked for.</param>
    /// <param name="left">First column of the strip.</param>
    /// <param name="right">One more than the last.</param>
    public void BeginFrame(in CullingView view, CullingSettings settings, double minProjectedSize, int instanceBudget, int left, int right)
    {
        // From here on, pixels are those of the coverage: two by two where pixels have samples.
        var samplesPerAxis = settings.IsMultisampled ? MultisampleFactor : 1;
        (_view, _settings, _minProjectedSize, _instanceBudget, _statistics, IsOverBudget) =
            (view, settings, samplesPerAxis * minProjectedSize, instanceBudget, default, false);
        (_scaleX, _scaleY) = (samplesPerAxis * view.PixelsPerUnitX, samplesPerAxis * view.PixelsPerUnitY);
        (_centreX, _centreY) = (samplesPerAxis * 0.5 * view.Width, samplesPerAxis * 0.5 * view.Height);
        _viewToWorld = new(new AffineMap(view.Axes, Vector.Zero));
        _occlusionBuffer.Clear(samplesPerAxis * left, samplesPerAxis * right, samplesPerAxis * view.Height, settings.IsMultisampled);
        (_minSampleOffset, _maxSampleOffset) = settings.IsMultisampled
            ? (0.25f - PixelPadding, 0.75f + PixelPadding)
            : (0.5f - PixelPadding, 0.5f + PixelPadding);
        _maxNodes = MaxNodesPerInstance * (long)Math.Max(instanceBudget, MinInstancesForNodeLimit);
        Instances.Clear();
        SharedInstances.Clear();
    }

    /// <summary>Chooses what is drawn of an object.</summary>
    /// <param name="item">The object; the nearest is asked first.</param>
    public void CullObject(CulledObject item)
    {
        (_object, _occluder, _vertexOrigin, _stackTop, IsNearClipped) =
            (item, item.Hierarchy.Occluder, SimdAffineMap.ToVector256(item.VertexOrigin), 0, false);
        if (_screenX.Length < _occluder.PaddedVertexCount)
        {
            (_screenX, _screenY, _inverseDepths) = (new float[_occluder.PaddedVertexCount], new float[_occluder.PaddedVertexCount],
                new float[_occluder.PaddedVertexCount]);
        }

        var toView = _view.Axes.Inverse();
        if (item.Roots is not { } roots)
        {
            VisitRoot(item.Hierarchy.LevelCount,
                new AffineMap(toView * item.ObjectToWorld.Linear, toView * (item.ObjectToWorld.Translation - _view.Position)),
                new(0, ColourPath.Start));
            return;
        }

        for (var i = 0; i < roots.Length; i++)
        {
            VisitRoot(roots[i].RemainingLevels,
                new AffineMap(toView * roots[i].FrameToCamera.Linear, toView * roots[i].FrameToCamera.Translation),
                new((ulong)(i + 1) << 40, roots[i].ColourPath));
        }
    }

    /// <summary>Looks at a part that drawing begins with.</summary>
    private void VisitRoot(long remainingLevels, AffineMap toView, CullingPath path)
    {
        var (node, map) = (_object.Hierarchy.NodeAt(remainingLevels), new SimdAffineMap(toView));
        // Of a picture of less than eight columns some strips have none.
        if (!node.IsEmpty && _occlusionBuffer.Left < _occlusionBuffer.Right)
        {
            var footprint = ComputeFootprint(map.Apply(node.Centre), map.TransformHalfSize(node.HalfSize));
            _statistics.VisitedNodes++;
            Visit(node, remainingLevels, in map, 0, path, in footprint);
        }
    }

    /// <summary>Looks at a sub-fractal whose place in the picture is known.</summary>
    private void Visit(LodNode node, long remainingLevels, in SimdAffineMap map, int depth, CullingPath path, in Footprint footprint)
    {
        if (!IsVisible(in footprint))
        {
            return;
        }

        VisitVisible(node, remainingLevels, in map, depth, path, in footprint);
    }

    private void VisitVisible(LodNode node, long remainingLevels, in SimdAffineMap map, int depth, CullingPath path, in Footprint footprint)
    {
        if (UpdateIsOverBudget())
        {
            return;
        }

        if (node.ChildMaps.Length == 0)
        {
            Emit(node, in map, in footprint, path);
        }
        else if (!(footprint.ProjectedSize > _minProjectedSize)
        || (footprint.ProjectedSize <= MaxProxySizeRatio * _minProjectedSize
        && footprint.ProjectedSize * node.MaxChildSizeRatio <= MinChildSizeRatio * _minProjectedSize) || depth >= MaxDepth)
        {
            _statistics.Proxies++;
            Emit(node, in map, in footprint, path);
        }
        else
        {
            VisitChildren(node, remainingLevels, in map, depth, path);
        }
    }

    private bool UpdateIsOverBudget() =>
        IsOverBudget |= _statistics.VisitedNodes > _maxNodes || Instances.Count + SharedInstances.Count > _instanceBudget;

    private bool IsVisible(in Footprint footprint)
    {
        if (footprint.IsOutside)
        {
            _statistics.OutsideFrustum++;
            return false;
        }

        if (!_settings.OcclusionCulling || !footprint.IsBeyondNearPlane)
        {
            return true;
        }

        if (footprint.CoversNoSample)
        {
            _statistics.ZeroCoverage++;
            return false;
        }

        if (_occlusionBuffer.IsOccluded(footprint.Left, footprint.Top, footprint.Right, footprint.Bottom, footprint.MaxInverseDepth))
        {
            _statistics.Occluded++;
            return false;
        }

        return true;
    }

    private void VisitChildren(LodNode node, long remainingLevels, in SimdAffineMap map, int depth, CullingPath path)
    {
        var (count, first) = (node.ChildMaps.Length, _stackTop);
        _stackTop += (count + LodNode.Lanes - 1) / LodNode.Lanes * LodNode.Lanes;
        if (_stackTop > _order.Length)
        {
            Array.Resize(ref _order, 2 * _stackTop);
            Array.Resize(ref _sortKeys, 2 * _stackTop);
            Array.Resize(ref _footprints, 2 * _stackTop * FootprintRows);
        }

        _statistics.VisitedNodes += count;
        ProjectChildren(node, in map, first);
        SortFrontToBack(_sortKeys.AsSpan(first, count), _order.AsSpan(first, count));
        for (var i = first; i < first + count; i++)
        {
            var child = _order[i];
            var footprint = ComputeFootprint(first, child);
            if (!footprint.NeedsDouble && !IsVisible(in footprint))
            {
                continue;
            }

            var childLevels = node.ChildLevelSteps[child].RemainingLevels(remainingLevels);
            var childNode = _object.Hierarchy.NodeAt(childLevels);
            var childMap = SimdAffineMap.Compose(in map, in node.ChildMaps[child]);
            var childDepth = depth + 1;
            var childPath = path.Append(child, depth, node.ChildMapIndices[child], count, _object.GradientKind);
            while (childNode.ChildMaps.Length == 1 && childDepth < MaxDepth)
            {
                // Nothing to choose: the same seen more closely.
                childMap = SimdAffineMap.Compose(in childMap, in childNode.ChildMaps[0]);
                childPath = childPath.Append(0, childDepth, childNode.ChildMapIndices[0], 1, _object.GradientKind);
                childLevels = childNode.ChildLevelSteps[0].RemainingLevels(childLevels);
                childNode = _object.Hierarchy.NodeAt(childLevels);
                childDepth++;
            }

            if (footprint.NeedsDouble)
            {
                footprint = ComputeFootprint(childMap.Apply(childNode.Centre), childMap.TransformHalfSize(childNode.HalfSize));
                Visit(childNode, childLevels, in childMap, childDepth, childPath, in footprint);
            }
            else
            {
                VisitVisible(childNode, childLevels, in childMap, childDepth, childPath, in footprint);
            }
        }

        _stackTop = first;
    }

    /// <summary>The nearest first.</summary>
    private static void SortFrontToBack(Span<float> keys, Span<int> order)
    {
        if (keys.Length > MaxInsertionSortCount)
        {
            for (var i = 0; i < order.Length; i++)
            {
                order[i] = i;
            }

            keys.Sort(order);
            return;
        }

        for (var i = 0; i < keys.Length; i++)
        {
            var (key, slot) = (keys[i], i);
            for (; slot > 0 && keys[slot - 1] > key; slot--)
            {
                (keys[slot], order[slot]) = (keys[slot - 1], order[slot - 1]);
            }

            (keys[slot], order[slot]) = (key, i);
        }
    }

    /// <summary>The way to a sub-fractal.</summary>
    /// <param name="Hash">What tells it apart from others.</param>
    /// <param name="ColourPath">What its colour follows from; not kept where it has none of its own.</param>
    private readonly record struct CullingPath(ulong Hash, ColourPath ColourPath)
    {
        /// <summary>One copy further.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public CullingPath Append(int childIndex, int depth, int mapIndex, int childCount, GradientKind gradient) => new(
            ((Hash ^ (ulong)(childIndex + 1)) * 0x9E3779B97F4A7C15UL) + (ulong)depth, gradient == GradientKind.None
            ? ColourPath
            : ColourPath.Append(mapIndex, childIndex, childCount));
    }
}
