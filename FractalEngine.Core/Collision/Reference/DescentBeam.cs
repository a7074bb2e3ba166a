using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Reference;

/// <summary>The copies of one level that a descent of some width goes on with; kept for the next query.</summary>
internal sealed class DescentBeam
{
    private readonly List<Candidate> _candidates = [];
    private readonly List<(int Parent, int Copy)> _pathNodes = [];
    private List<Entry> _next = [];
    private int _width;

    /// <summary>A copy that the descent goes on with.</summary>
    /// <param name="Map">From its frame to that of the query.</param>
    /// <param name="LocalPosition">The position in its frame, where all maps are similar.</param>
    /// <param name="ScaleSquared">Of the map, where all maps are similar.</param>
    /// <param name="DistanceSquared">Distance of the base there.</param>
    /// <param name="ClosestFace">The nearest of the base there.</param>
    /// <param name="PathNode">Where its way from the root ends; −1 at the root.</param>
    public readonly record struct Entry(AffineMap Map, Vector LocalPosition, double ScaleSquared, double DistanceSquared, int ClosestFace,
        int PathNode);

    private readonly record struct Candidate(double DistanceSquared, int ParentEntry, int ChildIndex, int ClosestFace);

    /// <summary>Those of the present level, the nearest first.</summary>
    public List<Entry> Entries { get; private set; } = [];

    /// <summary>Candidates that are not nearer than this are not kept.</summary>
    public double CutoffSquared => _candidates.Count < _width ? double.PositiveInfinity : _candidates[^1].DistanceSquared;

    /// <summary>Begins a search.</summary>
    public void Begin(int width, in Entry root)
    {
        _width = width;
        _pathNodes.Clear();
        _candidates.Clear();
        Entries.Clear();
        Entries.Add(root);
    }

    /// <summary>
    /// Keeps a copy of an entry if it is nearer than <see cref="CutoffSquared"/>; of copies at the same distance the first.
    /// </summary>
    /// <param name="distanceSquared">Its distance.</param>
    /// <param name="parentEntry">The entry.</param>
    /// <param name="childIndex">Its number in the set; −1 for the entry itself, which goes on as it is.</param>
    /// <param name="closestFace">The nearest.</param>
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
    public void AdvanceLevel(MapSet set, bool hasOnlySimilarities)
    {
        _next.Clear();
        foreach (var (distanceSquared, parentEntry, childIndex, closestFace) in _candidates)
        {
            var entry = Entries[parentEntry];
            if (childIndex >= 0)
            {
                _pathNodes.Add((entry.PathNode, childIndex));
                entry = new(
                    entry.Map * set.Maps[childIndex], hasOnlySimilarities
                    ? set.Inverses[childIndex] * entry.LocalPosition
                    : entry.LocalPosition, entry.ScaleSquared * set.ScalesSquared[childIndex],
                    distanceSquared, closestFace, _pathNodes.Count - 1);
            }

            _next.Add(entry);
        }

        _candidates.Clear();
        (Entries, _next) = (_next, Entries);
    }

    /// <summary>Writes the way of the nearest entry.</summary>
    public void WritePath(QueryContext context)
    {
        for (var pathNode = Entries[0].PathNode; pathNode >= 0; pathNode = _pathNodes[pathNode].Parent)
        {
            context.AppendToPath(_pathNodes[pathNode].Copy);
        }

        context.ReversePath();
    }
}
