using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries;

/// <summary>
/// The instances of one level that the paper's descent enters, up to some number. The memory is kept for the next query.
/// </summary>
internal sealed class DescentBeam
{
    private readonly List<Candidate> _candidates = [];
    private readonly List<PathNode> _pathNodes = [];
    private List<Entry> _next = [];
    private int _width;

    /// <summary>The entries of the present level, the closest first.</summary>
    public List<Entry> Entries { get; private set; } = [];

    /// <summary>Squared distance from which on candidates are not kept.</summary>
    public double CutoffSquared => _candidates.Count < _width ? double.PositiveInfinity : _candidates[^1].DistanceSquared;

    /// <summary>Empties the beam for another search.</summary>
    /// <param name="width">Maximum number of entries of a level.</param>
    /// <param name="root">The entry of the whole fractal.</param>
    public void Begin(int width, in Entry root)
    {
        _width = width;
        _pathNodes.Clear();
        _candidates.Clear();
        Entries.Clear();
        Entries.Add(root);
    }

    /// <summary>
    /// Keeps a child of an entry if it is closer than <see cref="CutoffSquared"/>. Of children at the same distance the first is kept.
    /// </summary>
    /// <param name="distanceSquared">Squared distance of the child's base mesh.</param>
    /// <param name="parentEntry">Index of the entry.</param>
    /// <param name="childIndex">Index of the child's map in the set; −1 for the entry itself, which goes on without a map.</param>
    /// <param name="closestFace">Face index of the closest triangle in the child's base mesh.</param>
    public void InsertIfCloser(double distanceSquared, int parentEntry, int childIndex, int closestFace)
    {
        if (!(distanceSquared < CutoffSquared))
        {
            return;
        }

        if (_candidates.Count == _width)
        {
            _candidates.RemoveAt(_width - 1);
        }

        var insertionIndex = _candidates.Count;
        while (insertionIndex > 0 && distanceSquared < _candidates[insertionIndex - 1].DistanceSquared)
        {
            insertionIndex--;
        }

        _candidates.Insert(insertionIndex, new(distanceSquared, parentEntry, childIndex, closestFace));
    }

    /// <summary>Makes the candidates the entries of the next level.</summary>
    /// <param name="set">The set of the present level.</param>
    /// <param name="hasOnlySimilarities">True when all maps of the fractal are similarities.</param>
    public void AdvanceLevel(MapSet set, bool hasOnlySimilarities)
    {
        _next.Clear();
        foreach (var candidate in _candidates)
        {
            var parent = Entries[candidate.ParentEntry];
            _next.Add(candidate.ChildIndex < 0 ? parent : CreateEntry(parent, candidate, set, hasOnlySimilarities));
        }

        _candidates.Clear();
        (Entries, _next) = (_next, Entries);
    }

    /// <summary>Writes the path of the closest entry.</summary>
    public void WritePath(QueryContext context)
    {
        for (var node = Entries[0].PathNode; node >= 0; node = _pathNodes[node].Parent)
        {
            context.AppendToPath(_pathNodes[node].ChildIndex);
        }

        context.ReversePath();
    }

    private Entry CreateEntry(in Entry parent, Candidate candidate, MapSet set, bool hasOnlySimilarities)
    {
        var childIndex = candidate.ChildIndex;
        _pathNodes.Add(new(parent.PathNode, childIndex));
        return new(
            parent.Map * set.Maps[childIndex],
            hasOnlySimilarities ? set.Inverses[childIndex] * parent.LocalPosition : parent.LocalPosition,
            parent.ScaleSquared * set.ScalesSquared[childIndex],
            candidate.DistanceSquared,
            candidate.ClosestFace,
            _pathNodes.Count - 1);
    }

    /// <summary>An instance that the descent goes on in.</summary>
    /// <param name="Map">From its frame to that of the query.</param>
    /// <param name="LocalPosition">Position of the query in its frame; used where all maps are similarities.</param>
    /// <param name="ScaleSquared">Squared scale of the map; used where all maps are similarities.</param>
    /// <param name="DistanceSquared">Squared distance of the base mesh in its frame.</param>
    /// <param name="ClosestFace">Face index of the closest triangle in that base mesh.</param>
    /// <param name="PathNode">Index of the last node of its path; −1 at the root.</param>
    public readonly record struct Entry(
        AffineMap Map, Vector LocalPosition, double ScaleSquared, double DistanceSquared, int ClosestFace, int PathNode);

    /// <summary>An instance that may become an entry of the next level, see <see cref="InsertIfCloser"/>.</summary>
    private readonly record struct Candidate(double DistanceSquared, int ParentEntry, int ChildIndex, int ClosestFace);

    /// <summary>A map on the path of an entry, and the node before it.</summary>
    private readonly record struct PathNode(int Parent, int ChildIndex);
}
