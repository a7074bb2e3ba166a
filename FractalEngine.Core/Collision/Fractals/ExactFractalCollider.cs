using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// Exact search on fractals of any depth, by branch and bound over their levels: each sub-fractal is bounded by a box that provably holds
/// it, the nearest is looked at first, and what can't be nearer than the best so far is left out. Memory and time follow the levels, not
/// the faces; why the bounds hold stands in docs/colliders.md.
/// </summary>
/// <remarks>
/// Sub-fractals smaller than <see cref="RelativePrecision"/> of the whole are answered by the base mesh in their place: that is the last
/// place of a coordinate. Infinite fractals end there too.
/// </remarks>
public sealed class ExactFractalCollider : Collider
{
    /// <summary>The part of a fractal's size below which no further level is looked at.</summary>
    public const double RelativePrecision = 1e-15;

    private readonly Fractal _fractal;
    private readonly SubFractalTable _table;
    private readonly TriangleBvh _baseBvh;
    private readonly SimilaritySearch _similaritySearch;
    private readonly AffineSearch _affineSearch;
    private readonly BestFirstSearch _bestFirstSearch;

    /// <summary>Prepares a fractal in affine composition for queries.</summary>
    /// <exception cref="FractalLimitException">
    /// The bounds of some level are beyond a double, or don't settle; the message names it.
    /// </exception>
    /// <exception cref="ArgumentException">The fractal is composed componentwise.</exception>
    /// <exception cref="SingularMatrixException">
    /// A map flattens what it maps, as a scale of 0 does; fractal files with one are refused.
    /// </exception>
    /// <remarks>Cost: microseconds to milliseconds, whatever the depth.</remarks>
    public ExactFractalCollider(Fractal fractal)
    {
        if (fractal.Description.Composition != Composition.Affine)
        {
            throw new ArgumentException("expected affine composition: componentwise sums have no levels to search", nameof(fractal));
        }

        (_fractal, _table, _baseBvh) = (fractal, SubFractalTable.Build(fractal), new(fractal.BaseMesh));
        (_similaritySearch, _affineSearch, _bestFirstSearch) = (new(_table, _baseBvh), new(_table, _baseBvh), new(_table, _baseBvh));
    }

    /// <inheritdoc/>
    public override bool IsExact => true;

    /// <inheritdoc/>
    public override long StorageBytes => _table.StorageBytes + _baseBvh.StorageBytes;

    /// <inheritdoc/>
    internal override bool SupportsTransformedQueries => true;

    /// <inheritdoc/>
    internal override bool FindClosestTransformed(Vector position, AffineMap map, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest) =>
        FindClosestCore(position, map, isSimilarity: false, maxDistance, epsilon, context, out closest);

    /// <inheritdoc/>
    protected override bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest) =>
        FindClosestCore(position, AffineMap.Identity, _table.HasOnlySimilarities, maxDistance, epsilon, context, out closest);

    private bool FindClosestCore(
        Vector position, in AffineMap map, bool isSimilarity, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        context.ClearPath();
        closest = default;
        if (_fractal.BaseMesh.FaceCount == 0 || _table.Root.Box.IsEmpty)
        {
            return false;
        }

        var box = isSimilarity ? _table.Root.Box : _table.Root.Box.Transform(map);
        var magnitude = Math.Max(position.MaxAbsComponent(), Math.Max(box.Minimum.MaxAbsComponent(), box.Maximum.MaxAbsComponent()));
        var search = new FractalSearchState(maxDistance, epsilon, magnitude, context);
        search.BoundTests++;
        if (!search.Excludes(box.DistanceSquared(position)))
        {
            if (isSimilarity)
            {
                _similaritySearch.Run(position, ref search);
            }
            else
            {
                _affineSearch.Run(position, map, ref search);
            }

            if (search.HasExceededBudget)
            {
                search.ResetBudget();
                _bestFirstSearch.Run(position, in map, ref search);
            }
        }

        context.FaceTests += search.FaceTests;
        context.BoundTests += search.BoundTests;
        if (search.ClosestFace < 0)
        {
            return NeedsExactRetry(maxDistance, epsilon)
                && FindClosestCore(position, in map, isSimilarity, maxDistance, 0, context, out closest);
        }

        closest = ClosestPointFactory.Create(_fractal.BaseMesh, search.ClosestFace, map * ResolveInstance(search.ClosestPath, context),
            position);
        return closest.Distance <= maxDistance;
    }

    /// <summary>Goes the way to the nearest face once more: the map of its instance, and its number at each level.</summary>
    private AffineMap ResolveInstance(ReadOnlySpan<int> path, QueryContext context)
    {
        var (map, remainingLevels) = (AffineMap.Identity, _table.Levels);
        foreach (var childIndex in path)
        {
            var child = _table.At(remainingLevels).Children[childIndex];
            map *= child.Map;
            foreach (var edge in child.Edges)
            {
                var childLevels = edge.RemainingLevels(remainingLevels);
                var isIdentity = edge.Set == MapSet.Identity;
                if (isIdentity && childLevels == 0 && remainingLevels > FractalSearchState.MaxDepth)
                {
                    // A path that ends early goes on with identities.
                    return map;
                }

                // Levels that are passed over take their identity.
                for (var level = remainingLevels; level > (isIdentity ? childLevels : childLevels + 1); level--)
                {
                    context.AppendToPath(_table.MapSetAt(level)!.IdentityIndex);
                }

                if (!isIdentity)
                {
                    context.AppendToPath(edge.MapIndex);
                }

                remainingLevels = childLevels;
            }
        }

        return map;
    }
}
