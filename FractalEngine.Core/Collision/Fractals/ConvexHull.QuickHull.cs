using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <content>Of points that do not lie in one plane.</content>
internal sealed partial class ConvexHull
{
    /// <summary>The work on a set of points that is not flat.</summary>
    private sealed class QuickHull(Vector[] points, double tolerance)
    {
        private readonly int[] _nextPoint = new int[points.Length];
        private readonly List<Facet> _facets = [];
        private readonly List<int> _vertices = [];
        private double _maxOutsideDistance;

        public ConvexHull Build(int i0, int i1, int i2, int i3, int maxVertices)
        {
            if (Vector.Dot(TriangleKernel.UnitNormal(points[i0], points[i1], points[i2]), points[i3] - points[i0]) > 0)
            {
                (i1, i2) = (i2, i1);
            }

            _vertices.AddRange([i0, i1, i2, i3]);
            _facets.AddRange([CreateFacet(i0, i1, i2), CreateFacet(i0, i3, i1), CreateFacet(i1, i3, i2), CreateFacet(i2, i3, i0)]);
            for (var point = 0; point < points.Length; point++)
            {
                AssignToFacet(point, 0);
            }

            while (_vertices.Count < maxVertices && _facets.MaxBy(facet => facet.FarthestHeight) is { FirstPoint: >= 0 } highest)
            {
                AddVertex(highest.FarthestPoint);
            }

            foreach (var facet in _facets)
            {
                for (var point = facet.FirstPoint; point >= 0; point = _nextPoint[point])
                {
                    TrackOutsidePoint(point, facet);
                }
            }

            return new ConvexHull(
                [.. _vertices.Select(vertex => points[vertex])],
                [.. MergePlanes()],
                _maxOutsideDistance,
                [.. _facets.Select(facet => (points[facet.A], points[facet.B], points[facet.C]))]).WithConservativeOffsets();
        }

        [MethodImpl(MethodImplOptions.AggressiveOptimization)]
        private void AddVertex(int apex)
        {
            var removed = new List<Facet>();
            var edges = new HashSet<(int, int)>();
            foreach (var facet in _facets)
            {
                if (Vector.Dot(facet.Normal, points[apex]) - facet.Offset > tolerance)
                {
                    removed.Add(facet);
                    edges.UnionWith([(facet.A, facet.B), (facet.B, facet.C), (facet.C, facet.A)]);
                }
            }

            _facets.RemoveAll(removed.Contains);
            var firstNew = _facets.Count;
            foreach (var (start, end) in edges)
            {
                if (!edges.Contains((end, start)))
                {
                    _facets.Add(CreateFacet(start, end, apex));
                }
            }

            _vertices.Add(apex);
            foreach (var facet in removed)
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
            var normal = TriangleKernel.UnitNormal(points[a], points[b], points[c]);
            return new(a, b, c, normal, Vector.Dot(normal, points[a]));
        }

        /// <summary>Gives a point to the facet that it is farthest above, if it is above any.</summary>
        [MethodImpl(MethodImplOptions.AggressiveOptimization)]
        private void AssignToFacet(int point, int firstFacet)
        {
            Facet? highest = null;
            var maxHeight = 0.0;
            for (var i = firstFacet; i < _facets.Count; i++)
            {
                var height = Vector.Dot(_facets[i].Normal, points[point]) - _facets[i].Offset;
                (highest, maxHeight) = height > maxHeight ? (_facets[i], height) : (highest, maxHeight);
            }

            if (highest is null || point == highest.A || point == highest.B || point == highest.C)
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
                (highest.FarthestPoint, highest.FarthestHeight) = (point, maxHeight);
            }
        }

        private void TrackOutsidePoint(int point, Facet facet) => _maxOutsideDistance = Math.Max(
            _maxOutsideDistance,
            Math.Sqrt(TriangleKernel.ClosestPoint(points[point], points[facet.A], points[facet.B], points[facet.C]).DistanceSquared));

        [MethodImpl(MethodImplOptions.AggressiveOptimization)]
        private IEnumerable<HullPlane> MergePlanes()
        {
            var planes = new List<HullPlane>();
            foreach (var facet in _facets)
            {
                var area = Vector.Cross(points[facet.B] - points[facet.A], points[facet.C] - points[facet.A]).Length();
                var match = 0;
                while (match < planes.Count && !((planes[match].Normal - facet.Normal).MaxAbsComponent() < SamePlaneTolerance))
                {
                    match++;
                }

                if (match == planes.Count)
                {
                    planes.Add(new(facet.Normal, facet.Offset, area));
                }
                else
                {
                    // Of parallel facets the larger one has the better normal.
                    var (plane, larger) = (planes[match], planes[match].Area >= area);
                    planes[match] = new(larger ? plane.Normal : facet.Normal, Math.Max(plane.Offset, facet.Offset), plane.Area + area);
                }
            }

            return planes.OrderByDescending(plane => plane.Area);
        }
    }

    private sealed class Facet(int a, int b, int c, Vector normal, double offset)
    {
        public int A { get; } = a;

        public int B { get; } = b;

        public int C { get; } = c;

        public Vector Normal { get; } = normal;

        public double Offset { get; } = offset;

        /// <summary>The first point above it; the others follow.</summary>
        public int FirstPoint { get; set; } = -1;

        public int FarthestPoint { get; set; } = -1;

        public double FarthestHeight { get; set; } = double.NegativeInfinity;
    }
}
