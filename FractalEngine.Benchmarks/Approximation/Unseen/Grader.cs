using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Compares the expansion of a file that a search has written with the undamaged model, which the search did not see.</summary>
/// <remarks>
/// "All generators are found within t" means: recall and precision are 1 at tolerance t, so that the expansion of the file equals the
/// undamaged model. Which maps the file has plays no part, since the same fractal has many descriptions. A file whose base is the whole
/// model grades as found as well; whoever judges a search also compares the size of its file with <see cref="UnseenInput.BaseFaces"/> and
/// the number of <see cref="UnseenInput.Generators"/>. Vertices that no face uses do not count. A vertex that stands several times in the
/// expansion counts as often for precision. An empty expansion has precision 0 and infinite distances.
/// </remarks>
internal static class Grader
{
    /// <summary>Compares vertices with vertices, both ways. Cost O(n·log n), some seconds for a million vertices.</summary>
    /// <param name="expansion">The flat expansion of the file.</param>
    /// <param name="input">The model that the file should expand to.</param>
    /// <param name="tolerance">How far a vertex may be from the closest one, in scene units; see <see cref="Damage.Tolerance"/>.</param>
    public static Grade Compare(Mesh expansion, UnseenInput input, double tolerance)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(tolerance);
        return Compare(expansion, input, tolerance, VertexDistance);
    }

    /// <summary>Compares vertices with surfaces, both ways: for meshes whose edges were split or collapsed.</summary>
    /// <inheritdoc cref="Compare(Mesh, UnseenInput, double)"/>
    public static Grade CompareSurfaces(Mesh expansion, UnseenInput input, double tolerance)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(tolerance);
        return Compare(expansion, input, tolerance, SurfaceDistance);
    }

    private static Grade Compare(Mesh expansion, UnseenInput input, double tolerance, Func<Mesh, Func<Vector, double>> distanceTo)
    {
        var clean = input.Clean;
        var toExpansion = DistancesOf(clean, distanceTo(expansion));
        var toClean = DistancesOf(expansion, distanceTo(clean));
        var found = input.Elements.Count(element => IsWithin(clean, element, toExpansion, tolerance));
        // Vertices that no face uses have the distance −1.
        var (used, close) = (toClean.Count(distance => distance >= 0), toClean.Count(distance => distance >= 0 && distance <= tolerance));
        var (missing, foreign) = (toExpansion.Append(0).Max(), used == 0 ? double.PositiveInfinity : toClean.Max());
        return new(
            missing / clean.Bounds.Diagonal,
            foreign / clean.Bounds.Diagonal,
            Math.Max(missing, foreign) / input.SmallestElement,
            found,
            (double)found / input.ElementCount,
            used == 0 ? 0 : (double)close / used);
    }

    private static bool IsWithin(Mesh mesh, UnseenElement element, double[] distances, double tolerance)
    {
        for (var i = 3 * element.FirstFace; i < 3 * (element.FirstFace + element.FaceCount); i++)
        {
            if (distances[mesh.VertexIndices[i]] > tolerance)
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Computes the distance of each vertex that a face uses, and −1 for the others.</summary>
    private static double[] DistancesOf(Mesh mesh, Func<Vector, double> distance)
    {
        var distances = new double[mesh.VertexCount];
        Array.Fill(distances, -1);
        foreach (var vertex in mesh.VertexIndices)
        {
            if (distances[vertex] < 0)
            {
                distances[vertex] = distance(mesh.Vertex(vertex));
            }
        }

        return distances;
    }

    private static Func<Vector, double> VertexDistance(Mesh mesh)
    {
        var isUsed = new bool[mesh.VertexCount];
        foreach (var vertex in mesh.VertexIndices)
        {
            isUsed[vertex] = true;
        }

        var tree = new PointTree([.. MeshTools.Positions(mesh).Where((_, vertex) => isUsed[vertex])]);
        var last = -1;
        return position => Math.Sqrt(tree.DistanceSquared(position, ref last));
    }

    private static Func<Vector, double> SurfaceDistance(Mesh mesh)
    {
        if (mesh.FaceCount == 0)
        {
            return _ => double.PositiveInfinity;
        }

        var (collider, context) = (new HierarchyCollider(mesh), new QueryContext());
        return position => collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest)
            ? closest.Distance : double.PositiveInfinity;
    }
}
