using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.DeepZoom;

/// <summary>Which sub-fractal a camera is in: it changes as the camera comes near another one.</summary>
/// <param name="hierarchy">Hierarchy of the fractal.</param>
/// <param name="path">The path to the sub-fractal, which this changes.</param>
/// <param name="frameToCamera">Map from the sub-fractal's frame to world axes about the camera, in scene units.</param>
internal sealed class CameraFrame(LodHierarchy hierarchy, FractalPath path, AffineMap frameToCamera)
{
    // A sub-fractal is entered within the first multiple of its box's diagonal, and left beyond the second: in between nothing changes.
    private const double EnterDistanceRatio = 0.5;
    private const double LeaveDistanceRatio = 1.5;

    // What is closer than this fraction of the sub-fractal's size is small enough to have a frame of its own.
    private const double SwitchDistanceRatio = 0.02;
    private const int MovesBeforeSwitch = 6;

    // Smallest determinant of a frame whose largest entry is 1.
    private const double MinRelativeDeterminant = 1e-8;

    // The closest surface may belong to any ancestor, up to where ancestors are too large for it to matter.
    private const int MaxSearchedAncestors = 30;

    // Sub-fractals larger than this, in the present unit, show nothing beyond what smaller ones show.
    private const double MaxFrameScale = 1e15;

    // A move tells the position to about this part of its length and of the distance before: what is smaller can't be entered by it.
    private const double MoveResolution = 1e-16;

    private readonly ClosestNodeSearch _search = new(hierarchy);
    private int _movesSinceFrameChange;

    // Natural logarithm of the smallest unit that the present move can lead to, scene units. Within a solid without a smallest level,
    // sub-fractals are entered without end otherwise.
    private double _smallestUnit = double.NegativeInfinity;

    /// <summary>The path to the sub-fractal.</summary>
    public FractalPath Path { get; } = path;

    /// <summary>Map from the sub-fractal's frame to world axes about the camera, in the present unit.</summary>
    public AffineMap FrameToCamera { get; private set; } = frameToCamera;

    /// <summary>The natural logarithm of the present unit, in scene units.</summary>
    public double LogUnit { get; private set; }

    /// <summary>Diagonal of the sub-fractal's box about the camera, in the present unit.</summary>
    public double CurrentDiagonal => Path.CurrentNode.Box.Transform(FrameToCamera).Diagonal;

    private int Depth => Path.Depth;

    /// <summary>Copies the frame with its path, so that one of the two can move alone.</summary>
    public CameraFrame Clone() => new(hierarchy, Path.Clone(), FrameToCamera)
    {
        _movesSinceFrameChange = _movesSinceFrameChange,
        LogUnit = LogUnit,
    };

    /// <summary>Makes the frame of the same camera relative to another sub-fractal, in the same unit.</summary>
    /// <param name="depth">Number of child instances of the path that lead to it, or to its parent.</param>
    /// <param name="child">Index of the child there; −1 for none.</param>
    /// <param name="frameToCamera">Map from its frame to world axes about the camera.</param>
    public CameraFrame RelativeTo(int depth, int child, AffineMap frameToCamera)
    {
        var relative = Clone();
        while (relative.Depth > depth)
        {
            relative.Path.Leave();
        }

        if (child >= 0)
        {
            relative.Path.Enter(child);
        }

        relative.FrameToCamera = frameToCamera;
        return relative;
    }

    /// <summary>Moves the camera, and changes the frame as it comes near another sub-fractal.</summary>
    /// <param name="displacement">World axes, in the present unit; finite.</param>
    public void Move(Vector displacement)
    {
        var reach = Math.Max(FrameToCamera.Translation.MaxAbsComponent(), displacement.MaxAbsComponent());
        _smallestUnit = LogUnit + Math.Log(MoveResolution * reach);
        FrameToCamera = FrameToCamera with { Translation = FrameToCamera.Translation - displacement };
        var depth = Depth;
        UpdateFrame();
        // Searching the closest surface takes long. It matters only after the camera has approached one for a while and entered nothing.
        _movesSinceFrameChange = Depth == depth ? _movesSinceFrameChange + 1 : 0;
        if (_movesSinceFrameChange == MovesBeforeSwitch)
        {
            _movesSinceFrameChange = 0;
            SwitchFrame();
            UpdateFrame();
        }
    }

    /// <summary>Computes the camera position in the frame of the sub-fractal.</summary>
    public Vector CameraPosition() => FrameToCamera.Inverse() * Vector.Zero;

    /// <summary>Computes the map from the frame of a sub-fractal on the path; null where that is too large for the unit.</summary>
    public AffineMap? FrameToCameraAt(int depth)
    {
        var frameToCamera = FrameToCamera;
        for (var ancestor = Depth - 1; ancestor >= depth; ancestor--)
        {
            frameToCamera *= Path.NodeAt(ancestor).ChildMaps[Path.Children[ancestor]].ToAffineMap().Inverse();
            if (!IsWithinScale(frameToCamera))
            {
                return null;
            }
        }

        return frameToCamera;
    }

