using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// Where a camera is in a fractal, at any depth: a sub-fractal near it, by the way that leads there, and its place relative to that. As the
/// camera moves, it is told relative to a sub-fractal further in or further out, so that all numbers stay about 1 and nothing loses
/// precision, however deep it goes.
/// </summary>
/// <remarks>
/// Replaces the paper's m ← m·t (§4.3.2), which keeps one matrix and loses it at about level 50. Memory: 16 bytes a level, at most <see
/// cref="FractalLimits.MaxDepth"/> levels. Lengths are in a unit that changes with the depth; perspective shows the same in any unit.
/// </remarks>
public sealed partial class FractalAddress
{
    // A sub-fractal is entered within this part of its box's diagonal, and left beyond the other: between them nothing changes.
    private const double EnterDistanceRatio = 0.5;
    private const double LeaveDistanceRatio = 1.5;

    // Of the distance: smaller parts are as far away as their boxes.
    private const double RelativeDistanceTolerance = 0.1;
    private const int MaxExpandedNodes = 2000;

    // Of the sub-fractal's size: what is nearer than this has parts enough of its own to be told relative to one.
    private const double SwitchDistanceRatio = 0.02;
    private const int MovesBeforeSwitch = 6;

    // In the present unit: of what is larger nothing is seen that is not seen nearer.
    private const double MaxFrameScale = 1e15;

    // Of the determinant, for a largest entry of 1.
    private const double MinRelativeDeterminant = 1e-8;

    private const int MaxColouredLevels = 64;

    // Of the whole: smaller sub-fractals are below the last place of a coordinate.
    private const double MinRelativeSize = 1e-17;

    // What is near may be part of any of those further out, up to where they are too large to come into it.
    private const int MaxSearchedAncestors = 30;

    private readonly LodHierarchy _hierarchy;
    private readonly List<int> _path = [];
    private readonly List<long> _remainingLevels = [];

    // Of the maps that are not the identity, up to each depth.
    private readonly List<int> _mapCounts = [0];
    private readonly PriorityQueue<(int Up, int Node), double> _open = new();
    private readonly List<(int Parent, int Child, long Levels, AffineMap Map)> _searchNodes = [];
    private double? _closestDistance;
    private AffineMap _frameToCamera;
    private int _movesSinceFrameChange;

    /// <summary>A camera outside, at the top.</summary>
    /// <param name="hierarchy">Of the fractal.</param>
    /// <param name="objectToWorld">The object's matrix m, from the fractal's frame to world space.</param>
    /// <param name="cameraPosition">Its position in world space.</param>
    public FractalAddress(LodHierarchy hierarchy, AffineMap objectToWorld, Vector cameraPosition)
    {
        _hierarchy = hierarchy;
        _frameToCamera = new(objectToWorld.Linear, objectToWorld.Translation - cameraPosition);
        _remainingLevels.Add(hierarchy.LevelCount);
    }

    /// <summary>How many copies lead to the sub-fractal.</summary>
    public int Depth => _path.Count;

    /// <summary>The way there: for each level the number of the copy.</summary>
    public IReadOnlyList<int> Path => _path;

    /// <summary>From the sub-fractal's frame to world axes about the camera, in the present unit.</summary>
    public AffineMap FrameToCamera => _frameToCamera;

    /// <summary>The natural logarithm of the present unit, in scene units.</summary>
    public double LogUnit { get; private set; }

    /// <summary>Bytes of the path.</summary>
    public long StorageBytes =>
        (sizeof(int) * ((long)_path.Capacity + _mapCounts.Capacity)) + (sizeof(long) * (long)_remainingLevels.Capacity);

    private LodNode CurrentNode => _hierarchy.NodeAt(_remainingLevels[^1]);

