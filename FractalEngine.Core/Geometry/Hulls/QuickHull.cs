using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Hulls;

/// <summary>Builds the hull of a set of points that is not flat.</summary>
/// <remarks>
/// Quickhull (Barber, Dobkin and Huhdanpaa 1996) begins with a tetrahedron, and adds the point farthest above some facet again and again.
/// The facets that are visible from it are replaced by those between it and their horizon.
/// </remarks>
/// <param name="points">Begins with the points.</param>
/// <param name="pointCount">Number of points.</param>
/// <param name="tolerance">Points no higher above a facet than this count as on it, in scene units.</param>
/// <param name="rounding">How far off a computed point may be.</param>
internal sealed class QuickHull(Vector[] points, int pointCount, double tolerance, double rounding)
{
    // Rounding moves facets and edges of a solid that is thinner than this, or has such facets, by more than the tolerance.
    private const double MinThickness = 4e-3;

    // Facets whose normals differ by less in every component share a plane.
    private const double SamePlaneTolerance = 1e-9;

    // Facets of one plane are crossed at the same place, but for rounding.
    private const double SamePlace = 1e-6;

    private readonly int[] _nextPoint = new int[pointCount];
    private readonly List<Facet> _facets = [];
    private readonly List<int> _vertices = [];
    private readonly List<int> _insidePoints = [];
    private double _maxOutsideDistance;
    private bool _isThin;

    /// <summary>Builds the hull from an initial tetrahedron.</summary>
    /// <param name="i0">Index of its first vertex.</param>
    /// <param name="i1">Index of its second vertex.</param>
    /// <param name="i2">Index of its third vertex.</param>
    /// <param name="i3">Index of its fourth vertex.</param>
    /// <param name="maxVertices">Maximum number of vertices of the hull.</param>
    public ConvexHull Build(int i0, int i1, int i2, int i3, int maxVertices)
    {
        var height = Vector.Dot(TriangleKernel.UnitNormal(points[i0], points[i1], points[i2]), points[i3] - points[i0]);
        _isThin = !(Math.Abs(height) > MinThickness * (points[i1] - points[i0]).Length());
        // The first facet must face away from the fourth vertex.
        if (height > 0)
        {
            (i1, i2) = (i2, i1);
        }

        _vertices.AddRange([i0, i1, i2, i3]);
        _facets.AddRange([CreateFacet(i0, i1, i2), CreateFacet(i0, i3, i1), CreateFacet(i1, i3, i2), CreateFacet(i2, i3, i0)]);
        for (var point = 0; point < pointCount; point++)
        {
            AssignToFacet(point, 0);
        }

        while (_vertices.Count < maxVertices && _facets.MaxBy(static facet => facet.FarthestHeight) is { FirstPoint: >= 0 } highest)
        {
            AddVertex(highest.FarthestPoint);
        }

        var facets = new HullFacet[_facets.Count];
        for (var i = 0; i < facets.Length; i++)
        {
            var facet = _facets[i];
            facets[i] = new(points[facet.A], points[facet.B], points[facet.C]);
            for (var point = facet.FirstPoint; point >= 0; point = _nextPoint[point])
            {
                TrackOutsidePoint(point, facet);
            }
        }

        Vector[] vertices = [.. _vertices.Select(vertex => points[vertex])];
        var centre = vertices.Aggregate(Vector.Zero, (sum, vertex) => sum + (vertex / vertices.Length));
        foreach (var point in _isThin ? _insidePoints : [])
        {
            TrackInsidePoint(points[point], centre);
        }

        return new(vertices, MergePlanes(), _maxOutsideDistance, facets);
    }

    private void AddVertex(int apexIndex)
    {
        var apex = points[apexIndex];
        var visible = _facets.FindAll(IsVisible);
        _facets.RemoveAll(IsVisible);
        var firstNew = _facets.Count;
        foreach (var facet in visible)
        {
            // An edge of the horizon belongs to one visible facet.
            AddFacetAtHorizon(facet.A, facet.B);
            AddFacetAtHorizon(facet.B, facet.C);
            AddFacetAtHorizon(facet.C, facet.A);
        }

        bool IsVisible(Facet facet) => Vector.Dot(facet.Normal, apex) - facet.Offset > tolerance;

        void AddFacetAtHorizon(int start, int end)
        {
            if (!visible.Exists(facet => facet.HasEdge(end, start)))
            {
                _facets.Add(CreateFacet(start, end, apexIndex));
            }
        }

        _vertices.Add(apexIndex);
        foreach (var facet in visible)
        {
            for (int point = facet.FirstPoint, next; point >= 0; point = next)
            {
                next = _nextPoint[point];
                AssignToFacet(point, firstNew);
            }
        }
    }

