using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Distances;

/// <summary>Measures the faces of a surface at the corners and the centres of equal triangles into which they are divided.</summary>
/// <param name="mesh">The surface.</param>
/// <param name="target">The surface that distances are measured to.</param>
/// <param name="samples">Number of triangles, about.</param>
internal sealed class FaceSampler(Mesh mesh, TargetSurface target, int samples)
{
    private readonly double _area = mesh.SurfaceArea();

    /// <summary>Measures one face of the surface.</summary>
    /// <param name="a">Its first corner.</param>
    /// <param name="b">Its second corner.</param>
    /// <param name="c">Its third corner.</param>
    public SampleSums Sample(SurfacePoint a, SurfacePoint b, SurfacePoint c)
    {
        var (ab, ac) = (b.Position - a.Position, c.Position - a.Position);
        var normal = TriangleKernel.UnitNormal(a.Position, b.Position, c.Position);
        // Faces count by their areas, or all the same where none has one.
        var weight = _area > 0 ? 0.5 * Vector.Cross(ab, ac).Length() : 1;
        var divisions = Math.Max(1, (int)Math.Sqrt(samples * (_area > 0 ? weight / _area : 0)));
        var sums = new SampleSums(a, weight, 0, 0, 0);
        weight /= (double)divisions * divisions;
        var hint = a.Face;
        var row = MeasureRow(0);
        for (var v = 0; v < divisions; v++)
        {
            var nextRow = MeasureRow(v + 1);
            for (var u = 0; u < divisions - v; u++)
            {
                AddTriangle(u + (1 / 3.0), v + (1 / 3.0), (row[u] + row[u + 1] + nextRow[u]) / 3);
                if (u + 1 < divisions - v)
                {
                    AddTriangle(u + (2 / 3.0), v + (2 / 3.0), (row[u + 1] + nextRow[u] + nextRow[u + 1]) / 3);
                }
            }

            row = nextRow;
        }

        return sums;

        double[] MeasureRow(int v)
        {
            var distances = new double[divisions - v + 1];
            for (var u = 0; u < distances.Length; u++)
            {
                distances[u] = (u == divisions ? b : v == divisions ? c : u + v == 0 ? a : Measure(u, v)).Distance;
            }

            return distances;
        }

        SurfacePoint Measure(double u, double v)
        {
            var point = target.Measure(a.Position + (u / divisions * ab) + (v / divisions * ac), hint);
            sums += new SampleSums(point, 0, 0, 0, 0);
            hint = point.Face;
            return point;
        }

        // The rule of three quarters at the centre and one at the corners is exact for squares. What it differs from that of the centre is
        // more than its error where the distance bends evenly.
        void AddTriangle(double u, double v, double cornerMean)
        {
            var centre = Measure(u, v);
            var correction = 0.25 * (cornerMean - centre.Distance);
            sums += new SampleSums(
                centre,
                0,
                weight * (centre.Distance + correction),
                weight * Math.Abs(correction),
                weight * Angle(normal, target.Normal(centre.Face)));
        }
    }

    /// <summary>The angle between two planes, from 0 to π/2.</summary>
    private static double Angle(Vector normal1, Vector normal2) =>
        Math.Atan2(Vector.Cross(normal1, normal2).Length(), Math.Abs(Vector.Dot(normal1, normal2)));
}
