using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Makes faces that do not depend on how flat parts of a surface are split into triangles.</summary>
/// <remarks>
/// Edges within a plane are flipped until no corner lies in the circle of a triangle beside it (Delaunay). Triangles with one circle
/// then are one face, which is convex. The surface and its vertices stay as they are.
/// </remarks>
internal static class FlatFaces
{
    // Of the sum of two cotangents, which is 0 where four corners lie on a circle.
    private const double CircleTolerance = 1e-4;
    private const int MaxPasses = 50;

    /// <summary>Makes faces of triangles; null where they would be the same.</summary>
    public static FaceSet? Merge(FaceSet triangles)
    {
        var faces = triangles;
        for (var pass = 0; pass < MaxPasses && Flip(faces) is { } flipped; pass++)
        {
            faces = flipped;
        }

        var joined = new DisjointSets();
        joined.Reset(faces.Count);
        for (var corner = 0; corner < faces.Corners.Length; corner++)
        {
            if (CircleSum(faces, corner) is { } sum && Math.Abs(sum) <= CircleTolerance)
            {
                joined.Join(faces.FaceAt[corner], faces.FaceAt[faces.Twins[corner]]);
            }
        }

        var groups = Enumerable.Range(0, faces.Count).GroupBy(joined.RootOf).ToList();
        return faces == triangles && groups.Count == faces.Count
            ? null
            : new(faces.Points, groups.SelectMany(group => Join(faces, [.. group])), faces.Tolerance);
    }

    /// <summary>Flips edges of triangles that have no other flip beside them; null where there are none to flip.</summary>
    private static FaceSet? Flip(FaceSet faces)
    {
        var corners = (int[])faces.Corners.Clone();
        var isChanged = new bool[faces.Count];
        for (var corner = 0; corner < corners.Length; corner++)
        {
            var twin = faces.Twins[corner];
            var (face, other) = (faces.FaceAt[corner], faces.FaceAt[twin]);
            if (!isChanged[face] && !isChanged[other] && CircleSum(faces, corner) < -CircleTolerance)
            {
                var (c, d) = (faces.Corners[faces.After(corner, 2)], faces.Corners[faces.After(twin, 2)]);
                new[] { faces.Corners[corner], d, c }.CopyTo(corners, 3 * face);
                new[] { d, faces.Corners[faces.After(corner)], c }.CopyTo(corners, 3 * other);
                isChanged[face] = true;
                isChanged[other] = true;
            }
        }

        return Array.IndexOf(isChanged, true) < 0
            ? null
            : new(faces.Points, corners.Chunk(3).Select(face => (face, face)), faces.Tolerance);
    }

    /// <summary>
    /// The sum of the cotangents of the angles across an edge, below 0 where it should be flipped; null of edges that are no
    /// diagonals of a flat quadrangle.
    /// </summary>
    private static double? CircleSum(FaceSet faces, int corner)
    {
        var twin = faces.Twins[corner];
        if (twin == corner || faces.Twins[twin] != corner)
        {
            return null;
        }

        var (a, b) = (faces.PointOf(corner), faces.PointOf(faces.After(corner)));
        var (c, d) = (faces.PointOf(faces.After(corner, 2)), faces.PointOf(faces.After(twin, 2)));
        var (normal1, normal2) = (Vector.Cross(a - c, b - c), Vector.Cross(b - d, a - d));
        return Vector.Dot(normal1, normal2) <= 0 || Math.Abs(Vector.Dot(d - c, normal1)) > faces.Tolerance * normal1.Length()
            ? null
            : (Vector.Dot(a - c, b - c) / normal1.Length()) + (Vector.Dot(a - d, b - d) / normal2.Length());
    }

    /// <summary>Joins triangles with corners on one circle, if that makes one polygon.</summary>
    private static IEnumerable<(int[] Outline, int[] Triangles)> Join(FaceSet faces, int[] group)
    {
        var triangles = group.SelectMany(face => faces.Corners[(3 * face)..((3 * face) + 3)]).ToArray();
        var outline = triangles.Distinct().ToArray();
        if (outline.Length != group.Length + 2)
        {
            return triangles.Chunk(3).Select(face => (face, face));
        }

        var centre = Vector.Mean(Array.ConvertAll(outline, point => faces.Points[point]));
        var (right, other) = (faces.Points[triangles[0]] - centre, faces.Points[triangles[1]] - faces.Points[triangles[0]]);
        var up = Vector.Cross(Vector.Cross(other, faces.Points[triangles[2]] - faces.Points[triangles[0]]), right);
        up = right.Length() / up.Length() * up;
        Array.Sort([.. outline.Select(point => Math.Atan2(
            Vector.Dot(faces.Points[point] - centre, up), Vector.Dot(faces.Points[point] - centre, right)))], outline);
        return [(outline, triangles)];
    }
}
