using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>The copies of one level that a descent of some width goes on with; kept for the next query.</summary>
internal sealed class DescentBeam
{
    private readonly List<Candidate> _candidates = [];
    private readonly List<(int Parent, int Copy)> _trail = [];
    private List<Entry> _next = [];
    private int _width;

    /// <summary>A copy that the descent goes on with.</summary>
    /// <param name="Map">From its frame to that of the query.</param>
    /// <param name="Local">The position in its frame, where all maps are similar.</param>
    /// <param name="ScaleSquared">Of the map, where all maps are similar.</param>
    /// <param name="Squared">Distance of the base there.</param>
    /// <param name="Face">The nearest of the base there.</param>
    /// <param name="Trail">Where its way from the root ends; −1 at the root.</param>
    public readonly record struct Entry(AffineMap Map, Vector Local, double ScaleSquared, double Squared, int Face, int Trail);

    private readonly record struct Candidate(double Squared, int Parent, int Copy, int Face);

    /// <summary>Those of the present level, the nearest first.</summary>
    public List<Entry> Entries { get; private set; } = [];

    /// <summary>Candidates that are not nearer than this are not kept.</summary>
    public double Limit => _candidates.Count < _width ? double.PositiveInfinity : _candidates[^1].Squared;

    /// <summary>Begins a search.</summary>
    public void Begin(int width, in Entry root)
    {
        _width = width;
        _trail.Clear();
        _candidates.Clear();
        Entries.Clear();
        Entries.Add(root);
    }

    /// <summary>Keeps a copy of an entry if it is nearer than <see cref="Limit"/>; of copies at the same distance the first.</summary>
    /// <param name="squared">Its distance.</param>
    /// <param name="parent">The entry.</param>
    /// <param name="copy">Its number in the set; −1 for the entry itself, which goes on as it is.</param>
    /// <param name="face">The nearest.</param>
    public void Offer(double squared, int parent, int copy, int face)
    {
        if (!(squared < Limit))
        {
            return;
        }

        if (_candidates.Count == _width)
        {
            _candidates.RemoveAt(_width - 1);
        }

        var place = _candidates.Count;
        while (place > 0 && squared < _candidates[place - 1].Squared)
        {
            place--;
        }

        _candidates.Insert(place, new(squared, parent, copy, face));
    }

    /// <summary>Makes the candidates the entries of the next level.</summary>
    public void Descend(CopySet set, bool isSimilar)
    {
        _next.Clear();
        foreach (var (squared, parent, copy, face) in _candidates)
        {
            var entry = Entries[parent];
            if (copy >= 0)
            {
                _trail.Add((entry.Trail, copy));
                entry = new(
                    entry.Map * set.Maps[copy], isSimilar ? set.Inverses[copy] * entry.Local : entry.Local, entry.ScaleSquared * set.ScaleSquared[copy],
                    squared, face, _trail.Count - 1);
            }

            _next.Add(entry);
        }

        _candidates.Clear();
        (Entries, _next) = (_next, Entries);
    }

    /// <summary>Writes the way of the nearest entry.</summary>
    public void WritePath(QueryRecord record)
    {
        for (var trail = Entries[0].Trail; trail >= 0; trail = _trail[trail].Parent)
        {
            record.AppendToPath(_trail[trail].Copy);
        }

        record.ReversePath();
    }
}
