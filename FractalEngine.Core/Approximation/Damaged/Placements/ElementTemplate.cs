using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>
/// What the elements of a class are images of: vertices with the mean 0 and the covariance 1, so that symmetries are orthogonal. A flat
/// element has none along z; where it is put, normals are stretched as a similarity does.
/// </summary>
internal sealed class ElementTemplate
{
    // What differs more is not called a symmetry, however small an element is.
    private const double MaxError = 0.3;

    private readonly double _tolerance;
    private readonly ElementTopology _topology;
    private readonly Vector[] _vertices;

    /// <param name="element">The element to make the template of.</param>
    /// <param name="topology">Its faces.</param>
    /// <param name="shape">Its vertices, flat within the noise or not.</param>
    /// <param name="tolerance">How far an image of a vertex may be from a vertex for a map to be a symmetry, scene units.</param>
    public ElementTemplate(Element element, ElementTopology topology, ElementShape shape, double tolerance)
    {
        _topology = topology;
        _tolerance = tolerance;
        Corners = element.Corners;
        IsFlat = shape.IsFlat;
        var frame = FrameOf(shape);
        var back = frame.Inverse();
        _vertices = [.. shape.Points.Select(point => back * (point - shape.Centroid)).Select(q => IsFlat ? q with { Z = 0 } : q)];
        var symmetries = new List<(Matrix Map, int[] Order, double Error)>();
        foreach (var order in topology.FindCorrespondences(topology))
        {
            var map = Fit(order, _vertices).Linear;
            var error = Enumerable.Range(0, order.Length).Max(
                vertex => (frame * ((map * _vertices[vertex]) - _vertices[order[vertex]])).Length()) / shape.Size;
            if (error <= MaxError)
            {
                symmetries.Add((map, order, error));
                if (IsFlat)
                {
                    symmetries.Add((map with { V3 = -map.V3 }, order, error));
                }
            }
        }

        Symmetries = [.. symmetries.OrderBy(symmetry => symmetry.Error)];
    }

    /// <summary>Makes a template of a decimated element, whose vertices don't tell the symmetries of what it is an image of.</summary>
    /// <param name="first">The element.</param>
    /// <param name="symmetries">Maps of what it is an image of to itself, scene units: a group.</param>
    /// <param name="frame">The map that takes the template to the element.</param>
    public ElementTemplate(DecimatedElement first, List<AffineMap> symmetries, out AffineMap frame)
    {
        Corners = first.Corners;
        _topology = new(Corners, first.Shape.Points.Length);
        var (centre, covariance) = (Vector.Zero, default(Matrix));
        foreach (var map in symmetries)
        {
            centre += map * first.Shape.Centroid / symmetries.Count;
            covariance += map.Linear * first.Shape.Inverse.Inverse() * map.Linear.Transpose() / symmetries.Count;
        }

        frame = new(FrameOf(covariance), centre);
        var back = frame.Inverse();
        _vertices = Array.ConvertAll(first.Shape.Points, point => back * point);
        var linear = frame.Linear;
        Symmetries = [.. symmetries.Select(map => (back.Linear * map.Linear * linear, Array.Empty<int>(), 0.0))];
    }

    /// <summary>Indices of vertices, [faces × 3].</summary>
    public int[] Corners { get; }

    /// <summary>The vertices of the template, [vertices].</summary>
    public IReadOnlyList<Vector> Vertices => _vertices;

    /// <summary>Whether all vertices lie in the plane z = 0.</summary>
    public bool IsFlat { get; }

    /// <summary>
    /// The maps of the template to itself, the best first, each with the vertex that each vertex goes to, and how far off it puts
    /// vertices, in units of its size.
    /// </summary>
    public (Matrix Map, int[] Order, double Error)[] Symmetries { get; }

    /// <summary>Counts the first symmetries that noise does not tell from others, where an element is so large.</summary>
    public int CountSymmetries(double size)
    {
        var count = 1;
        while (count < Symmetries.Length && Symmetries[count].Error * size <= _tolerance)
        {
            count++;
        }

        return count;
    }

    /// <summary>How many numbers of an element a map to it can't be fitted to.</summary>
    public int FreeNumbers => (3 * _vertices.Length) - (IsFlat ? 9 : 12);

    /// <summary>Places an element, or returns null if its faces are connected in another way.</summary>
    /// <returns>The element, and the root of the mean squared distance of its vertices from the template's image, scene units.</returns>
    public (PlacedElement Element, double Error)? Place(int templateClass, Element element, ElementTopology topology)
    {
        (PlacedElement, double)? best = null;
        var least = double.PositiveInfinity;
        foreach (var order in _topology.FindCorrespondences(topology))
        {
            var points = Array.ConvertAll(order, vertex => element.Shape.Points[vertex]);
            var placement = Fit([.. Enumerable.Range(0, order.Length)], points);
            var sum = 0.0;
            for (var vertex = 0; vertex < points.Length; vertex++)
            {
                sum += ((placement * _vertices[vertex]) - points[vertex]).LengthSquared();
            }

            // Of equal ones the first.
            if (sum < least * (1 - 1e-9))
            {
                least = sum;
                best = (new(templateClass, placement, points), Math.Sqrt(sum / points.Length));
            }
        }

        return best;
    }

    /// <summary>The symmetric-free square root of the covariance: lower triangular, or with the normal as third axis.</summary>
    private static Matrix FrameOf(ElementShape shape)
    {
        var covariance = shape.Inverse.Inverse();
        if (shape.IsFlat)
        {
            // Two axes in the plane, with the third one as long as the root of their product.
            var w = shape.Normal.UnitVector();
            var u = Vector.Cross(w, Math.Abs(w.X) < 0.5 ? Vector.I : Vector.J).UnitVector();
            var v = Vector.Cross(w, u);
            var (uu, uv, vv) = (Vector.Dot(u, covariance * u), Vector.Dot(u, covariance * v), Vector.Dot(v, covariance * v));
            var a = Math.Sqrt(uu);
            var c = Math.Sqrt(vv - (uv * uv / uu));
            return new((a * u) + (uv / a * v), c * v, Math.Sqrt(a * c) * w);
        }

        return FrameOf(covariance);
    }

    private static Matrix FrameOf(Matrix covariance)
    {
        var x = Math.Sqrt(covariance.V1.X);
        var (y, z) = (covariance.V1.Y / x, covariance.V1.Z / x);
        var yy = Math.Sqrt(covariance.V2.Y - (y * y));
        var yz = (covariance.V2.Z - (y * z)) / yy;
        return new(new(x, y, z), new(0, yy, yz), new(0, 0, Math.Sqrt(covariance.V3.Z - (z * z) - (yz * yz))));
    }

    /// <summary>The map that takes the template's vertices nearest to points.</summary>
    private AffineMap Fit(int[] order, Vector[] points)
    {
        var centroid = Vector.Zero;
        foreach (var vertex in order)
        {
            centroid += points[vertex] / order.Length;
        }

        var linear = default(Matrix);
        for (var vertex = 0; vertex < order.Length; vertex++)
        {
            linear += Matrix.Outer(points[order[vertex]] - centroid, _vertices[vertex]) / order.Length;
        }

        if (IsFlat)
        {
            var normal = Vector.Cross(linear.V1, linear.V2);
            linear = linear with { V3 = normal / Math.Sqrt(normal.Length()) };
        }

        return new(linear, centroid);
    }
}
