using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.DeepZoom;

/// <summary>Searches the sub-fractal closest to a camera, best first by the distance of bounding boxes.</summary>
/// <remarks>
/// The search starts from several sub-fractals: add them, search, and read the path of the result. The lists are reused, so that repeated
/// searches allocate nothing.
/// </remarks>
/// <param name="hierarchy">Hierarchy of the fractal.</param>
internal sealed class ClosestNodeSearch(LodHierarchy hierarchy)
{
    private const int MaxExpandedNodes = 2000;

    private readonly PriorityQueue<int, double> _open = new();
    private readonly List<PathNode> _nodes = [];

    /// <summary>Begins a new search, without any start.</summary>
    public void Clear()
    {
        _nodes.Clear();
        _open.Clear();
    }

    /// <summary>Adds the children of a sub-fractal as starts of the search.</summary>
    /// <param name="state">The place of the sub-fractal.</param>
    /// <param name="frameToCamera">Map from its frame to world axes about the camera.</param>
    /// <param name="levelsUp">Number that tells the starts apart, see <see cref="Result"/>.</param>
    /// <param name="excludedChild">Index of a child that is not added; −1 for none.</param>
    public void AddStart(LevelState state, AffineMap frameToCamera, int levelsUp, int excludedChild = -1)
    {
        _nodes.Add(new(-1, -1, levelsUp, state, frameToCamera));
        Expand(_nodes.Count - 1, excludedChild);
    }

    /// <summary>Searches until the closest sub-fractal has no children, or is small compared with its distance.</summary>
    /// <param name="relativeTolerance">Size of a box, as a fraction of its distance, from which on it is not expanded.</param>
    /// <remarks>
    /// After 2,000 expanded sub-fractals the last one is taken. The distance is too short by at most the diagonal of the found box.
    /// </remarks>
    public Result Find(double relativeTolerance)
    {
        var closest = new Result(0, 0, -1);
        for (var expandedCount = 0; expandedCount < MaxExpandedNodes && _open.TryDequeue(out var index, out var distance); expandedCount++)
        {
            var found = _nodes[index];
            closest = new(distance, found.LevelsUp, index);
            var node = hierarchy.NodeAt(found.State.Level);
            if (node.ChildMaps.Length == 0 || node.Box.Transform(found.FrameToCamera).Diagonal <= relativeTolerance * distance)
            {
                break;
            }

            Expand(index, -1);
        }

        return closest;
    }

    /// <summary>Lists the child indices that lead from a start to a found sub-fractal.</summary>
    public List<int> PathTo(Result result)
    {
        var path = new List<int>();
        for (var index = result.Index; _nodes[index].Parent >= 0; index = _nodes[index].Parent)
        {
            path.Add(_nodes[index].Child);
        }

        path.Reverse();
        return path;
    }

    private void Expand(int parent, int excludedChild)
    {
        var (_, _, levelsUp, state, frameToCamera) = _nodes[parent];
        var node = hierarchy.NodeAt(state.Level);
        for (var child = 0; child < node.ChildMaps.Length; child++)
        {
            var childState = hierarchy.Enter(node, child, in state);
            var childNode = hierarchy.NodeAt(childState.Level);
            if (child == excludedChild || childNode.IsEmpty)
            {
                continue;
            }

            var childToCamera = frameToCamera * node.ChildMaps[child].ToAffineMap();
            _nodes.Add(new(parent, child, levelsUp, childState, childToCamera));
            _open.Enqueue(_nodes.Count - 1, Math.Sqrt(childNode.Box.Transform(childToCamera).DistanceSquared(Vector.Zero)));
        }
    }

    /// <summary>The closest sub-fractal of a search.</summary>
    /// <param name="Distance">Distance of its box from the camera; 0 without any sub-fractal.</param>
    /// <param name="LevelsUp">Number given to the start that it was reached from.</param>
    /// <param name="Index">Index of the sub-fractal within the search; −1 for none.</param>
    internal readonly record struct Result(double Distance, int LevelsUp, int Index)
    {
        /// <summary>Whether there is a sub-fractal at all.</summary>
        public bool IsFound => Index >= 0;
    }

    private readonly record struct PathNode(int Parent, int Child, int LevelsUp, LevelState State, AffineMap FrameToCamera);
}