    private Facet CreateFacet(int a, int b, int c)
    {
        var (ab, ac, bc) = (points[b] - points[a], points[c] - points[a], points[c] - points[b]);
        var longestSquared = Math.Max(ab.LengthSquared(), Math.Max(ac.LengthSquared(), bc.LengthSquared()));
        _isThin |= !(Vector.Cross(ab, ac).Length() > MinThickness * longestSquared);
        var normal = TriangleKernel.UnitNormal(points[a], points[b], points[c]);
        return new(a, b, c, normal, Vector.Dot(normal, points[a]));
    }

    /// <summary>Assigns a point to the facet that it is farthest above, if it is above any.</summary>
    private void AssignToFacet(int point, int firstFacet)
    {
        Facet? highest = null;
        var maxHeight = 0.0;
        for (var i = firstFacet; i < _facets.Count; i++)
        {
            var height = Vector.Dot(_facets[i].Normal, points[point]) - _facets[i].Offset;
            if (height > maxHeight)
            {
                highest = _facets[i];
                maxHeight = height;
            }
        }

        if (highest is null)
        {
            _insidePoints.Add(point);
            return;
        }

        if (point == highest.A || point == highest.B || point == highest.C)
        {
            return;
        }

        if (maxHeight <= tolerance)
        {
            TrackOutsidePoint(point, highest);
            return;
        }

        _nextPoint[point] = highest.FirstPoint;
        highest.FirstPoint = point;
        if (maxHeight > highest.FarthestHeight)
        {
            highest.FarthestPoint = point;
            highest.FarthestHeight = maxHeight;
        }
    }

    /// <summary>Records the distance of a point that stays outside the hull.</summary>
    private void TrackOutsidePoint(int point, Facet facet) => _maxOutsideDistance = Math.Max(
        _maxOutsideDistance,
        Math.Sqrt(TriangleKernel.ClosestPoint(points[point], points[facet.A], points[facet.B], points[facet.C]).DistanceSquared));

    /// <summary>
    /// Records how far outside a point may be that seemed to be inside: rounding misplaces thin facets. The line from the centre
    /// through the point meets a facet behind it. The point is no farther from the solid than that place is from the facet.
    /// </summary>
    private void TrackInsidePoint(Vector point, Vector centre)
    {
        var exit = _facets.Min(ExitOf);
        var outsideDistance = double.PositiveInfinity;
        foreach (var facet in _facets)
        {
            if (ExitOf(facet) <= exit + (SamePlace * Math.Abs(exit)))
            {
                var factor = exit is >= 1 and < double.PositiveInfinity ? exit : 1;
                var image = centre + (factor * (point - centre));
                var apart = TriangleKernel.ClosestPoint(image, points[facet.A], points[facet.B], points[facet.C]).DistanceSquared;
                outsideDistance = Math.Min(outsideDistance, Math.Sqrt(apart) / factor);
            }
        }

        _maxOutsideDistance = outsideDistance > rounding ? Math.Max(_maxOutsideDistance, outsideDistance) : _maxOutsideDistance;

        double ExitOf(Facet facet)
        {
            var slope = Vector.Dot(facet.Normal, point - centre);
            return slope > 0 ? (facet.Offset - Vector.Dot(facet.Normal, centre)) / slope : double.PositiveInfinity;
        }
    }

    /// <summary>Joins facets of the same plane, and orders the planes by descending area.</summary>
    private HullPlane[] MergePlanes()
    {
        var planes = new List<HullPlane>();
        foreach (var facet in _facets)
        {
            var area = Vector.Cross(points[facet.B] - points[facet.A], points[facet.C] - points[facet.A]).Length();
            var match = planes.FindIndex(plane => (plane.Normal - facet.Normal).MaxAbsComponent() < SamePlaneTolerance);
            if (match < 0)
            {
                planes.Add(new(facet.Normal, facet.Offset, area));
            }
            else
            {
                // Among parallel facets the larger one has the better normal.
                var plane = planes[match];
                var normal = plane.DoubledArea >= area ? plane.Normal : facet.Normal;
                planes[match] = new(normal, Math.Max(plane.Offset, facet.Offset), plane.DoubledArea + area);
            }
        }

        return [.. planes.OrderByDescending(static plane => plane.DoubledArea)];
    }

    /// <summary>A triangle of the hull with the points above it, which form a linked list.</summary>
    private sealed class Facet(int a, int b, int c, Vector normal, double offset)
    {
        public int A { get; } = a;

        public int B { get; } = b;

        public int C { get; } = c;

        public Vector Normal { get; } = normal;

        public double Offset { get; } = offset;

        /// <summary>Tells whether the facet has a directed edge.</summary>
        public bool HasEdge(int start, int end) =>
            (A == start && B == end) || (B == start && C == end) || (C == start && A == end);

        /// <summary>Index of the first point above the facet; −1 for none.</summary>
        public int FirstPoint { get; set; } = -1;

        public int FarthestPoint { get; set; } = -1;

        public double FarthestHeight { get; set; } = double.NegativeInfinity;
    }
}