    /// <summary>Moves the camera, and tells its place anew.</summary>
    /// <param name="displacement">World axes, in the present unit; finite.</param>
    public void Move(Vector displacement)
    {
        _closestDistance = null;
        _frameToCamera = _frameToCamera with { Translation = _frameToCamera.Translation - displacement };
        var depth = Depth;
        UpdateFrame();
        // To look for what is nearest takes long; it matters only after the camera has come nearer for a while and nothing could be
        // entered.
        _movesSinceFrameChange = Depth == depth ? _movesSinceFrameChange + 1 : 0;
        if (_movesSinceFrameChange == MovesBeforeSwitch)
        {
            _movesSinceFrameChange = 0;
            SwitchFrame();
            UpdateFrame();
        }
    }

    /// <summary>What drawing begins with: the sub-fractal itself, and the other parts of those that it is in.</summary>
    /// <param name="maxAncestors">
    /// How many of these at most; what is further out, or 10¹⁵ times as large as the present unit, is not drawn.
    /// </param>
    public ImmutableArray<LodRoot> CollectRoots(int maxAncestors)
    {
        var roots = ImmutableArray.CreateBuilder<LodRoot>();
        roots.Add(new(_remainingLevels[^1], _frameToCamera, ColourPathTo(_path.Count)));
        var map = _frameToCamera;
        for (var i = _path.Count - 1; i >= Math.Max(0, _path.Count - maxAncestors); i--)
        {
            var node = _hierarchy.NodeAt(_remainingLevels[i]);
            map *= node.ChildMaps[_path[i]].ToAffineMap().Inverse();
            if (!map.IsFinite() || map.Linear.MaxAbsEntry() > MaxFrameScale)
            {
                break;
            }

            var colourPath = ColourPathTo(i);
            for (var child = 0; child < node.ChildMaps.Length; child++)
            {
                if (child != _path[i])
                {
                    roots.Add(new(
                        ChildRemainingLevels(_remainingLevels[i], node.ChildLevelSteps[child]), map * node.ChildMaps[child].ToAffineMap(),
                        colourPath.Append(node.ChildMapIndices[child], child, node.ChildMaps.Length)));
                }
            }
        }

        // The nearest first: they hide the others.
        return [.. roots.OrderBy(root => _hierarchy.NodeAt(root.RemainingLevels) is { IsEmpty: false } node
            ? DistanceToBox(node.Box.Transform(root.FrameToCamera), Vector.Zero)
            : double.PositiveInfinity)];
    }

    /// <summary>The camera's place in world space, as far as a double can tell it.</summary>
    /// <param name="objectToWorld">The object's matrix m.</param>
    public Vector WorldPosition(AffineMap objectToWorld)
    {
        var (map, depth, minDiagonal) =
            (objectToWorld, 0, MinRelativeSize * _hierarchy.NodeAt(_hierarchy.LevelCount).Box.Transform(objectToWorld).Diagonal);
        for (; depth < Depth && _hierarchy.NodeAt(_remainingLevels[depth]).Box.Transform(map).Diagonal > minDiagonal; depth++)
        {
            map *= _hierarchy.NodeAt(_remainingLevels[depth]).ChildMaps[_path[depth]].ToAffineMap();
        }

        return map * (depth == Depth ? _frameToCamera.Inverse() * Vector.Zero : _hierarchy.NodeAt(_remainingLevels[depth]).Box.Centre);
    }

    /// <summary>How far away the farthest drawn part can be, in the present unit.</summary>
    public double MaxDrawDistance(ImmutableArray<LodRoot> roots) => roots.Max(root =>
        _hierarchy.NodeAt(root.RemainingLevels) is { IsEmpty: false, Box: var box } && box.Transform(root.FrameToCamera) is var image
        ? image.Centre.Length() + image.Diagonal
        : 0);

    /// <summary>What leads to the sub-fractal that so many copies of the path lead to.</summary>
    private ColourPath ColourPathTo(int depth)
    {
        // Further down the weights are below the last place of a colour.
        var colourPath = ColourPath.Start;
        for (var i = 0; i < Math.Min(depth, MaxColouredLevels); i++)
        {
            var node = _hierarchy.NodeAt(_remainingLevels[i]);
            colourPath = colourPath.Append(node.ChildMapIndices[_path[i]], _path[i], node.ChildMaps.Length);
        }

        return colourPath with { MapCount = _mapCounts[depth] };
    }

