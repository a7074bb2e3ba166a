namespace FractalEngine.Tests.Geometry;

/// <summary>Random polygons of the squares of a grid, which touch themselves at corners, with holes behind bridges.</summary>
internal static class TouchingPolygons
{
    private static readonly (int X, int Y)[] Directions = [(1, 0), (0, 1), (-1, 0), (0, -1)];

    /// <summary>
    /// Grows a connected set of squares and walks around a spanning tree of it, anticlockwise. Where neighbours are not joined by the tree,
    /// their common side is walked there and back, as a bridge to a hole is.
    /// </summary>
    public static List<(double X, double Y)> Create(Random random, int size)
    {
        HashSet<(int X, int Y)> squares = [(0, 0)];
        while (squares.Count < size * 3)
        {
            var (x, y) = squares.ElementAt(random.Next(squares.Count));
            var (dx, dy) = Directions[random.Next(4)];
            squares.Add((x + dx, y + dy));
        }

        List<(double X, double Y)> polygon = [];
        HashSet<(int X, int Y)> visited = [(0, 0)];
        for (var side = 0; side < 4; side++)
        {
            WalkSide((0, 0), side);
        }

        return Straighten(random, polygon);

        // Walks from the first corner of a side to its other corner: along it, or around the square behind it, if that is new.
        void WalkSide((int X, int Y) square, int side)
        {
            var (dx, dy) = Directions[(side + 3) % 4];
            var neighbour = (square.X + dx, square.Y + dy);
            if (!squares.Contains(neighbour) || !visited.Add(neighbour))
            {
                polygon.Add(CornerOf(square, side));
                return;
            }

            // The common side of the neighbour is the opposite one, which is left out.
            for (var i = 1; i < 4; i++)
            {
                WalkSide(neighbour, (side + 2 + i) % 4);
            }
        }
    }

    // Side 0 goes along the bottom from the left, and the others follow anticlockwise; a side is named by the corner it starts from.
    private static (double X, double Y) CornerOf((int X, int Y) square, int side) => side switch
    {
        0 => (square.X, square.Y),
        1 => (square.X + 1, square.Y),
        2 => (square.X + 1, square.Y + 1),
        _ => (square.X, square.Y + 1),
    };

    /// <summary>Removes some of the straight corners, so that corners also touch edges between corners.</summary>
    private static List<(double X, double Y)> Straighten(Random random, List<(double X, double Y)> polygon)
    {
        List<(double X, double Y)> kept = [.. polygon];
        for (var i = kept.Count - 1; i >= 0 && kept.Count > 4; i--)
        {
            var (a, b, c) = (kept[(i + kept.Count - 1) % kept.Count], kept[i], kept[(i + 1) % kept.Count]);
            var isStraight = ((b.X - a.X) * (c.Y - b.Y)) - ((b.Y - a.Y) * (c.X - b.X)) == 0
                && ((b.X - a.X) * (c.X - b.X)) + ((b.Y - a.Y) * (c.Y - b.Y)) > 0;
            if (isStraight && random.Next(2) == 0)
            {
                kept.RemoveAt(i);
            }
        }

        return kept;
    }
}
