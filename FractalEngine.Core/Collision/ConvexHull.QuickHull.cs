using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <content>Of points that do not lie in one plane.</content>
internal sealed partial class ConvexHull
{
    /// <summary>The work on a set of points that is not flat.</summary>
    private sealed class QuickHull(Vector[] points, double tolerance)
    {
        private readonly int[] _next = new int[points.Length];
        private readonly List<Facet> _facets = [];
        private readonly List<int> _vertices = [];
        private double _missed;

        public ConvexHull Solid(int i0, int i1, int i2, int i3, int mostVertices)
        {
            if (Vector.Dot(FaceKernel.UnitNormal(points[i0], points[i1], points[i2]), points[i3] - points[i0]) > 0)
            {
                (i1, i2) = (i2, i1);
            }

            _vertices.AddRange([i0, i1, i2, i3]);
            _facets.AddRange([Make(i0, i1, i2), Make(i0, i3, i1), Make(i1, i3, i2), Make(i2, i3, i0)]);
            for (var point = 0; point < points.Length; point++)
            {
                Assign(point, 0);
            }

            while (_vertices.Count < mostVertices && _facets.MaxBy(facet => facet.FarthestHeight) is { First: >= 0 } highest)
            {
                Add(highest.Farthest);
            }

            foreach (var facet in _facets)
            {
                for (var point = facet.First; point >= 0; point = _next[point])
                {
                    Miss(point, facet);
                }
            }

            return new ConvexHull(
                [.. _vertices.Select(vertex => points[vertex])],
                [.. Planes()],
                _missed,
                [.. _facets.Select(facet => (points[facet.A], points[facet.B], points[facet.C]))]).WithOffsets();
        }

        [MethodImpl(MethodImplOptions.AggressiveOptimization)]
        private void Add(int apex)
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
                    _facets.Add(Make(start, end, apex));
                }
            }

            _vertices.Add(apex);
            foreach (var facet in removed)
            {
                for (int point = facet.First, next; point >= 0; point = next)
                {
                    next = _next[point];
                    Assign(point, firstNew);
                }
            }
        }

        private Facet Make(int a, int b, int c)
        {
            var normal = FaceKernel.UnitNormal(points[a], points[b], points[c]);
            return new(a, b, c, normal, Vector.Dot(normal, points[a]));
        }

        /// <summary>Gives a point to the facet that it is farthest above, if it is above any.</summary>
        [MethodImpl(MethodImplOptions.AggressiveOptimization)]
        private void Assign(int point, int firstFacet)
        {
            Facet? highest = null;
            var most = 0.0;
            for (var i = firstFacet; i < _facets.Count; i++)
            {
                var height = Vector.Dot(_facets[i].Normal, points[point]) - _facets[i].Offset;
                (highest, most) = height > most ? (_facets[i], height) : (highest, most);
            }

            if (highest is null || point == highest.A || point == highest.B || point == highest.C)
            {
                return;
            }

            if (most <= tolerance)
            {
                Miss(point, highest);
                return;
            }

            _next[point] = highest.First;
            highest.First = point;
            if (most > highest.FarthestHeight)
            {
                (highest.Farthest, highest.FarthestHeight) = (point, most);
            }
        }

        private void Miss(int point, Facet facet) => _missed = Math.Max(
            _missed, Math.Sqrt(FaceKernel.ClosestPoint(points[point], points[facet.A], points[facet.B], points[facet.C]).DistanceSquared));

        [MethodImpl(MethodImplOptions.AggressiveOptimization)]
        private IEnumerable<HullPlane> Planes()
        {
            var planes = new List<HullPlane>();
            foreach (var facet in _facets)
            {
                var area = Vector.Cross(points[facet.B] - points[facet.A], points[facet.C] - points[facet.A]).Length();
                var same = 0;
                while (same < planes.Count && !((planes[same].Normal - facet.Normal).MaximumComponent() < SamePlane))
                {
                    same++;
                }

                if (same == planes.Count)
                {
                    planes.Add(new(facet.Normal, facet.Offset, area));
                }
                else
                {
                    // Of parallel facets the larger one has the better normal.
                    var (plane, larger) = (planes[same], planes[same].Area >= area);
                    planes[same] = new(larger ? plane.Normal : facet.Normal, Math.Max(plane.Offset, facet.Offset), plane.Area + area);
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
        public int First { get; set; } = -1;

        public int Farthest { get; set; } = -1;

        public double FarthestHeight { get; set; } = double.NegativeInfinity;
    }
}