    private static long ChildRemainingLevels(long remainingLevels, LevelStep levelStep) =>
        levelStep.RemainingLevels(remainingLevels);

    /// <summary>The distance of the camera from a box.</summary>
    private static double DistanceToBox(BoundingBox box, Vector position) => Math.Sqrt(box.DistanceSquared(position));

    private void UpdateFrame()
    {
        while (TryLeave() || TryEnter())
        {
        }
    }

    private bool TryLeave()
    {
        if (_path.Count == 0
            || !(DistanceToBox(CurrentNode.Box, _frameToCamera.Inverse() * Vector.Zero) > LeaveDistanceRatio * CurrentNode.Box.Diagonal))
        {
            return false;
        }

        Leave();
        return true;
    }

    private bool TryEnter()
    {
        var (node, camera) = (CurrentNode, _frameToCamera.Inverse() * Vector.Zero);
        var (closestChild, minRelativeDistance) = (-1, double.PositiveInfinity);
        for (var child = 0; child < node.ChildMaps.Length && _path.Count < FractalLimits.MaxDepth; child++)
        {
            var childNode = _hierarchy.NodeAt(ChildRemainingLevels(_remainingLevels[^1], node.ChildLevelSteps[child]));
            if (childNode.ChildMaps.Length > 0)
            {
                // In the copy's own frame, by its own size.
                var distance =
                    DistanceToBox(childNode.Box, node.ChildMaps[child].ToAffineMap().Inverse() * camera) / childNode.Box.Diagonal;
                (closestChild, minRelativeDistance) = distance < minRelativeDistance
                    ? (child, distance)
                    : (closestChild, minRelativeDistance);
            }
        }

        return minRelativeDistance <= EnterDistanceRatio && TryEnter(closestChild);
    }

    private bool TryEnter(int child)
    {
        var node = CurrentNode;
        if (_path.Count >= FractalLimits.MaxDepth || IsNearlySingular(_frameToCamera.Linear * node.ChildMaps[child].ToAffineMap().Linear))
        {
            return false;
        }

        _remainingLevels.Add(ChildRemainingLevels(_remainingLevels[^1], node.ChildLevelSteps[child]));
        _path.Add(child);
        _mapCounts.Add(_mapCounts[^1] + (node.ChildMapIndices[child] < 0 ? 0 : 1));
        NormalizeUnit(_frameToCamera * node.ChildMaps[child].ToAffineMap());
        return true;
    }

    private void Leave()
    {
        var child = _path[^1];
        _path.RemoveAt(_path.Count - 1);
        _remainingLevels.RemoveAt(_remainingLevels.Count - 1);
        _mapCounts.RemoveAt(_mapCounts.Count - 1);
        NormalizeUnit(_frameToCamera * CurrentNode.ChildMaps[child].ToAffineMap().Inverse());
    }

    /// <summary>
    /// True for a frame so skewed that places in it can't be told. Maps that stretch one direction more than another come there after some
    /// ten levels of more than double precision can tell from outside.
    /// </summary>
    private static bool IsNearlySingular(Matrix linear)
    {
        var maxEntry = linear.MaxAbsEntry();
        return !(Math.Abs((linear / maxEntry).Determinant()) > MinRelativeDeterminant);
    }

    /// <summary>Chooses the unit so that the sub-fractal's frame has it.</summary>
    private void NormalizeUnit(AffineMap frameToCamera)
    {
        var scale = Math.Cbrt(Math.Abs(frameToCamera.Linear.Determinant()));
        if (Depth == 0)
        {
            // Outside, lengths are in scene units again.
            scale = Math.Exp(-LogUnit);
        }

        _frameToCamera = new(frameToCamera.Linear / scale, frameToCamera.Translation / scale);
        LogUnit += Math.Log(scale);
        if (Depth == 0)
        {
            LogUnit = 0;
        }
    }
}
