namespace FractalEngine.Core.Distances;

/// <summary>
/// Finds the largest distance of a surface from another one by branch and bound over its pieces. Pieces whose upper bound is below the
/// distance that was found are dropped; of the others, those with the largest bounds are divided.
/// </summary>
/// <remarks>
/// Pieces are divided in rounds of a fixed size. A round begins with one limit and ends in the order of the pieces, so the result doesn't
/// depend on threads.
/// </remarks>
/// <param name="target">The surface that distances are measured to.</param>
/// <param name="loop">The threads.</param>
/// <param name="farthest">The farthest point that is known.</param>
/// <param name="tolerance">Difference of the bounds at which to end, as a part of the distance.</param>
/// <param name="resolution">Difference of the bounds at which to end in any case, scene units.</param>
internal sealed class MaxDistanceSearch(
    TargetSurface target, BlockLoop loop, SurfacePoint farthest, double tolerance, double resolution)
{
    private const int PiecesPerRound = 256;

    private readonly PriorityQueue<SurfacePiece, double> _queue = new();
    private double _closedBound;

    /// <summary>The farthest point so far: its distance is a lower bound.</summary>
    public SurfacePoint Farthest { get; private set; } = farthest;

    /// <summary>Upper bound of the largest distance.</summary>
    public double UpperBound => Math.Max(
        Math.Max(Farthest.Distance, _closedBound), _queue.TryPeek(out _, out var priority) ? -priority : 0);

    /// <summary>Pieces whose upper bound is not larger are not divided.</summary>
    private double Limit => Farthest.Distance + Math.Max(tolerance * Farthest.Distance, resolution);

    /// <summary>Divides pieces until the bounds are close.</summary>
    /// <param name="faces">All faces, and an upper bound of each.</param>
    /// <param name="maxDivisions">Maximum number of pieces that are divided.</param>
    public void Run(IEnumerable<(SurfacePiece Piece, double UpperBound)> faces, int maxDivisions)
    {
        Add(faces);

        List<(SurfacePiece Piece, double UpperBound)> round = [];
        for (var left = maxDivisions; left > 0 && _queue.Count > 0; left -= round.Count)
        {
            TakeRound(round, Math.Min(left, PiecesPerRound));
            var limit = Limit;
            foreach (var (centre, parts) in loop.For(round.Count, (i, _) => Divide(round[i].Piece, round[i].UpperBound, limit)))
            {
                Farthest = SurfacePoint.Farther(Farthest, centre);
                Add(parts);
            }
        }
    }

    /// <summary>Takes the pieces with the largest bounds from the queue.</summary>
    private void TakeRound(List<(SurfacePiece Piece, double UpperBound)> round, int maxCount)
    {
        round.Clear();
        while (round.Count < maxCount && _queue.TryDequeue(out var piece, out var priority))
        {
            if (!IsOpen(-priority))
            {
                // All others have smaller bounds.
                _queue.Clear();
                return;
            }

            round.Add((piece, -priority));
        }
    }

    private void Add(IEnumerable<(SurfacePiece Piece, double UpperBound)> pieces)
    {
        foreach (var (piece, upperBound) in pieces)
        {
            if (IsOpen(upperBound))
            {
                _queue.Enqueue(piece, -upperBound);
            }
        }
    }

    /// <summary>Tells whether a piece must be divided. Keeps the bound of one that need not.</summary>
    private bool IsOpen(double upperBound)
    {
        if (upperBound > Limit)
        {
            return true;
        }

        _closedBound = Math.Max(_closedBound, upperBound);
        return false;
    }

    /// <summary>Bounds a piece more closely, and divides it if its bound is still above the limit.</summary>
    /// <returns>The measured centre; the parts with their upper bounds, or the whole piece.</returns>
    private (SurfacePoint Centre, (SurfacePiece Piece, double UpperBound)[] Parts) Divide(
        in SurfacePiece piece, double upperBound, double limit)
    {
        var centre = target.Measure(piece.Centre, 0);
        upperBound = Math.Min(upperBound, Math.Min(piece.UpperBound(target, centre.Face), piece.UpperBound(centre)));
        if (upperBound <= limit)
        {
            return (centre, [(piece, upperBound)]);
        }

        var parts = piece.Divide(target, centre.Face, upperBound - centre.Distance);
        return (centre, [.. parts.Select(part => (part, Math.Min(upperBound, part.UpperBound(target, centre.Face))))]);
    }
}
