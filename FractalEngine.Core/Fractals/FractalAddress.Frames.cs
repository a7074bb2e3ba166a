using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;

namespace FractalEngine.Core.Fractals;

/// <content>Which sub-fractal the camera is in: it changes as the camera comes near another one.</content>
public sealed partial class FractalAddress
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

    /// <summary>Computes the camera position in the frame of the sub-fractal.</summary>
    private Vector CameraInFrame() => _frameToCamera.Inverse() * Vector.Zero;

    private void UpdateFrame()
    {
        while (TryLeave() || TryEnterClosestChild())
        {
        }
    }

    private bool TryLeave()
    {
        var box = _path.CurrentNode.Box;
        if (Depth == 0 || !(DistanceToBox(box, CameraInFrame()) > LeaveDistanceRatio * box.Diagonal))
        {
            return false;
        }

        Leave();
        return true;
    }

    /// <summary>Enters the child whose distance is smallest compared with its size, if it is close enough.</summary>
    private bool TryEnterClosestChild()
    {
        if (Depth >= FractalLimits.MaxDepth)
        {
            return false;
        }

        var node = _path.CurrentNode;
        var camera = CameraInFrame();
        var closestChild = -1;
        var minRelativeDistance = double.PositiveInfinity;
        for (var child = 0; child < node.ChildMaps.Length; child++)
        {
            var childNode = _path.ChildNode(child);
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
        var childToCamera = _frameToCamera * _path.CurrentNode.ChildMaps[child].ToAffineMap();
        if (Depth >= FractalLimits.MaxDepth || IsNearlySingular(childToCamera.Linear)
            || LogUnit + (Math.Log(Math.Abs(childToCamera.Linear.Determinant())) / 3) < _smallestUnit)
        {
            return false;
        }

        _path.Enter(child);
        SetFrame(childToCamera);
        return true;
    }

    private void Leave()
    {
        var child = _path.Leave();
        SetFrame(_frameToCamera * _path.CurrentNode.ChildMaps[child].ToAffineMap().Inverse());
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
            if (_path.ChildNode(child).ChildMaps.Length == 0 || !TryEnter(child))
            {
                break;
            }
        }
    }

    /// <summary>Searches the closest sub-fractal among the children of the present one and the siblings of its ancestors.</summary>
    /// <param name="relativeTolerance">As in <see cref="ClosestNodeSearch.Find"/>.</param>
    /// <returns>A result whose levels up are the number of levels to leave.</returns>
    private ClosestNodeSearch.Result FindClosestNode(double relativeTolerance)
    {
        _search.Clear();
        var frameToCamera = _frameToCamera;
        for (var depth = Depth; depth >= Math.Max(0, Depth - MaxSearchedAncestors); depth--)
        {
            var childOnPath = -1;
            if (depth < Depth)
            {
                // The child on the path has been added before.
                childOnPath = Path[depth];
                frameToCamera *= _path.NodeAt(depth).ChildMaps[childOnPath].ToAffineMap().Inverse();
            }

            if (!IsWithinScale(frameToCamera))
            {
                break;
            }

            _search.AddStart(_path.RemainingLevelsAt(depth), frameToCamera, Depth - depth, childOnPath);
        }

        return _search.Find(relativeTolerance);
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
        _frameToCamera = new(frameToCamera.Linear / scale, frameToCamera.Translation / scale);
        LogUnit = Depth == 0 ? 0 : LogUnit + Math.Log(scale);
    }

    private double DistanceTo(LodRoot root)
    {
        var node = _hierarchy.NodeAt(root.RemainingLevels);
        return node.IsEmpty ? double.PositiveInfinity : DistanceToBox(node.Box.Transform(root.FrameToCamera), Vector.Zero);
    }
}
