namespace FractalEngine.Core.Collision;

/// <summary>A search on the levels of a fractal as it goes on: what it has found so far, what that excludes, and its costs.</summary>
internal ref struct FractalSearch
{
    /// <summary>Each level takes one frame of the stack; fractals whose levels hardly shrink reach the precision after more than fit.</summary>
    public const int Deepest = 2000;

    // More than what coordinates round by along a chain of maps, as a part of the largest of them.
    private const double Rounding = 4e-15;

    private readonly QueryRecord _record;
    private readonly Span<int> _trail;
    private readonly Span<int> _bestTrail;
    private readonly double _tolerance;
    private Span<double> _scratch;

    /// <summary>Begins a search.</summary>
    /// <param name="within">Nothing farther away is looked for.</param>
    /// <param name="epsilon">Answers may be farther than the nearest by 1 + ε.</param>
    /// <param name="magnitude">Of coordinates.</param>
    /// <param name="record">Lends memory.</param>
    public FractalSearch(double within, double epsilon, double magnitude, QueryRecord record)
    {
        _record = record;
        _trail = record.Trail(Deepest + 1);
        _bestTrail = record.BestTrail(Deepest + 1);
        _scratch = record.Scratch(1);
        // One ulp more, so that a face at exactly the distance is found.
        NearestSquared = within < double.PositiveInfinity ? Math.BitIncrement(within * within) : double.PositiveInfinity;
        (Limit, BoundFactor, _tolerance, Face) = (NearestSquared, (1 + epsilon) * (1 + epsilon), Rounding * magnitude, -1);
    }

    /// <summary>Squared distance of the nearest face so far, or of the limit that was asked for.</summary>
    public double NearestSquared { get; private set; }

    /// <summary>Squared bounds from here on can't matter: a little less than the nearest so far.</summary>
    public double Limit { get; private set; }

    /// <summary>Square of half the size, in the frame of the whole, of what is answered by the base mesh in its place.</summary>
    public double PrecisionSquared { get; set; }

    /// <summary>Squared bounds are multiplied by this before they are compared: (1 + ε)².</summary>
    public double BoundFactor { get; }

    /// <summary>The nearest face of the base, −1 for none.</summary>
    public int Face { get; private set; }

    /// <summary>How many copies lead to it.</summary>
    public int FaceDepth { get; private set; }

    public long FaceTests;
    public long BoundTests;

    /// <summary>The copies that lead to the nearest face.</summary>
    public readonly ReadOnlySpan<int> FaceTrail => _bestTrail[..FaceDepth];

    /// <summary>True for squared bounds, in the frame of the whole, of what can't be nearer.</summary>
    public readonly bool Excludes(double boundSquared) => !(boundSquared * BoundFactor < Limit);

    /// <summary>Remembers the copy that is gone into.</summary>
    public readonly void Enter(int depth, int copy) => _trail[depth] = copy;

    /// <summary>A face that is nearer than all before.</summary>
    /// <param name="squared">Its squared distance in the frame of the whole.</param>
    /// <param name="face">Of the base.</param>
    /// <param name="depth">How many copies lead to it.</param>
    public void Improve(double squared, int face, int depth)
    {
        (NearestSquared, Face, FaceDepth) = (squared, face, depth);
        _trail[..depth].CopyTo(_bestTrail);
        // Distances that differ by no more than they round by are the same: without this, positions far from small copies would look at all of them.
        var distance = Math.Max(0, Math.Sqrt(squared) - _tolerance);
        Limit = distance * distance;
    }

    /// <summary>Room for the numbers of a sub-fractal's copies, see <see cref="CopyQueue"/>.</summary>
    /// <param name="offset">Where the memory of the levels above ends.</param>
    /// <param name="length">How many.</param>
    public Span<double> Numbers(int offset, int length)
    {
        if (_scratch.Length < offset + length)
        {
            // What the levels above use stays where it is.
            _scratch = _record.Scratch(2 * (offset + length));
        }

        return _scratch.Slice(offset, length);
    }
}
