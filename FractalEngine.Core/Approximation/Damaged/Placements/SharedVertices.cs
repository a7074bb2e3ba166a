using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>
/// The vertices that decimated images of one element have together, in the frame of the first one. Edge collapses leave many vertices
/// where they were, and others end in the middle of the same edge; two faces that meet in such vertices fix a map between elements, and
/// more vertices at the same places prove it. So each element that is placed tells more vertices, by which the next ones are placed.
/// </summary>
internal sealed class SharedVertices
{
    /// <summary>So many vertices at the same places are no chance, of which a map is fixed by four.</summary>
    public const int MinShared = 6;

    // Vertices at the same place, in units of the first element.
    private const double Tolerance = 1e-5;

    // So many vertices, and that part of all, end the search for a map that more agree with.
    private const int ClearlyShared = 10;
    private const double ClearPart = 0.4;

    // What two faces span, in units of the element, changes little from one element to another.
    private const double MaxVolumeRatio = 2;

    // Elements are looked for at so many pairs of faces, those first that most elements have.
    private const int MaxFrames = 300;

    // Of so many vertices one is shared, or hardly any is.
    private const int MinTested = 24;

    // Vertices that are no chance stand in that part of the elements.
    private const double SolidPart = 1.0 / 6;
    private const int MinElements = 3;
    private const int MaxSymmetries = 240;
    private const double SameMap = 1e-3;

    private readonly DecimatedElement _first;
    private readonly List<Vector> _points = [];
    private readonly List<int> _counts = [];
    private readonly Dictionary<(int A, int B, int C, int D), int> _frameCounts = [];
    private (Vector Corner, Matrix Axes, double Volume)[] _frames = [];
    private PointGrid _grid;
    private int _elementCount;

    /// <param name="first">The element in whose frame all vertices are.</param>
    public SharedVertices(DecimatedElement first)
    {
        _first = first;
        _grid = new(_points, Tolerance * first.Shape.Size);
        Add(first, AffineMap.Identity);
    }

    /// <summary>Adds the vertices of an element.</summary>
    /// <param name="element">The element.</param>
    /// <param name="map">The map that takes it to the first one.</param>
    public void Add(DecimatedElement element, AffineMap map)
    {
        var indices = Array.ConvertAll(element.Shape.Points, point =>
        {
            var index = Find(map * point);
            if (index < 0)
            {
                index = _points.Count;
                _points.Add(map * point);
                _counts.Add(0);
            }

            _counts[index]++;
            return index;
        });
        _grid = new(_points, Tolerance * _first.Shape.Size);
        foreach (var (a, b, c, d) in element.Frames)
        {
            var (edge, ends) = (Sorted(indices[a], indices[b]), Sorted(indices[c], indices[d]));
            var key = (edge.Item1, edge.Item2, ends.Item1, ends.Item2);
            _frameCounts[key] = _frameCounts.GetValueOrDefault(key) + 1;
        }

        _elementCount++;
        _frames = [.. _frameCounts.OrderByDescending(frame => frame.Value).ThenBy(frame => frame.Key).Take(MaxFrames).Select(frame =>
        {
            var (a, b, c, d) = frame.Key;
            var axes = new Matrix(_points[b] - _points[a], _points[c] - _points[a], _points[d] - _points[a]);
            return (_points[a], axes, Math.Abs(axes.Determinant()) / _first.Volume);
        })];

        static (int, int) Sorted(int index1, int index2) => (Math.Min(index1, index2), Math.Max(index1, index2));
    }

    /// <summary>Returns the map of an element to the first one that most vertices agree with, and how many these are.</summary>
    /// <param name="element">The element.</param>
    /// <param name="isWeighted">Whether vertices count as often as elements have them; else a map that is clear enough is taken.</param>
    public (AffineMap Map, int Shared) Match(DecimatedElement element, bool isWeighted)
    {
        var (best, most, shared) = (AffineMap.Identity, 0, 0);
        var enough = isWeighted ? int.MaxValue : Math.Max(ClearlyShared, ClearPart * element.Shape.Points.Length);
        foreach (var map in MapsOf(element))
        {
            var count = CountShared(map, element.Shape.Points, isWeighted ? Math.Max(MinShared - 1, shared / 2) : most);
            var weight = isWeighted && count > 0
                ? element.Shape.Points.Sum(point => Find(map * point) is var index && index >= 0 ? _counts[index] : 0) : count;
            if (weight > most)
            {
                (best, most, shared) = (map, weight, count);
                if (most >= enough)
                {
                    break;
                }
            }
        }

        return (Fit(best, element.Shape.Points), shared);
    }

