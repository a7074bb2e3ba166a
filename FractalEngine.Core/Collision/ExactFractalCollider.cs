using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Exact search on fractals of any depth, by branch and bound over their levels: each sub-fractal is bounded by a box that provably holds it,
/// the nearest is looked at first, and what can't be nearer than the best so far is left out. Memory and time follow the levels, not the
/// faces; why the bounds hold stands in docs/colliders.md.
/// </summary>
/// <remarks>
/// Sub-fractals smaller than <see cref="Precision"/> of the whole are answered by the base mesh in their place: that is the last place of a
/// coordinate. Infinite fractals end there too.
/// </remarks>
public sealed class ExactFractalCollider : Collider
{
    /// <summary>The part of a fractal's size below which no further level is looked at.</summary>
    public const double Precision = 1e-15;

    private readonly Fractal _fractal;
    private readonly SubFractalTable _table;
    private readonly FaceHierarchy _base;
    private readonly SimilarSearch _similar;
    private readonly AffineSearch _affine;
    private readonly BestFirstSearch _bestFirst;

    /// <summary>Prepares a fractal in affine composition for queries.</summary>
    /// <exception cref="FractalLimitException">The bounds of some level are beyond a double, or don't settle; the message names it.</exception>
    /// <exception cref="ArgumentException">The fractal is composed componentwise.</exception>
    /// <exception cref="SingularMatrixException">A map flattens what it maps, as a scale of 0 does; fractal files with one are refused.</exception>
    /// <remarks>Cost: microseconds to milliseconds, whatever the depth.</remarks>
    public ExactFractalCollider(Fractal fractal)
    {
        if (fractal.Description.Composition != Composition.Affine)
        {
            throw new ArgumentException("expected affine composition: componentwise sums have no levels to search", nameof(fractal));
        }

        (_fractal, _table, _base) = (fractal, SubFractalTable.Of(fractal), new(fractal.BaseMesh));
        (_similar, _affine, _bestFirst) = (new(_table, _base), new(_table, _base), new(_table, _base));
    }

    /// <inheritdoc/>
    public override bool IsExact => true;

    /// <inheritdoc/>
    public override long StorageBytes => _table.StorageBytes + _base.StorageBytes;

    /// <inheritdoc/>
    internal override bool FindsImages => true;

    /// <inheritdoc/>
    internal override bool FindImage(Vector position, AffineMap map, double within, double epsilon, QueryRecord record, out ClosestPoint closest) =>
        Find(position, map, isSimilar: false, within, epsilon, record, out closest);

    /// <inheritdoc/>
    private protected override bool Find(Vector position, double within, double epsilon, QueryRecord record, out ClosestPoint closest) =>
        Find(position, AffineMap.Identity, _table.AreSimilar, within, epsilon, record, out closest);

    private bool Find(
        Vector position, in AffineMap map, bool isSimilar, double within, double epsilon, QueryRecord record, out ClosestPoint closest)
    {
        record.ClearPath();
        closest = default;
        if (_fractal.BaseMesh.FaceCount == 0 || _table.Root.Box.IsEmpty)
        {
            return false;
        }

        var box = isSimilar ? _table.Root.Box : _table.Root.Box.Transform(map);
        var magnitude = Math.Max(position.MaximumComponent(), Math.Max(box.Minimum.MaximumComponent(), box.Maximum.MaximumComponent()));
        var search = new FractalSearch(within, epsilon, magnitude, record);
        search.BoundTests++;
        if (!search.Excludes(box.DistanceSquared(position)))
        {
            if (isSimilar)
            {
                _similar.Run(position, ref search);
            }
            else
            {
                _affine.Run(position, map, ref search);
            }

            if (search.HasGivenUp)
            {
                search.Resume();
                _bestFirst.Run(position, in map, ref search);
            }
        }

        record.FaceTests += search.FaceTests;
        record.BoundTests += search.BoundTests;
        if (search.Face < 0)
        {
            return NeedsExactness(within, epsilon) && Find(position, in map, isSimilar, within, 0, record, out closest);
        }

        closest = FaceAnswer.Of(_fractal.BaseMesh, search.Face, map * Follow(search.FaceTrail, record), position);
        return closest.Distance <= within;
    }

    /// <summary>Goes the way to the nearest face once more: the map of its instance, and its number at each level.</summary>
    private AffineMap Follow(ReadOnlySpan<int> trail, QueryRecord record)
    {
        var (map, levels) = (AffineMap.Identity, _table.Levels);
        foreach (var index in trail)
        {
            var copy = _table.At(levels).Copies[index];
            map *= copy.Map;
            foreach (var step in copy.Steps)
            {
                var below = step.LevelsLeft(levels);
                var isIdentity = step.Set == CopySet.Identity;
                if (isIdentity && below == 0 && levels > FractalSearch.Deepest)
                {
                    // A path that ends early goes on with identities.
                    return map;
                }

                // Levels that are passed over take their identity.
                for (var level = levels; level > (isIdentity ? below : below + 1); level--)
                {
                    record.AppendToPath(_table.SetAt(level)!.IdentityIndex);
                }

                if (!isIdentity)
                {
                    record.AppendToPath(step.Index);
                }

                levels = below;
            }
        }

        return map;
    }
}
