
namespace FractalEngine.Core.Collision.Fractals;

/// <summary>A search on the levels of a fractal as it goes on: what it has found so far, what that excludes, and its costs.</summary>
internal ref struct FractalSearchState
{
    // Each copy takes a frame of the stack, about 1 KB. What needs more than either is left to BestFirstSearch.
    private const int MaxStackDepth = 128;
    private const int MaxBoundTests = 50_000;

    /// <summary>Chains of more copies end here.</summary>
    public const int MaxDepth = 20_000;

    // More than what coordinates round by along a chain of maps, as a part of the largest of them.
    private const double Rounding = 4e-15;

    private readonly QueryContext _context;
    private Span<int> _path;
    private Span<int> _closestPath;
    private readonly double _tolerance;
    private Span<double> _scratch;

    /// <summary>Begins a search.</summary>
    /// <param name="maxDistance">Nothing farther away is looked for.</param>
    /// <param name="epsilon">Answers may be farther than the nearest by 1 + ε.</param>
    /// <param name="magnitude">Of coordinates.</param>
    /// <param name="context">Lends memory.</param>
    public FractalSearchState(double maxDistance, double epsilon, double magnitude, QueryContext context)
    {
        _context = context;
        _path = context.PathBuffer(MaxStackDepth);
        _closestPath = context.BestPathBuffer(MaxStackDepth);
        _scratch = context.ScratchBuffer(1);
        // One ulp more, so that a face at exactly the distance is found.
        ClosestDistanceSquared = maxDistance < double.PositiveInfinity
            ? Math.BitIncrement(maxDistance * maxDistance)
            : double.PositiveInfinity;
        (CutoffSquared, BoundFactor, _tolerance, ClosestFace) =
            (ClosestDistanceSquared, (1 + epsilon) * (1 + epsilon), Rounding * magnitude, -1);
    }

    /// <summary>Squared distance of the nearest face so far, or of the limit that was asked for.</summary>
    public double ClosestDistanceSquared { get; private set; }

    /// <summary>Squared bounds from here on can't matter: a little less than the nearest so far.</summary>
    public double CutoffSquared { get; private set; }

    /// <summary>True when a search into the depth has given up.</summary>
    public bool HasExceededBudget { get; private set; }

    /// <summary>Square of half the size, in the frame of the whole, of what is answered by the base mesh in its place.</summary>
    public double MinRadiusSquared { get; set; }

    /// <summary>Squared bounds are multiplied by this before they are compared: (1 + ε)².</summary>
    public double BoundFactor { get; }

    /// <summary>The nearest face of the base, −1 for none.</summary>
    public int ClosestFace { get; private set; }

    /// <summary>How many copies lead to it.</summary>
    public int ClosestDepth { get; private set; }

    public long FaceTests;
    public long BoundTests;

    /// <summary>The copies that lead to the nearest face.</summary>
    public readonly ReadOnlySpan<int> ClosestPath => _closestPath[..ClosestDepth];

    /// <summary>Of a <see cref="BestFirstSearch"/>.</summary>
    public readonly ExpandedChildren ExpandedChildren => _context.ExpandedChildren;

    /// <summary>True for squared bounds, in the frame of the whole, of what can't be nearer.</summary>
    public readonly bool Excludes(double boundSquared) => !(boundSquared * BoundFactor < CutoffSquared);

    /// <summary>Remembers the copy that is gone into.</summary>
    public void RecordChild(int depth, int childIndex)
    {
        if (depth >= _path.Length)
        {
            _path = _context.PathBuffer(2 * depth);
        }

        _path[depth] = childIndex;
    }

    /// <summary>For searches into the depth: false when they take too long, and then nothing matters any more.</summary>
    public bool WithinBudget(int depth)
    {
        if (depth < MaxStackDepth && BoundTests < MaxBoundTests)
        {
            return true;
        }

        (HasExceededBudget, CutoffSquared) = (true, 0);
        return false;
    }

    /// <summary>Begins once more after giving up; nothing farther than what was found matters.</summary>
    public void ResetBudget() =>
        (HasExceededBudget, CutoffSquared) = (false, ClosestFace < 0 ? ClosestDistanceSquared : CutoffFor(ClosestDistanceSquared));

    /// <summary>A face that is nearer than all before.</summary>
    /// <param name="distanceSquared">Its squared distance in the frame of the whole.</param>
    /// <param name="faceIndex">Of the base.</param>
    /// <param name="depth">How many copies lead to it.</param>
    public void UpdateClosest(double distanceSquared, int faceIndex, int depth)
    {
        (ClosestDistanceSquared, ClosestFace, ClosestDepth) = (distanceSquared, faceIndex, depth);
        if (depth > _closestPath.Length)
        {
            _closestPath = _context.BestPathBuffer(_path.Length);
        }

        _path[..depth].CopyTo(_closestPath);
        CutoffSquared = CutoffFor(distanceSquared);
    }

    /// <summary>Room for the numbers of a sub-fractal's copies, see <see cref="ChildQueue"/>.</summary>
    /// <param name="offset">Where the memory of the levels above ends.</param>
    /// <param name="length">How many.</param>
    public Span<double> ScratchSlice(int offset, int length)
    {
        if (_scratch.Length < offset + length)
        {
            // What the levels above use stays where it is.
            _scratch = _context.ScratchBuffer(2 * (offset + length));
        }

        return _scratch.Slice(offset, length);
    }

    // Distances that differ by no more than they round by are the same: without this, positions far from small copies would look at all of
    // them.
    private readonly double CutoffFor(double distanceSquared)
    {
        var distance = Math.Max(0, Math.Sqrt(distanceSquared) - _tolerance);
        return distance * distance;
    }
}
