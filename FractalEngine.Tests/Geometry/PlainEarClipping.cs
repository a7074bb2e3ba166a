using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Geometry;

/// <summary>Ear clipping that tests every corner afresh, cubic at worst: the oracle for simple polygons in the plane z = 0.</summary>
internal static class PlainEarClipping
{
    public static List<int[]> Triangulate(IReadOnlyList<Vector> polygon)
    {
        // Clockwise polygons are mirrored, so that ears turn left.
        var sign = Enumerable.Range(0, polygon.Count).Sum(i => Area(polygon[0], polygon[i], polygon[(i + 1) % polygon.Count])) < 0 ? -1 : 1;
        List<int> corners = [.. Enumerable.Range(0, polygon.Count)];
        List<int[]> triangles = [];
        for (var position = 0; corners.Count > 3;)
        {
            var attempts = 0;
            for (; attempts < corners.Count && !IsEar(position); attempts++)
            {
                position = (position + 1) % corners.Count;
            }

            triangles.Add([At(position - 1), At(position), At(position + 1)]);
            corners.RemoveAt(position);
            position = (position + 1) % corners.Count;
        }

        // The last triangle begins as if it were one more ear.
        var last = corners.Count == 3 && triangles.Count > 0 ? corners.ToArray() : [0, 1, 2];
        triangles.Add(last);
        return triangles;

        int At(int position) => corners[(position + corners.Count) % corners.Count];

        double Area(Vector a, Vector b, Vector c) => ((b.X - a.X) * (c.Y - a.Y)) - ((b.Y - a.Y) * (c.X - a.X));

        bool IsEar(int position)
        {
            var (a, b, c) = (polygon[At(position - 1)], polygon[At(position)], polygon[At(position + 1)]);
            return sign * Area(a, b, c) > 0 && !corners.Any(other => polygon[other] != a && polygon[other] != b && polygon[other] != c
                && sign * Area(a, b, polygon[other]) >= 0 && sign * Area(b, c, polygon[other]) >= 0
                && sign * Area(c, a, polygon[other]) >= 0);
        }
    }
}
