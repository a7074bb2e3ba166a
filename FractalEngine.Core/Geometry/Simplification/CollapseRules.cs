using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>Tests whether the collapse of an edge keeps the topology of the surface and turns no face over.</summary>
/// <param name="positions">Of the vertices.</param>
/// <param name="stars">Faces around the vertices.</param>
internal sealed class CollapseRules(Vector[] positions, VertexStars stars)
{
    // Cosine of the largest angle by which a face may turn: 78°.
    private const double MinCosine = 0.2;

    private readonly EdgeFaceCounts _edges1 = new(stars);
    private readonly EdgeFaceCounts _edges2 = new(stars);

    /// <summary>Tests whether the collapse of an edge keeps the topology.</summary>
    /// <remarks>
    /// This is the link condition of T. Dey, H. Edelsbrunner, S. Guha and D. Nekhayev ("Topology preserving edge contraction", 1999), where
    /// all of the border leads to one more vertex. An edge of more than two faces has no topology that is worth keeping.
    /// </remarks>
    public bool KeepsTopology(int vertex1, List<int> star1, int vertex2, List<int> star2)
    {
        _edges1.Count(star1);
        _edges2.Count(star2);
        var keeps = _edges1[vertex2] > 2 || HasLinkCondition(vertex1, star1, vertex2, star2);
        _edges1.Clear(star1);
        _edges2.Clear(star2);
        return keeps;
    }

    /// <summary>Tests whether the faces at one end of an edge, but those that vanish, keep their sides.</summary>
    /// <param name="vertex">The end.</param>
    /// <param name="star">Its star.</param>
    /// <param name="other">The other end.</param>
    /// <param name="position">Where the edge collapses to.</param>
    public bool KeepsNormals(int vertex, List<int> star, int other, Vector position)
    {
        foreach (var corner in star)
        {
            var (next, previous) = stars.OthersOf(corner);
            if (next == other || previous == other)
            {
                continue;
            }

            var (a, b, c) = (positions[vertex], positions[next], positions[previous]);
            var (before, after) = (Vector.Cross(b - a, c - a), Vector.Cross(b - position, c - position));
            var lengths = before.Length() * after.Length();
            if (before != Vector.Zero && !(Vector.Dot(before, after) > MinCosine * lengths))
            {
                return false;
            }
        }

        return true;
    }

    private bool HasLinkCondition(int vertex1, List<int> star1, int vertex2, List<int> star2)
    {
        var (opposite1, opposite2) = (-1, -1);
        foreach (var corner in star1)
        {
            var (next, previous) = stars.OthersOf(corner);
            if (next == vertex2 || previous == vertex2)
            {
                opposite2 = opposite1;
                opposite1 = next == vertex2 ? previous : next;
            }
        }

        foreach (var corner in star2)
        {
            var (next, previous) = stars.OthersOf(corner);
            if (IsJoinedElsewhere(next) || IsJoinedElsewhere(previous))
            {
                return false;
            }
        }

        var joinsBorders = _edges1[vertex2] == 2 && HasBorder(star1, _edges1) && HasBorder(star2, _edges2);
        var isEar = _edges1[opposite1] == 1 && _edges2[opposite1] == 1;
        return !joinsBorders && !isEar && !(HasFace(star1, opposite1, opposite2) && HasFace(star2, opposite1, opposite2));

        // The collapse would make one edge of two.
        bool IsJoinedElsewhere(int vertex) =>
            vertex != vertex1 && vertex != opposite1 && vertex != opposite2 && _edges1[vertex] > 0;
    }

    private bool HasBorder(List<int> star, EdgeFaceCounts edges)
    {
        foreach (var corner in star)
        {
            var (next, previous) = stars.OthersOf(corner);
            if (edges[next] == 1 || edges[previous] == 1)
            {
                return true;
            }
        }

        return false;
    }

    private bool HasFace(List<int> star, int vertex1, int vertex2)
    {
        foreach (var corner in star)
        {
            var (next, previous) = stars.OthersOf(corner);
            if ((next == vertex1 && previous == vertex2) || (next == vertex2 && previous == vertex1))
            {
                return true;
            }
        }

        return false;
    }
}