    /// <summary>Searches the closest sub-fractal among the children of the present one and the siblings of its ancestors.</summary>
    /// <param name="relativeTolerance">As in <see cref="ClosestNodeSearch.Find"/>.</param>
    /// <returns>A result whose levels up are the number of levels to leave.</returns>
    public ClosestNodeSearch.Result FindClosestNode(double relativeTolerance)
    {
        _search.Clear();
        var frameToCamera = FrameToCamera;
        for (var depth = Depth; depth >= Math.Max(0, Depth - MaxSearchedAncestors); depth--)
        {
            var childOnPath = -1;
            if (depth < Depth)
            {
                // The child on the path has been added before.
                childOnPath = Path.Children[depth];
                frameToCamera *= Path.NodeAt(depth).ChildMaps[childOnPath].ToAffineMap().Inverse();
            }

            if (!IsWithinScale(frameToCamera))
            {
                break;
            }

            _search.AddStart(Path.StateAt(depth), frameToCamera, Depth - depth, childOnPath);
        }

        return _search.Find(relativeTolerance);
    }

    /// <summary>The distance of a position from a box; 0 inside.</summary>
    public static double DistanceToBox(BoundingBox box, Vector position) => Math.Sqrt(box.DistanceSquared(position));

    /// <summary>Whether what has a frame is not too large for the unit to show more than smaller sub-fractals do.</summary>
    public static bool IsWithinScale(AffineMap frameToCamera) =>
        frameToCamera.IsFinite() && !(frameToCamera.Linear.MaxAbsEntry() > MaxFrameScale);

    private void UpdateFrame()
    {
        while (TryLeave() || (IsNearWhole() && TryEnterClosestChild()))
        {
        }
    }

    /// <summary>Tells whether the camera is near what stands there, where the boxes of children hold much that does not.</summary>
    private bool IsNearWhole() => Depth > 0 || hierarchy.TrueBounds is not { } box
        || DistanceToBox(box, CameraPosition()) <= EnterDistanceRatio * box.Diagonal;

    private bool TryLeave()
    {
        var box = Path.CurrentNode.Box;
        if (Depth == 0 || !(DistanceToBox(box, CameraPosition()) > LeaveDistanceRatio * box.Diagonal))
        {
            return false;
        }

        Leave();
        return true;
    }

    /// <summary>Enters the child whose distance is smallest compared with its size, if it is close enough.</summary>
    private bool TryEnterClosestChild()
    {
        if (Depth >= FractalLimits.Depth.Value)
        {
            return false;
        }

        var node = Path.CurrentNode;
        var camera = CameraPosition();
        var closestChild = -1;
        var minRelativeDistance = double.PositiveInfinity;
        for (var child = 0; child < node.ChildMaps.Length; child++)
        {
            var childNode = Path.ChildNode(child);
            if (childNode.ChildMaps.Length == 0)
            {
                continue;
            }

            // The distance is measured in the child's own frame, by its own size.
            var childCamera = node.ChildMaps[child].ToAffineMap().Inverse() * camera;
            var relativeDistance = DistanceToBox(childNode.Box, childCamera) / childNode.Box.Diagonal;
            if (relativeDistance < minRelativeDistance)
            {
                closestChild = child;
                minRelativeDistance = relativeDistance;
            }
        }

        return minRelativeDistance <= EnterDistanceRatio && TryEnter(closestChild);
    }

    /// <summary>Enters a child, unless its frame is nearly singular or the path is too long.</summary>
    private bool TryEnter(int child)
    {
        var childToCamera = FrameToCamera * Path.CurrentNode.ChildMaps[child].ToAffineMap();
        if (Depth >= FractalLimits.Depth.Value || IsNearlySingular(childToCamera.Linear)
            || LogUnit + (Math.Log(Math.Abs(childToCamera.Linear.Determinant())) / 3) < _smallestUnit)
        {
            return false;
        }

        Path.Enter(child);
        SetFrame(childToCamera);
        return true;
    }

    private void Leave()
    {
        var child = Path.Leave();
        SetFrame(FrameToCamera * Path.CurrentNode.ChildMaps[child].ToAffineMap().Inverse());
    }

    /// <summary>Switches to the frame of the sub-fractal that is closest to the camera, wherever it belongs.</summary>
    /// <remarks>
    /// Where child instances overlap, the closest surface may belong to another one than that which the camera is in, and be far smaller.
    /// </remarks>
    private void SwitchFrame()
    {
        var closest = FindClosestNode(1);
        if (closest.Distance > SwitchDistanceRatio * CurrentDiagonal || !closest.IsFound)
        {
            return;
        }

        var childPath = _search.PathTo(closest);
        for (var i = 0; i < closest.LevelsUp; i++)
        {
            Leave();
        }

        foreach (var child in childPath)
        {
            if (Path.ChildNode(child).ChildMaps.Length == 0 || !TryEnter(child))
            {
                break;
            }
        }
    }

    /// <summary>Tests whether a frame is so skewed that coordinates in it have no precision.</summary>
    /// <remarks>
    /// Skewed maps get there some ten levels after double precision fails from outside.
    /// </remarks>
    private static bool IsNearlySingular(Matrix linear)
    {
        var maxEntry = linear.MaxAbsEntry();
        return !(Math.Abs((linear / maxEntry).Determinant()) > MinRelativeDeterminant);
    }

    /// <summary>Sets the frame, and changes the unit so that the frame has it.</summary>
    private void SetFrame(AffineMap frameToCamera)
    {
        // Relative to the whole fractal, lengths are in scene units again.
        var scale = Depth == 0 ? Math.Exp(-LogUnit) : Math.Cbrt(Math.Abs(frameToCamera.Linear.Determinant()));
        FrameToCamera = new(frameToCamera.Linear / scale, frameToCamera.Translation / scale);
        LogUnit = Depth == 0 ? 0 : LogUnit + Math.Log(scale);
    }
}
