namespace FractalEngine.Core.Collision;

/// <summary>A search on the levels of a fractal as it goes on: what it has found so far, what that excludes, and its costs.</summary>
internal ref struct FractalSearch
{
    // Each copy takes a frame of the stack, about 1 KB. What needs more than either is left to BestFirstSearch.
    private const int MostFrames = 128;
    private const int MostBoundTests = 50_000;

    /// <summary>Chains of more copies end here.</summary>
    public const int Deepest = 20_000;

    // More than what coordinates round by along a chain of maps, as a part of the largest of them.
    private const double Rounding = 4e-15;

    private readonly QueryRecord _record;
    private Span<int> _trail;
    private Span<int> _bestTrail;
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
        _trail = record.Trail(MostFrames);
        _bestTrail = record.BestTrail(MostFrames);
        _scratch = record.Scratch(1);
        // One ulp more, so that a face at exactly the distance is found.
        NearestSquared = within < double.PositiveInfinity ? Math.BitIncrement(within * within) : double.PositiveInfinity;
        (Limit, BoundFactor, _tolerance, Face) = (NearestSquared, (1 + epsilon) * (1 + epsilon), Rounding * magnitude, -1);
    }

    /// <summary>Squared distance of the nearest face so far, or of the limit that was asked for.</summary>
    public double NearestSquared { get; private set; }

    /// <summary>Squared bounds from here on can't matter: a little less than the nearest so far.</summary>
    public double Limit { get; private set; }

    /// <summary>True when a search into the depth has given up.</summary>
    public bool HasGivenUp { get; private set; }

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

    /// <summary>Of a <see cref="BestFirstSearch"/>.</summary>
    public readonly OpenCopies OpenCopies => _record.OpenCopies;

    /// <summary>True for squared bounds, in the frame of the whole, of what can't be nearer.</summary>
    public readonly bool Excludes(double boundSquared) => !(boundSquared * BoundFactor < Limit);

    /// <summary>Remembers the copy that is gone into.</summary>
    public void Enter(int depth, int copy)
    {
        if (depth >= _trail.Length)
        {
            _trail = _record.Trail(2 * depth);
        }

        _trail[depth] = copy;
    }

    /// <summary>For searches into the depth: false when they take too long, and then nothing matters any more.</summary>
    public bool MayGoOn(int depth)
    {
        if (depth < MostFrames && BoundTests < MostBoundTests)
        {
            return true;
        }

        (HasGivenUp, Limit) = (true, 0);
        return false;
    }

    /// <summary>Begins once more after giving up; nothing farther than what was found matters.</summary>
    public void Resume() => (HasGivenUp, Limit) = (false, Face < 0 ? NearestSquared : LimitOf(NearestSquared));

    /// <summary>A face that is nearer than all before.</summary>
    /// <param name="squared">Its squared distance in the frame of the whole.</param>
    /// <param name="face">Of the base.</param>
    /// <param name="depth">How many copies lead to it.</param>
    public void Improve(double squared, int face, int depth)
    {
        (NearestSquared, Face, FaceDepth) = (squared, face, depth);
        if (depth > _bestTrail.Length)
        {
            _bestTrail = _record.BestTrail(_trail.Length);
        }

        _trail[..depth].CopyTo(_bestTrail);
        Limit = LimitOf(squared);
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

    // Distances that differ by no more than they round by are the same: without this, positions far from small copies would look at all of them.
    private readonly double LimitOf(double squared)
    {
        var distance = Math.Max(0, Math.Sqrt(squared) - _tolerance);
        return distance * distance;
    }
}
