using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Elements;

/// <summary>Elements that are images of each other within rounding.</summary>
internal sealed class ExactElements : ElementSet
{
    // Largest distance of a mapped vertex from the one that it should be, in affine units of an element.
    private const double ShapeTolerance = 1e-4;

    private readonly List<ElementAlignment> _classes = [];
    private readonly List<List<AffineMap>> _symmetries = [];
    private readonly List<Element> _firsts = [];
    private readonly PointGrid _centroids;

    /// <summary>Sorts elements into classes of congruent ones.</summary>
    /// <param name="elements">The elements; those that coincide with an earlier one are dropped.</param>
    /// <param name="tolerance">Largest distance of a mapped vertex from the one that it should be, scene units.</param>
    /// <param name="cancellation">Ends the work early.</param>
    public ExactElements(IEnumerable<Element> elements, double tolerance, CancellationToken cancellation)
    {
        Tolerance = tolerance;
        var all = elements.ToArray();
        var byVertexCount = new Dictionary<(int, bool), List<int>>();
        foreach (var element in all)
        {
            cancellation.ThrowIfCancellationRequested();
            Classify(element, byVertexCount);
        }

        Elements = [.. WithoutDuplicates(all)];
        _centroids = new([.. Elements.Select(element => element.Shape.Centroid)], tolerance);
    }

    /// <summary>Largest distance of a mapped vertex from the one that it should be, scene units.</summary>
    public double Tolerance { get; }

    /// <inheritdoc/>
    protected override double RelativeTolerance => 1e-4;

    /// <inheritdoc/>
    public override IReadOnlyList<AffineMap> SymmetriesOf(int elementClass) => _symmetries[elementClass];

    /// <inheritdoc/>
    public override Element FirstOf(int elementClass) => _firsts[elementClass];

    /// <inheritdoc/>
    public override int Find(AffineMap placement, int elementClass)
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

    /// <inheritdoc/>
    public override IEnumerable<AffineMap> MapsBetween(int from, int to)
    {
        var back = Elements[from].Placement.Inverse();
        return _symmetries[Elements[from].Class].Select(symmetry => Elements[to].Placement * symmetry * back);
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

    private void Classify(Element element, Dictionary<(int, bool), List<int>> byVertexCount)
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
        var alignment = new ElementAlignment(element.Shape, ShapeTolerance);
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
