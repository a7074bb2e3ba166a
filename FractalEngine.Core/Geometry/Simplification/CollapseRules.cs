using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>Tests whether the collapse of an edge keeps the topology of the surface and turns no face over.</summary>
internal static class CollapseRules
{
    // Cosine of the largest angle by which a face may turn: 78°.
    private const double MinCosine = 0.2;

    /// <summary>Tests whether the collapse of an edge keeps the topology.</summary>
    /// <param name="star1">Star of the one end.</param>
    /// <param name="star2">Star of the other end.</param>
    /// <remarks>
    /// This is the link condition of T. Dey, H. Edelsbrunner, S. Guha and D. Nekhayev ("Topology preserving edge contraction", 1999): the
    /// ends have no neighbours in common but those across the faces of the edge, and others beside them; within a surface, they are not
    /// both at the border. An edge of more than two faces has no topology that is worth keeping.
    /// </remarks>
    public static bool KeepsTopology(VertexStar star1, VertexStar star2)
    {
        var faces = star1[star2.Vertex];
        return faces > 2 || (star1.Neighbours.Count(neighbour => star2[neighbour] > 0) == faces
            && Math.Max(star1.Neighbours.Count, star2.Neighbours.Count) > faces + 1
            && !(faces == 2 && star1.HasBorder && star2.HasBorder));
    }

    /// <summary>Tests whether the faces at one end of an edge, but those that vanish, keep their sides.</summary>
    /// <param name="positions">Of the vertices.</param>
    /// <param name="stars">Faces around the vertices.</param>
    /// <param name="star">Star of the end.</param>
    /// <param name="other">The other end.</param>
    /// <param name="position">Where the edge collapses to.</param>
    public static bool KeepsNormals(Vector[] positions, VertexStars stars, VertexStar star, int other, Vector position)
    {
        foreach (var corner in star.Corners)
        {
            var (next, previous) = stars.OthersOf(corner);
            var (a, b, c) = (positions[star.Vertex], positions[next], positions[previous]);
            var (before, after) = (Vector.Cross(b - a, c - a), Vector.Cross(b - position, c - position));
            var lengths = before.Length() * after.Length();
            if (next != other && previous != other && before != Vector.Zero && !(Vector.Dot(before, after) > MinCosine * lengths))
            {
                return false;
            }
        }

        return true;
    }
}
