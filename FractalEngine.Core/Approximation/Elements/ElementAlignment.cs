using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Elements;

/// <summary>
/// Finds the affine maps that take one element's vertices to another's. Three vertices of the first one are looked for among those
/// of the other one that have the same affine products; each find is verified on all vertices.
/// </summary>
internal sealed class ElementAlignment
{
    private readonly ElementShape _shape;
    private readonly int[] _frame;
    private readonly Matrix _inverseFrame;
    private readonly double _tolerance;

    /// <summary>Chooses the frame of an element that others are compared with.</summary>
    /// <param name="shape">The element.</param>
    /// <param name="tolerance">Largest difference of affine products, and of vertices in affine units; 0.001 for exact data.</param>
    public ElementAlignment(ElementShape shape, double tolerance)
    {
        _shape = shape;
        _tolerance = tolerance;
        _frame = ChooseFrame(shape, tolerance);
        _inverseFrame = FrameOf(shape, _frame, shape.Normal).Inverse();
    }

    /// <summary>The element that is compared with.</summary>
    public ElementShape Shape => _shape;

    /// <summary>Vertices that fix a map, two of a flat element and three of others.</summary>
    public ReadOnlySpan<int> Frame => _frame;

    /// <summary>Returns all maps of this element to another one, or the first one.</summary>
    /// <param name="other">The other element.</param>
    /// <param name="maxMaps">Search ends when it has so many.</param>
    public List<AffineMap> FindMaps(ElementShape other, int maxMaps = int.MaxValue)
    {
        var maps = new List<AffineMap>();
        if (IsAlike(other))
        {
            Search(other, new int[_frame.Length], 0, maps, maxMaps);
        }

        return maps;
    }

    private bool IsAlike(ElementShape other) =>
        other.Points.Length == _shape.Points.Length && other.IsFlat == _shape.IsFlat
        && !other.SortedRadii.Where((radius, rank) => !IsNear(radius, _shape.SortedRadii[rank])).Any();

    private bool IsNear(double product, double expected) => Math.Abs(product - expected) <= _tolerance * (1 + Math.Abs(expected));

    private void Search(ElementShape other, int[] chosen, int depth, List<AffineMap> maps, int maxMaps)
    {
        if (depth == _frame.Length)
        {
            AddVerified(other, chosen, other.Normal, maps, maxMaps);
            if (other.IsFlat)
            {
                AddVerified(other, chosen, -other.Normal, maps, maxMaps);
            }

            return;
        }

        foreach (var vertex in Candidates(other, _shape.Radii[_frame[depth]]))
        {
            if (maps.Count < maxMaps && FitsFrame(other, chosen, depth, vertex))
            {
                chosen[depth] = vertex;
                Search(other, chosen, depth + 1, maps, maxMaps);
            }
        }
    }

    private IEnumerable<int> Candidates(ElementShape other, double radius)
    {
        var reach = _tolerance * (1 + radius);
        var found = Array.BinarySearch(other.SortedRadii, radius - reach);
        for (var rank = Math.Max(found, ~found); rank < other.Order.Length && other.SortedRadii[rank] <= radius + reach; rank++)
        {
            yield return other.Order[rank];
        }
    }

    private bool FitsFrame(ElementShape other, int[] chosen, int depth, int vertex)
    {
        for (var earlier = 0; earlier < depth; earlier++)
        {
            if (!IsNear(
                other.Product(other.Points[vertex] - other.Centroid, other.Points[chosen[earlier]] - other.Centroid),
                _shape.Product(_shape.Points[_frame[depth]] - _shape.Centroid, _shape.Points[_frame[earlier]] - _shape.Centroid)))
            {
                return false;
            }
        }

        return true;
    }

    private void AddVerified(ElementShape other, int[] chosen, Vector normal, List<AffineMap> maps, int maxMaps)
    {
        if (maps.Count == maxMaps)
        {
            return;
        }

        var linear = FrameOf(other, chosen, normal) * _inverseFrame;
        var correlation = default(Matrix);
        var taken = new bool[other.Points.Length];
        for (var vertex = 0; vertex < _shape.Points.Length; vertex++)
        {
            var difference = _shape.Points[vertex] - _shape.Centroid;
            var image = Find(other, linear * difference, _shape.Radii[vertex], taken);
            if (image < 0)
            {
                return;
            }

            taken[image] = true;
            correlation += Matrix.Outer(other.Points[image] - other.Centroid, difference) / _shape.Points.Length;
        }

        // Least squares over all vertices: (Σ q pᵀ)(Σ p pᵀ)⁻¹.
        linear = (correlation + Matrix.Outer(normal, _shape.Normal)) * _shape.Inverse;
        maps.Add(new(linear, other.Centroid - (linear * _shape.Centroid)));
    }

    private int Find(ElementShape other, Vector image, double radius, bool[] taken)
    {
        var best = -1;
        var bestDistance = _tolerance * (1 + radius);
        foreach (var vertex in Candidates(other, radius))
        {
            var error = other.Points[vertex] - other.Centroid - image;
            var distance = Math.Sqrt(Math.Max(0, other.Product(error, error)));
            if (!taken[vertex] && distance <= bestDistance)
            {
                best = vertex;
                bestDistance = distance;
            }
        }

        return best;
    }

    private static Matrix FrameOf(ElementShape shape, int[] vertices, Vector normal) => new(
        shape.Points[vertices[0]] - shape.Centroid,
        shape.Points[vertices[1]] - shape.Centroid,
        shape.IsFlat ? normal : shape.Points[vertices[2]] - shape.Centroid);

    /// <summary>The first vertex has the rarest radius, the others make area and volume as large as they can.</summary>
    private static int[] ChooseFrame(ElementShape shape, double tolerance)
    {
        var first = Rarest(shape, tolerance);
        var u = shape.Points[first] - shape.Centroid;
        var all = Enumerable.Range(0, shape.Points.Length);
        var second = all.MaxBy(vertex => Area(vertex, u, shape));
        if (shape.IsFlat)
        {
            return [first, second];
        }

        var v = shape.Points[second] - shape.Centroid;
        return [first, second, all.MaxBy(vertex => Math.Abs(Vector.Dot(shape.Points[vertex] - shape.Centroid, Vector.Cross(u, v))))];
    }

    private static double Area(int vertex, Vector u, ElementShape shape)
    {
        var v = shape.Points[vertex] - shape.Centroid;
        return (shape.Product(u, u) * shape.Product(v, v)) - (shape.Product(u, v) * shape.Product(u, v));
    }

    /// <summary>A vertex that few others are as far from the centroid as; those near to it fix no direction.</summary>
    private static int Rarest(ElementShape shape, double tolerance) => shape.Order.Where(vertex => shape.Radii[vertex] > 0.5)
        .GroupBy(vertex => Math.Round(Math.Log(shape.Radii[vertex]) / (4 * tolerance))).MinBy(group => group.Count())!.First();
}