    /// <summary>Finds the maps that take vertices that many elements have to vertices, the identity first.</summary>
    /// <param name="part">What part of these vertices they take to others at least.</param>
    public List<AffineMap> FindSymmetries(double part)
    {
        var least = Math.Max(MinElements, SolidPart * _elementCount);
        var solid = _points.Where((_, index) => _counts[index] >= least).ToArray();
        var needed = (int)(part * solid.Length);
        List<AffineMap> symmetries = [AffineMap.Identity];
        foreach (var map in MapsOf(_first).Where(_ => solid.Length > MinShared))
        {
            if (CountShared(map, solid, needed) > 0)
            {
                AddNew(Fit(map, solid));
            }
        }

        // What follows each other is a symmetry as well.
        for (var index = 1; index < symmetries.Count; index++)
        {
            for (var other = 1; other <= index; other++)
            {
                AddNew(symmetries[index] * symmetries[other]);
            }
        }

        // A map that is no symmetry makes more and more others.
        return symmetries.Count < MaxSymmetries ? symmetries : [AffineMap.Identity];

        void AddNew(AffineMap map)
        {
            if (symmetries.Count < MaxSymmetries && !symmetries.Exists(known => _first.Shape.Points.All(
                    point => ((map * point) - (known * point)).Length() < SameMap * _first.Shape.Size)))
            {
                symmetries.Add(map);
            }
        }
    }

    /// <summary>The maps that take two faces that meet at an edge to two such faces.</summary>
    private IEnumerable<AffineMap> MapsOf(DecimatedElement element)
    {
        var points = element.Shape.Points;
        foreach (var (a, b, c, d) in element.Frames)
        {
            var axes = new Matrix(points[b] - points[a], points[c] - points[a], points[d] - points[a]);
            var (back, volume) = (axes.Inverse(), Math.Abs(axes.Determinant()) / element.Volume);
            foreach (var frame in _frames)
            {
                if (frame.Volume > MaxVolumeRatio * volume || volume > MaxVolumeRatio * frame.Volume)
                {
                    continue;
                }

                // The edge from each end, and the others in each order.
                var (p, q, r, s) = (frame.Corner, frame.Axes.V1, frame.Axes.V2, frame.Axes.V3);
                yield return MapTo(p, frame.Axes);
                yield return MapTo(p, new(q, s, r));
                yield return MapTo(p + q, new(-q, r - q, s - q));
                yield return MapTo(p + q, new(-q, s - q, r - q));
            }

            AffineMap MapTo(Vector corner, Matrix to)
            {
                var linear = to * back;
                return new(linear, corner - (linear * points[a]));
            }
        }
    }

    private int Find(Vector position) => _grid.First(position) is var entry && entry >= 0 ? _grid.PointOf(entry) : -1;

    /// <summary>Counts the points that a map takes to vertices, as long as that may be more than a number.</summary>
    private int CountShared(AffineMap map, Vector[] points, int least)
    {
        var shared = 0;
        for (var index = 0; index < points.Length; index++)
        {
            shared += Find(map * points[index]) >= 0 ? 1 : 0;
            if (shared + points.Length - 1 - index <= least || (index == MinTested && shared == 0))
            {
                return 0;
            }
        }

        return shared;
    }

    /// <summary>The map that takes points nearest to the vertices that a known one takes them to.</summary>
    private AffineMap Fit(AffineMap known, Vector[] points)
    {
        var fit = new MapFit(_first.Shape.Centroid);
        foreach (var image in points.Select(point => known * point))
        {
            if (Find(image) is var index && index >= 0)
            {
                fit.Add(new(default, image), new(default, _points[index]), false, 1);
            }
        }

        return fit.Solve(AffineMap.Identity) * known;
    }
}
