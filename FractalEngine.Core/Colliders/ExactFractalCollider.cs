using System.Runtime.CompilerServices;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Closest;
using FractalEngine.Core.Queries.Regions;

namespace FractalEngine.Core.Colliders;

/// <summary>
/// Finds the closest point of a fractal of any depth, exactly, by branch and bound over its levels. Each sub-fractal is bounded by a box
/// that provably contains it, and mostly by a convex hull too. The closest is visited first, and sub-fractals that can't be closer than
/// the best so far are skipped.
/// </summary>
/// <remarks>
/// Memory and time follow the levels, not the faces. Why the bounds hold is explained in docs/colliders.md. Sub-fractals smaller than
/// <see cref="RelativePrecision"/> of the whole are replaced by the base mesh: that is the last place of a coordinate. Infinite fractals
/// end there too.
/// </remarks>
public sealed class ExactFractalCollider : Collider
{
    /// <summary>The part of a fractal's size below which no further level is visited.</summary>
    public const double RelativePrecision = LevelPrecision.RelativePrecision;

    private static readonly AffineMap Identity = AffineMap.Identity;

    // Sums of a few such coordinates are doubles in the fractal's own unit, too.
    private const double MaxMagnitude = 1e307;

    private readonly FractalHierarchy _hierarchy;
    private readonly TriangleBvh[] _baseBvhs;

    private readonly ExpandedLevels _expandedLevels;
    private readonly double _minRadius;
    private readonly double _rootMagnitude;

    // Infinite for a fractal that is too large under any map, else 0.
    private readonly double _excess;
    private readonly IDepthFirstSearch<SimilarityFrame> _similaritySearch;
    private readonly IDepthFirstSearch<AffineFrame> _affineSearch;
    private readonly BestFirstSearch _bestFirstSearch;

    /// <summary>Prepares a fractal in affine composition for queries.</summary>
    /// <exception cref="FractalLimitException">
    /// The bounds of some level overflow a double, or don't converge; the message names the level.
    /// </exception>
    /// <exception cref="ArgumentException">The fractal is composed componentwise.</exception>
    /// <exception cref="SingularMatrixException">
    /// A map has no inverse, as with a scale of 0. The parser refuses fractal files with such a map.
    /// </exception>
    /// <remarks>Cost: microseconds to milliseconds, whatever the depth.</remarks>
    public ExactFractalCollider(Fractal fractal)
        : this(HierarchyOf(fractal))
    {
    }

    /// <summary>Prepares a hierarchy, perhaps of several recursives, for queries.</summary>
    /// <remarks>A result has the index of a face in the base mesh of its instance, which the instance path tells.</remarks>
    internal ExactFractalCollider(FractalHierarchy hierarchy)
    {
        _hierarchy = hierarchy;
        _baseBvhs = Array.ConvertAll(hierarchy.BaseMeshes, TriangleBvh.For);
        _minRadius = LevelPrecision.MinRadius(_hierarchy.Root);
        _rootMagnitude = _hierarchy.Root.Box.MaxAbsCoordinate();
        _excess = _rootMagnitude > MaxMagnitude ? double.PositiveInfinity : 0;
        _expandedLevels = ExpandedLevels.For(_hierarchy, _baseBvhs[0]);
        _similaritySearch = CreateSearch<SimilarityFrame>(_expandedLevels);
        _affineSearch = CreateSearch<AffineFrame>(ExpandedLevels.None);
        _bestFirstSearch = new(_hierarchy, _baseBvhs);
    }

    /// <inheritdoc/>
    public override bool IsExact => true;

    /// <inheritdoc/>
    public override long StorageBytes =>
        _hierarchy.StorageBytes + _baseBvhs.Sum(static bvh => bvh.StorageBytes) + _expandedLevels.StorageBytes;

    /// <inheritdoc/>
    internal override bool SupportsTransformedQueries => true;

    /// <inheritdoc/>
    internal override bool FindClosestTransformed(Vector position, AffineMap map, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest) =>
        FindClosestInImage(in position, in map, isSimilarity: false, maxDistance, epsilon, context, out closest);

    /// <inheritdoc/>
    private protected override ShapeTree CreateShapeTree() => new(_hierarchy, _baseBvhs, _minRadius);

