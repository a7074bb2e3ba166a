using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <content>What is nearest to the camera.</content>
public sealed partial class FractalAddress
{
    /// <summary>
    /// About how far the nearest surface is, in the present unit: to a tenth, unless more than some thousand parts are about as near. To
    /// the box of the base mesh, where that is near.
    /// </summary>
    public double ClosestSurfaceDistance()
    {
        // Asked for several times a picture; it changes with the place only.
        if (_closestDistance is { } cached)
        {
            return cached;
        }

        var node = CurrentNode;
        var distance = node.ChildMaps.Length == 0
            ? DistanceToBox(node.Box.Transform(_frameToCamera), Vector.Zero)
            : FindClosestNode(RelativeDistanceTolerance, out _, out _);
        // Among parts that are never far, as in a solid: the scale of what is around.
        _closestDistance = Math.Max(distance, 1e-3 * node.Box.Transform(_frameToCamera).Diagonal);
        return _closestDistance.Value;
    }

    /// <summary>
    /// Where copies overlap, what is nearest may be in another one than that which the camera is in, and far smaller than it: then the
    /// camera is told relative to that one.
    /// </summary>
    private void SwitchFrame()
    {
        if (FindClosestNode(1, out var levelsUp, out var node) > SwitchDistanceRatio * CurrentNode.Box.Transform(_frameToCamera).Diagonal
            || node < 0)
        {
            return;
        }

        var childPath = new List<int>();
        for (; _searchNodes[node].Parent >= 0; node = _searchNodes[node].Parent)
        {
            childPath.Insert(0, _searchNodes[node].Child);
        }

        for (; levelsUp > 0; levelsUp--)
        {
            Leave();
        }

        foreach (var child in childPath)
        {
            if (_hierarchy.NodeAt(ChildRemainingLevels(_remainingLevels[^1], CurrentNode.ChildLevelSteps[child])).ChildMaps.Length == 0
                || !TryEnter(child))
            {
                break;
            }
        }
    }

    /// <summary>Finds a part that is small compared with how near it is.</summary>
    /// <param name="relativeTolerance">What counts as small, as a part of the distance.</param>
    /// <param name="levelsUp">How many copies to leave to come there.</param>
    /// <param name="node">Its number among <see cref="_searchNodes"/>, which lead back to what was left for it; −1 for none.</param>
    /// <returns>Its distance.</returns>
    private double FindClosestNode(double relativeTolerance, out int levelsUp, out int node)
    {
        _searchNodes.Clear();
        _open.Clear();
        var map = _frameToCamera;
        for (var i = _path.Count; i >= Math.Max(0, _path.Count - MaxSearchedAncestors); i--)
        {
            // What was left is a part of what it was left for, and would be met twice.
            var excludedChild = i == _path.Count ? -1 : _path[i];
            map = i == _path.Count ? map : map * _hierarchy.NodeAt(_remainingLevels[i]).ChildMaps[_path[i]].ToAffineMap().Inverse();
            if (!map.IsFinite() || map.Linear.MaxAbsEntry() > MaxFrameScale)
            {
                break;
            }

            _searchNodes.Add((-1, -1, _remainingLevels[i], map));
            ExpandNode(_path.Count - i, _searchNodes.Count - 1, excludedChild);
        }

        var (closestDistance, found) = (0.0, (Up: 0, Node: -1));
        for (var expandedCount = 0; expandedCount < MaxExpandedNodes && _open.TryDequeue(out found, out closestDistance); expandedCount++)
        {
            var (_, _, remainingLevels, nodeToCamera) = _searchNodes[found.Node];
            var lodNode = _hierarchy.NodeAt(remainingLevels);
            if (lodNode.ChildMaps.Length == 0 || lodNode.Box.Transform(nodeToCamera).Diagonal <= relativeTolerance * closestDistance)
            {
                break;
            }

            ExpandNode(found.Up, found.Node, -1);
        }

        (levelsUp, node) = found;
        return closestDistance;
    }

    /// <summary>Puts the copies of a part into the queue, but for the one that was left.</summary>
    private void ExpandNode(int levelsUp, int parent, int excludedChild)
    {
        var (_, _, remainingLevels, map) = _searchNodes[parent];
        var node = _hierarchy.NodeAt(remainingLevels);
        for (var child = 0; child < node.ChildMaps.Length; child++)
        {
            var childLevels = ChildRemainingLevels(remainingLevels, node.ChildLevelSteps[child]);
            if (child != excludedChild && !_hierarchy.NodeAt(childLevels).IsEmpty)
            {
                var childMap = map * node.ChildMaps[child].ToAffineMap();
                _searchNodes.Add((parent, child, childLevels, childMap));
                _open.Enqueue((levelsUp, _searchNodes.Count - 1),
                    DistanceToBox(_hierarchy.NodeAt(childLevels).Box.Transform(childMap), Vector.Zero));
            }
        }
    }
}
