using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.DeepZoom;

/// <summary>A path of child instances from a whole fractal to one of its sub-fractals, at any depth.</summary>
/// <param name="hierarchy">Hierarchy of the fractal.</param>
internal sealed class FractalPath(LodHierarchy hierarchy)
{
    // Deeper in the path the weights are below the last place of a colour.
    private const int MaxColouredLevels = 64;

    private readonly List<int> _children = [];
    private readonly List<long> _remainingLevels = [hierarchy.LevelCount];

    // What places depend on beside their levels; empty where there is nothing.
    private readonly List<(ulong Way, long Size)> _ways = hierarchy.HasPicks ? [(hierarchy.Start.Way, hierarchy.Start.Size)] : [];

    // What the maps up to each depth mix into colours; empty where none does.
    private readonly List<Tint> _tints = hierarchy.HasColours ? [Tint.None] : [];

    // Of the first depths: paths of maps, and maps to the frame of the fractal.
    private readonly List<(ColourPath Path, AffineMap ToFractal)> _coloured = [(ColourPath.Start, AffineMap.Identity)];

    // The number of maps that are not the identity, up to each depth.
    private readonly List<int> _mapCounts = [0];

    /// <summary>Number of child instances in the path.</summary>
    public int Depth => _children.Count;

    /// <summary>Indices of the child instances, the outermost first.</summary>
    public IReadOnlyList<int> Children => _children;

    /// <summary>Node of the sub-fractal at the end of the path.</summary>
    public LodNode CurrentNode => NodeAt(Depth);

    /// <summary>Memory of the path in bytes.</summary>
    public long StorageBytes =>
        (sizeof(int) * ((long)_children.Capacity + _mapCounts.Capacity))
        + (sizeof(long) * ((long)_remainingLevels.Capacity + (2 * _ways.Capacity) + (4 * _tints.Capacity) + (14 * _coloured.Capacity)));

    /// <summary>Finds the node that the path passes through at a depth; 0 is the whole fractal.</summary>
    public LodNode NodeAt(int depth) => hierarchy.NodeAt(_remainingLevels[depth]);

    /// <summary>The place of the sub-fractal at a depth.</summary>
    public LevelState StateAt(int depth) => hierarchy.HasPicks
        ? new(_remainingLevels[depth], _ways[depth].Way, _ways[depth].Size)
        : new(_remainingLevels[depth]);

    /// <summary>The place of a child of the sub-fractal at a depth.</summary>
    public LevelState ChildState(int depth, int child) => hierarchy.Enter(NodeAt(depth), child, StateAt(depth));

    /// <summary>Finds the node of a child of the current sub-fractal.</summary>
    public LodNode ChildNode(int child) => hierarchy.NodeAt(ChildState(Depth, child).Level);

    /// <summary>Copies the path, so that one of the two can change alone.</summary>
    public FractalPath Clone()
    {
        var copy = new FractalPath(hierarchy);
        copy._children.AddRange(_children);
        copy._remainingLevels.AddRange(_remainingLevels.Skip(1));
        copy._ways.AddRange(_ways.Skip(1));
        copy._tints.AddRange(_tints.Skip(1));
        copy._coloured.AddRange(_coloured.Skip(1));
        copy._mapCounts.AddRange(_mapCounts.Skip(1));
        return copy;
    }

    /// <summary>Appends a child of the current sub-fractal.</summary>
    public void Enter(int child)
    {
        var node = CurrentNode;
        var state = ChildState(Depth, child);
        _remainingLevels.Add(state.Level);
        if (hierarchy.HasPicks)
        {
            _ways.Add((state.Way, state.Size));
        }

        if (hierarchy.HasColours)
        {
            _tints.Add(_tints[^1].Then(node.TintOf(child)));
        }

        if (Depth < MaxColouredLevels)
        {
            var (path, toFractal) = _coloured[^1];
            _coloured.Add((Append(path, node, child, ref toFractal), toFractal));
        }

        _children.Add(child);
        _mapCounts.Add(_mapCounts[^1] + (node.ChildMapIndices[child] < 0 ? 0 : 1));
    }

    /// <summary>Removes the last child instance, and returns its index.</summary>
    public int Leave()
    {
        var child = _children[^1];
        _children.RemoveAt(_children.Count - 1);
        _remainingLevels.RemoveAt(_remainingLevels.Count - 1);
        if (hierarchy.HasPicks)
        {
            _ways.RemoveAt(_ways.Count - 1);
        }

        if (hierarchy.HasColours)
        {
            _tints.RemoveAt(_tints.Count - 1);
        }

        if (Depth < MaxColouredLevels)
        {
            _coloured.RemoveAt(_coloured.Count - 1);
        }

        _mapCounts.RemoveAt(_mapCounts.Count - 1);
        return child;
    }

    /// <summary>Returns the colour path to the sub-fractal at a depth.</summary>
    /// <param name="depth">Number of child instances.</param>
    /// <param name="toFractal">Receives the map from its frame to that of the fractal, without maps too deep to be seen.</param>
    public ColourPath ColourPathTo(int depth, out AffineMap toFractal)
    {
        (var path, toFractal) = _coloured[Math.Min(depth, MaxColouredLevels)];
        return path with { MapCount = _mapCounts[depth] };
    }

    /// <summary>Appends a child instance to a colour path.</summary>
    /// <param name="path">The path to a sub-fractal.</param>
    /// <param name="node">The sub-fractal.</param>
    /// <param name="child">Index of the child.</param>
    /// <param name="toFractal">Map from the frame of the sub-fractal to that of the fractal; receives that of the child.</param>
    public ColourPath Append(ColourPath path, LodNode node, int child, ref AffineMap toFractal)
    {
        toFractal *= node.ChildMaps[child].ToAffineMap();
        path = path.Append(node.ChildMapIndices[child], node.SetSize);
        return node.ChildMapIndices[child] >= 0 && hierarchy.WholeBounds is { } bounds
            ? path.PassBy(toFractal * bounds.Centre, bounds) : path;
    }

    /// <summary>What the maps that lead to the sub-fractal at a depth mix into colours.</summary>
    public Tint TintTo(int depth) => hierarchy.HasColours ? _tints[depth] : Tint.None;
}