    /// <inheritdoc/>
    protected override bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest) =>
        IsFarther(in position, maxDistance, context, out closest) ? false
        : FindClosestInImage(in position, in Identity, _hierarchy.HasOnlySimilarities, maxDistance, epsilon, context, out closest);

    private static FractalHierarchy HierarchyOf(Fractal fractal) => fractal.Description.Composition == Composition.Affine
        ? fractal.Hierarchy
        : throw new ArgumentException("expected affine composition: componentwise sums have no levels to search", nameof(fractal));

    private IDepthFirstSearch<TFrame> CreateSearch<TFrame>(ExpandedLevels expandedLevels)
        where TFrame : struct, ISearchFrame<TFrame> => _baseBvhs is [var only]
        ? new DepthFirstSearch<TFrame, OneBaseMesh>(_hierarchy, new(only), expandedLevels)
        : new DepthFirstSearch<TFrame, SeveralBaseMeshes>(_hierarchy, new(_baseBvhs), expandedLevels);

    /// <summary>Tells whether all of the fractal is beyond a radius, at the cost of one box.</summary>
    private bool IsFarther(in Vector position, double maxDistance, QueryContext context, out ClosestPoint closest)
    {
        Unsafe.SkipInit(out closest);
        // The sum is no less than the largest coordinate, and sooner found.
        var magnitude = Math.Abs(position.X) + Math.Abs(position.Y) + Math.Abs(position.Z) + _rootMagnitude;
        var limit = maxDistance + (RoundingErrors.Coordinate * magnitude);
        if (!(_hierarchy.Root.BoxDistanceSquared(SimdAffineMap.ToVector256(position)) > DistanceCutoff.FromRadius(limit)))
        {
            return false;
        }

        context.ClearPath();
        context.Statistics.BoundTests++;
        closest = default;
        return true;
    }

    /// <summary>Finds the closest point of the fractal's image under a map.</summary>
    /// <param name="position">In the frame of the image.</param>
    /// <param name="map">From the fractal's frame to that of the image.</param>
    /// <param name="isSimilarity">True when the map is the identity and all maps of the fractal are similarities.</param>
    /// <param name="maxDistance">Search radius in the frame of the image.</param>
    /// <param name="epsilon">Relative error that the caller allows.</param>
    /// <param name="context">Receives the cost and the instance.</param>
    /// <param name="closest">The closest point in the frame of the image, if there is one.</param>
    private bool FindClosestInImage(
        in Vector position, in AffineMap map, bool isSimilarity, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        context.ClearPath();
        Unsafe.SkipInit(out closest);
        if (_hierarchy.Root.Box.IsEmpty)
        {
            closest = default;
            return false;
        }

        var positionMagnitude = position.MaxAbsComponent();
        // In the fractal's own frame, its box was tested before.
        var box = isSimilarity ? _hierarchy.Root.Box : _hierarchy.Root.Box.Transform(map);
        var magnitude = Math.Max(
            positionMagnitude, isSimilarity ? _rootMagnitude : Math.Max(_excess, box.MaxAbsCoordinate()));
        if (QueryScale.IsNeeded(magnitude))
        {
            if (double.IsFinite(positionMagnitude) && Math.Max(positionMagnitude, _rootMagnitude) > MaxMagnitude)
            {
                throw new FractalLimitException("the distances within the fractal, or to it, are beyond the range of a double");
            }

            return ScaledQuery.FindClosest(this, in position, in map, magnitude, maxDistance, epsilon, context, out closest);
        }

        var search = new FractalSearchState(maxDistance, epsilon, positionMagnitude, magnitude, context);
        search.BoundTests++;
        if (isSimilarity || !search.Excludes(box.DistanceSquared(position)))
        {
            SearchLevels(in position, in map, isSimilarity, ref search);
        }

        context.Statistics.FaceTests += search.FaceTests;
        context.Statistics.BoundTests += search.BoundTests;
        if (search.ClosestFace < 0)
        {
            closest = default;
            if (!search.IsComplete)
            {
                throw new FractalLimitException(
                    "the search has met its limit of work, and knows neither a point within the radius nor that there is none");
            }

            return NeedsExactRetry(maxDistance, epsilon)
                && FindClosestInImage(in position, in map, isSimilarity, maxDistance, 0, context, out closest);
        }

        var instance = _hierarchy.ResolveInstance(search.ClosestDepth, _hierarchy.Top, in map, context, out var reach);
        var mesh = _hierarchy.BaseMeshes[context.MeshIndex];
        ClosestPointFactory.OnInstance(mesh, search.ClosestFace, in instance, in position, out closest);
        reach = Math.Max(reach, closest.Point.MaxAbsComponent());
        ClosestPoint.SetErrorBound(ref closest, search.ErrorBound(closest.Distance, reach));
        return closest.Distance <= maxDistance || (NeedsExactRetry(maxDistance, epsilon)
            && FindClosestInImage(in position, in map, isSimilarity, maxDistance, 0, context, out closest));
    }

    private void SearchLevels(in Vector position, in AffineMap map, bool isSimilarity, ref FractalSearchState search)
    {
        // Where most of the fractal is far smaller than all of it, a result is as precise as its own coordinates.
        var precision = _hierarchy.Root.Clusters is null ? 0 : RelativePrecision * position.MaxAbsComponent();
        if (isSimilarity)
        {
            search.MinRadiusSquared = Math.Max(_minRadius * _minRadius, precision * precision);
            _similaritySearch.Run(new(position), ref search);
        }
        else
        {
            search.MinRadiusSquared = Math.Max(LevelPrecision.MappedRadiusSquared(_minRadius, in map), precision * precision);
            _affineSearch.Run(new(position, in map), ref search);
        }

        if (search.HasExceededBudget)
        {
            search.ResetBudget();
            _bestFirstSearch.Run(position, in map, ref search);
        }
    }
}
