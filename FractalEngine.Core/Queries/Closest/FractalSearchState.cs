using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>The state of a search on the levels of a fractal: the closest triangle so far, what that excludes, and the cost.</summary>
internal ref struct FractalSearchState
{
    // Searches that need more are left to BestFirstSearch, as those are that need more of the stack.
    private const int MaxBoundTests = 50_000;

    // About a second of work. What is still open then is said in the error bound of the result.
    private const int MaxWork = 1_000_000;

    // So many bounds suffice for most queries. What needs more has many sub-fractals at nearly the same distance.
    private const int MaxRoughBoundTests = 2500;

    // A larger error is allowed, but its square times that of a distance would leave the range of a double.
    private const double MaxEpsilon = 1e8;

    private readonly QueryContext _context;
    private readonly double _positionMagnitude;
    private readonly double _tolerance;
    private Span<int> _path;
    private Span<double> _scratch;

    /// <summary>Begins a search without a result.</summary>
    /// <param name="maxDistance">Search radius in the frame of the query.</param>
    /// <param name="epsilon">Relative error that the caller allows.</param>
    /// <param name="positionMagnitude">Largest absolute coordinate of the position.</param>
    /// <param name="magnitude">Largest absolute coordinate of the fractal and the position.</param>
    /// <param name="context">Lends its buffers.</param>
    public FractalSearchState(double maxDistance, double epsilon, double positionMagnitude, double magnitude, QueryContext context)
    {
        _positionMagnitude = positionMagnitude;
        _context = context;
        _path = context.PathBuffer(QueryContext.MaxStackDepth);
        _scratch = context.ScratchBuffer(QueryContext.InitialScratchLength);
        _tolerance = RoundingErrors.Coordinate * magnitude;
        BoundFactor = (1 + Math.Min(epsilon, MaxEpsilon)) * (1 + Math.Min(epsilon, MaxEpsilon));
        InverseBoundFactor = 1 / BoundFactor;
        ClosestFace = -1;
        OpenBoundSquared = double.PositiveInfinity;
        // A triangle at exactly the radius may seem farther by what rounding in the frames of the levels adds.
        ClosestDistanceSquared = DistanceCutoff.FromRadius(maxDistance + _tolerance);
        SetCutoff(ClosestDistanceSquared);
    }

    /// <summary>Squared distance of the closest triangle so far, or of the search radius.</summary>
    public double ClosestDistanceSquared { get; private set; }

    /// <summary>Limit for squared bounds, a little less than the squared distance of the closest triangle.</summary>
    public double CutoffSquared { get; private set; }

    /// <summary>Limit for squared bounds, where the error that the caller allows is taken off.</summary>
    public readonly double BoundCutoffSquared => CutoffSquared * InverseBoundFactor;

    /// <summary>Limit for bounds: the root of <see cref="BoundCutoffSquared"/>.</summary>
    public double BoundCutoff { get; private set; }

    /// <summary>Squared bounds are compared with limits times this: 1/(1 + ε)².</summary>
    public double InverseBoundFactor { get; }

    /// <summary>True when a depth-first search has given up.</summary>
    public bool HasExceededBudget { get; private set; }

    /// <summary>Squared radius in the frame of the query at which a sub-fractal is replaced by the base mesh.</summary>
    public double MinRadiusSquared { get; set; }

    /// <summary>Squared bounds are multiplied by this before they are compared: (1 + ε)².</summary>
    public double BoundFactor { get; }

    /// <summary>Face index of the closest triangle in the base mesh; −1 for none.</summary>
    public int ClosestFace { get; private set; }

    /// <summary>Number of child instances that lead to the closest triangle.</summary>
    public int ClosestDepth { get; private set; }

    /// <summary>Lower bound of the squared distance of all that was left open at the limit of work; infinite when nothing was.</summary>
    public double OpenBoundSquared { get; private set; }

    /// <summary>True when nothing was left open that may be closer than what was found.</summary>
    public readonly bool IsComplete => double.IsPositiveInfinity(OpenBoundSquared);

    /// <summary>True when a search may do no more work.</summary>
    public readonly bool HasMetWorkLimit => BoundTests >= MaxWork;

    /// <summary>Number of triangles that were tested.</summary>
    public long FaceTests { get; private set; }

    /// <summary>Number of bounding volumes that were tested.</summary>
    public long BoundTests { get; set; }

    /// <summary>Number of sub-fractals whose children were listed.</summary>
    public int VisitedSubFractals { get; set; }

    /// <summary>Number of searches of a mesh.</summary>
    public int MeshSearches { get; private set; }

    /// <summary>Number of bounding volumes among <see cref="BoundTests"/> that belong to triangle hierarchies.</summary>
    public long MeshBoundTests { get; private set; }

    /// <summary>True when the search has become so long that exact distances of sub-fractals' hulls pay.</summary>
    public readonly bool NeedsTightBounds => BoundTests > MaxRoughBoundTests;

    /// <summary>The queue of a <see cref="BestFirstSearch"/>.</summary>
    public readonly ExpandedChildren ExpandedChildren => _context.ExpandedChildren;

    /// <summary>Tells whether a squared bound in the frame of the query excludes a closer triangle.</summary>
    public readonly bool Excludes(double boundSquared) => !(boundSquared * BoundFactor < CutoffSquared);

    /// <summary>Adds the cost of a search of a mesh.</summary>
    public void AddStatistics(in ClosestTriangle closest)
    {
        FaceTests += closest.FaceTests;
        BoundTests += closest.BoundTests;
        MeshBoundTests += closest.BoundTests;
        MeshSearches++;
    }

    /// <summary>Records the child instance that is entered.</summary>
    /// <param name="depth">Number of child instances before it.</param>
    /// <param name="childIndex">Index of the child in its parent.</param>
    public void RecordChild(int depth, int childIndex)
    {
        if (depth >= _path.Length)
        {
            _path = _context.PathBuffer(2 * depth);
        }

        _path[depth] = childIndex;
    }

    /// <summary>Tells whether a depth-first search may go on; when it takes too long, everything is excluded from then on.</summary>
    public bool WithinBudget(int depth)
    {
        if (depth < QueryContext.MaxStackDepth && BoundTests < MaxBoundTests)
        {
            return true;
        }

        HasExceededBudget = true;
        SetCutoff(0);
        return false;
    }

    /// <summary>Begins again after giving up, limited by what was found.</summary>
    public void ResetBudget()
    {
        HasExceededBudget = false;
        SetCutoff(ClosestFace < 0 ? ClosestDistanceSquared : CutoffFor(ClosestDistanceSquared));
    }

    /// <summary>Records a triangle that is closer than all before, with the current path.</summary>
    /// <param name="distanceSquared">Its squared distance in the frame of the query.</param>
    /// <param name="faceIndex">Its face index in the base mesh.</param>
    /// <param name="depth">Number of child instances that lead to its mesh.</param>
    /// <param name="expanded">The sub-fractal that the mesh is; null for the base mesh.</param>
    public void UpdateClosest(double distanceSquared, int faceIndex, int depth, ExpandedSubFractal? expanded = null)
    {
        if (expanded is not null)
        {
            faceIndex = expanded.ResolveFace(faceIndex, ref depth, ref this);
        }

        ClosestDistanceSquared = distanceSquared;
        ClosestFace = faceIndex;
        ClosestDepth = depth;
        _path[..depth].CopyTo(_context.BestPathBuffer(_path.Length));
        SetCutoff(CutoffFor(distanceSquared));
    }

    /// <summary>Records a sub-fractal that is not searched for lack of work, unless it is excluded.</summary>
    /// <param name="boundSquared">Lower bound of its squared distance.</param>
    public void LeaveOpen(double boundSquared)
    {
        if (!Excludes(boundSquared))
        {
            OpenBoundSquared = Math.Min(OpenBoundSquared, boundSquared);
        }
    }

    /// <summary>Computes how much closer than the closest triangle another one may be, by rounding and by what was left open.</summary>
    /// <param name="distance">Distance of the closest triangle.</param>
    /// <param name="reach">Largest absolute coordinate on the path to it.</param>
    public readonly double ErrorBound(double distance, double reach)
    {
        var rounding = RoundingErrors.Coordinate * Math.Max(reach, _positionMagnitude + distance);
        // Sub-fractals of the least radius were replaced by the base mesh.
        var precision = 2 * Math.Sqrt(MinRadiusSquared);
        return Math.Max(0, distance - Math.Sqrt(OpenBoundSquared)) + rounding + precision;
    }

    /// <summary>Reserves scratch memory for the children of a sub-fractal, see <see cref="ChildQueue"/>.</summary>
    /// <param name="offset">Where the memory of the levels above ends.</param>
    /// <param name="length">Number of values.</param>
    public Span<double> ScratchSlice(int offset, int length)
    {
        if (_scratch.Length < offset + length)
        {
            // The levels above keep their old memory.
            _scratch = _context.ScratchBuffer(2 * (offset + length));
        }

        return _scratch.Slice(offset, length);
    }

    private void SetCutoff(double cutoffSquared)
    {
        CutoffSquared = cutoffSquared;
        BoundCutoff = Math.Sqrt(BoundCutoffSquared);
    }

    // Distances that differ by no more than rounding count as equal. Otherwise positions far from small children would visit all of them.
    private readonly double CutoffFor(double distanceSquared)
    {
        var distance = Math.Sqrt(distanceSquared);
        // What is no farther than the closest triangle has no larger coordinates than that, however far the fractal reaches elsewhere.
        var tolerance = Math.Min(_tolerance, RoundingErrors.Coordinate * (_positionMagnitude + distance));
        distance = Math.Max(0, distance - tolerance);
        return distance * distance;
    }
}
