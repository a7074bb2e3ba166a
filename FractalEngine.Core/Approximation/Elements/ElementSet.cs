using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Elements;

/// <summary>
/// The elements of a mesh, in classes of those that affine maps take to each other, and the question that all searches ask: which
/// element does a map take an element to?
/// </summary>
internal sealed class ElementSet
{
    /// <summary>The shape tolerance for exact data.</summary>
    public const double ExactShapeTolerance = 1e-4;

    private readonly List<ElementAlignment> _classes = [];
    private readonly List<List<AffineMap>> _symmetries = [];
    private readonly List<Element> _firsts = [];
    private readonly PointGrid _centroids;

    /// <summary>Sorts elements into classes of congruent ones.</summary>
    /// <param name="elements">The elements; those that coincide with an earlier one are dropped.</param>
    /// <param name="tolerance">Largest distance of a mapped vertex from the one that it should be, scene units.</param>
    /// <param name="shapeTolerance">The same in affine units of an element, see <see cref="ElementAlignment"/>.</param>
    /// <param name="cancellation">Ends the work early.</param>
    public ElementSet(IEnumerable<Element> elements, double tolerance, double shapeTolerance, CancellationToken cancellation)
    {
        Tolerance = tolerance;
        var all = elements.ToArray();
        var byVertexCount = new Dictionary<(int, bool), List<int>>();
        foreach (var element in all)
        {
            cancellation.ThrowIfCancellationRequested();
            Classify(element, shapeTolerance, byVertexCount);
        }

        Elements = [.. WithoutDuplicates(all)];
        _centroids = new([.. Elements.Select(element => element.Shape.Centroid)], tolerance);
    }

    /// <summary>The elements, each of them once.</summary>
    public Element[] Elements { get; }

    /// <summary>Number of elements in the set.</summary>
    public int Count => Elements.Length;

    /// <summary>Largest distance of a mapped vertex from the one that it should be, scene units.</summary>
    public double Tolerance { get; }

    /// <summary>The maps of the first element of a class to itself, the identity among them.</summary>
    public IReadOnlyList<AffineMap> SymmetriesOf(int elementClass) => _symmetries[elementClass];

    /// <summary>The first element of a class, from which placements start.</summary>
    public Element FirstOf(int elementClass) => _firsts[elementClass];

    /// <summary>Returns the element that a map takes an element to, or −1.</summary>
    public int Match(AffineMap map, int element) => Find(map * Elements[element].Placement, Elements[element].Class);

    /// <summary>Returns the element where a map puts the first element of a class, or −1.</summary>
    public int Find(AffineMap placement, int elementClass)
    {
        var centroid = placement * _classes[elementClass].Shape.Centroid;
        for (var entry = _centroids.First(centroid); entry >= 0; entry = _centroids.Next(entry, centroid))
        {
            var found = _centroids.PointOf(entry);
            if (Elements[found].Class == elementClass && AreSame(placement, Elements[found]))
            {
                return found;
            }
        }

        return -1;
    }

    /// <summary>Returns all maps that take one element to another of its class.</summary>
    public IEnumerable<AffineMap> MapsBetween(int from, int to)
    {
        var back = Elements[from].Placement.Inverse();
        foreach (var symmetry in _symmetries[Elements[from].Class])
        {
            yield return Elements[to].Placement * symmetry * back;
        }
    }

    private bool AreSame(AffineMap placement, Element element)
    {
        var alignment = _classes[element.Class];
        foreach (var vertex in alignment.Frame)
        {
            if (!HasVertex(element, placement * alignment.Shape.Points[vertex]))
            {
                return false;
            }
        }

        return true;
    }

    private bool HasVertex(Element element, Vector position)
    {
        foreach (var point in element.Shape.Points)
        {
            if ((point - position).LengthSquared() <= Tolerance * Tolerance)
            {
                return true;
            }
        }

        return false;
    }

    private void Classify(Element element, double shapeTolerance, Dictionary<(int, bool), List<int>> byVertexCount)
    {
        var key = (element.Shape.Points.Length, element.Shape.IsFlat);
        if (!byVertexCount.TryGetValue(key, out var classes))
        {
            byVertexCount.Add(key, classes = []);
        }

        foreach (var known in classes)
        {
            var maps = _classes[known].FindMaps(element.Shape, 1);
            if (maps.Count > 0)
            {
                element.Class = known;
                element.Placement = maps[0];
                return;
            }
        }

        element.Class = _classes.Count;
        classes.Add(element.Class);
        var alignment = new ElementAlignment(element.Shape, shapeTolerance);
        _classes.Add(alignment);
        _firsts.Add(element);
        var symmetries = alignment.FindMaps(element.Shape, MaxSymmetries);
        _symmetries.Add(symmetries.Count > 0 ? symmetries : [AffineMap.Identity]);
    }

    // Those of the octahedron are 48, of the icosahedron 120; a prism of n sides has 4n.
    private const int MaxSymmetries = 240;

    private IEnumerable<Element> WithoutDuplicates(Element[] elements)
    {
        var grid = new PointGrid([.. elements.Select(element => element.Shape.Centroid)], Tolerance);
        for (var index = 0; index < elements.Length; index++)
        {
            if (!IsDuplicate(elements, grid, index))
            {
                yield return elements[index];
            }
        }
    }

    private bool IsDuplicate(Element[] elements, PointGrid grid, int index)
    {
        var element = elements[index];
        for (var entry = grid.First(element.Shape.Centroid); entry >= 0; entry = grid.Next(entry, element.Shape.Centroid))
        {
            var other = grid.PointOf(entry);
            if (other < index && elements[other].Class == element.Class && AreSame(element.Placement, elements[other]))
            {
                return true;
            }
        }

        return false;
    }
}
