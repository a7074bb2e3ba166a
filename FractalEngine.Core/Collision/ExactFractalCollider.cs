using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
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

    // Each level takes one frame of the stack; fractals whose levels hardly shrink reach the precision after more than fit.
    private const int DeepestSearch = 2000;

    private readonly Fractal _fractal;
    private readonly SubFractalTable _table;
    private readonly FaceHierarchy _base;
    private readonly ConvexHullBound? _hull;
    private readonly double _precisionSquared;

    /// <summary>Prepares a fractal in affine composition for queries.</summary>
    /// <exception cref="FractalLimitException">The bounds of some level are beyond a double, or don't settle; the message names it.</exception>
    /// <exception cref="ArgumentException">The fractal is composed componentwise.</exception>
    /// <remarks>Cost: microseconds to milliseconds, whatever the depth.</remarks>
    public ExactFractalCollider(Fractal fractal)
    {
        if (fractal.Description.Composition != Composition.Affine)
        {
            throw new ArgumentException("expected affine composition: componentwise sums have no levels to search", nameof(fractal));
        }

        (_fractal, _table, _base) = (fractal, SubFractalTable.Of(fractal), new(fractal.BaseMesh));
        _hull = _table.AreSimilar ? ConvexHullBound.Of(fractal.BaseMesh, [.. _table.Maps]) : null;
        _precisionSquared = Precision * Precision * _table.At(_table.Levels).RadiusSquared;
    }

    /// <inheritdoc/>
    public override bool IsExact => true;

    /// <inheritdoc/>
    public override long StorageBytes => _table.StorageBytes + _base.StorageBytes;

    /// <inheritdoc/>
    private protected override bool Find(Vector position, double within, double epsilon, QueryRecord record, out ClosestPoint closest)
    {
        record.ClearPath();
        var root = _table.At(_table.Levels);
        var search = new Search
        {
            // One ulp more, so that a face at exactly the distance is found.
            BestSquared = within < double.PositiveInfinity ? Math.BitIncrement(within * within) : double.PositiveInfinity,
            BoundFactor = (1 + epsilon) * (1 + epsilon),
            Trail = record.Trail(DeepestSearch + 1),
            BestTrail = record.BestTrail(DeepestSearch + 1),
            Face = -1,
        };
        search.BoundTests++;
        if (_fractal.BaseMesh.FaceCount > 0 && !root.Box.IsEmpty && DistanceSquared(root.Box.Minimum, root.Box.Maximum, position) * search.BoundFactor < search.BestSquared)
        {
            if (_table.AreSimilar)
            {
                VisitSimilar(root, _table.Levels, position, 1, 0, ref search);
            }
            else
            {
                VisitGeneral(root, _table.Levels, position, AffineMap.Identity, 0, ref search);
            }
        }

        record.FaceTests += search.FaceTests;
        record.BoundTests += search.BoundTests;
        if (search.Face < 0)
        {
            closest = default;
            return false;
        }

        closest = FaceAnswer.Of(_fractal.BaseMesh, search.Face, Follow(search, record), position);
        return closest.Distance <= within;
    }

    /// <summary>Search where distances scale with the maps: the position is taken into the frame of each sub-fractal.</summary>
    /// <param name="state">The sub-fractal.</param>
    /// <param name="levels">The levels it has left.</param>
    /// <param name="position">In its frame.</param>
    /// <param name="scaleSquared">Square of the factor from its frame to that of the whole.</param>
    /// <param name="depth">How many copies lead to it.</param>
    /// <param name="search">What is found so far.</param>
    private void VisitSimilar(SubFractal state, long levels, Vector position, double scaleSquared, int depth, ref Search search)
    {
        if (levels == 0 || state.EmitsBase || IsTooSmall(state, scaleSquared, depth))
        {
            var best = search.BestSquared / scaleSquared;
            var face = -1;
            _base.Search(position, ref best, ref face, search.BoundFactor, ref search.FaceTests, ref search.BoundTests);
            if (face >= 0)
            {
                search.Improve(best * scaleSquared, face, depth);
            }

            if (levels == 0 || IsTooSmall(state, scaleSquared, depth))
            {
                return;
            }
        }

        Span<double> bounds = stackalloc double[state.Padded];
        MeasureBoxes(state, position, bounds);
        search.BoundTests += state.Copies.Length;
        for (var left = state.Copies.Length; left > 0; left--)
        {
            var nearest = IndexOfSmallest(bounds[..state.Copies.Length]);
            if (!(bounds[nearest] * scaleSquared * search.BoundFactor < search.BestSquared))
            {
                return;
            }

            bounds[nearest] = double.PositiveInfinity;
            ref readonly var copy = ref state.Copies[nearest];
            var below = copy.LevelsLeft(levels);
            var inner = _table.At(below);
            var local = copy.Set.Inverses[copy.Index] * position;
            var innerScale = scaleSquared * copy.Set.ScaleSquared[copy.Index];
            // The sub-fractal's own box is tighter than the one around its image, where the map turns.
            search.BoundTests++;
            if (DistanceSquared(inner.Box.Minimum, inner.Box.Maximum, local) * innerScale * search.BoundFactor < search.BestSquared
                && (below == 0 || !IsBeyondHull(local, search.BestSquared / (innerScale * search.BoundFactor), ref search)))
            {
                search.Trail[depth] = nearest;
                VisitSimilar(inner, below, local, innerScale, depth + 1, ref search);
            }
        }
    }

    /// <summary>True when all of a sub-fractal is farther than the best so far, because the solid that holds it is.</summary>
    private bool IsBeyondHull(Vector position, double bestSquared, ref Search search)
    {
        if (_hull is null || _hull.Contains(position))
        {
            return false;
        }

        var (face, reach) = (-1, Math.Sqrt(bestSquared) + _hull.Margin);
        bestSquared = reach * reach;
        // Outside a convex solid the nearest point is on its faces.
        _base.Search(position, ref bestSquared, ref face, 1, ref search.BoundTests, ref search.BoundTests);
        return face < 0;
    }

    /// <summary>Search for any maps: the boxes are taken into the frame of the whole.</summary>
    /// <param name="state">The sub-fractal.</param>
    /// <param name="levels">The levels it has left.</param>
    /// <param name="position">In the frame of the whole.</param>
    /// <param name="map">From the sub-fractal's frame to that of the whole.</param>
    /// <param name="depth">How many copies lead to it.</param>
    /// <param name="search">What is found so far.</param>
    private void VisitGeneral(SubFractal state, long levels, Vector position, AffineMap map, int depth, ref Search search)
    {
        var lengthening = Geometry.BoundingSphere.LengtheningBound(map.Linear);
        if (levels == 0 || state.EmitsBase || IsTooSmall(state, lengthening * lengthening, depth))
        {
            TestBase(position, map, depth, ref search);
            if (levels == 0 || IsTooSmall(state, lengthening * lengthening, depth))
            {
                return;
            }
        }

        Span<double> bounds = stackalloc double[state.Copies.Length];
        for (var i = 0; i < bounds.Length; i++)
        {
            var copy = state.Copies[i];
            var inner = _table.At(copy.LevelsLeft(levels)).Box;
            // The smaller of two boxes that both hold the copy: around the image of its box here, and around that of its own.
            var bound = ImageDistanceSquared(map, state.BoxOf(i), position);
            bounds[i] = Math.Max(bound, ImageDistanceSquared(map * copy.Map, inner, position));
        }

        search.BoundTests += 2 * bounds.Length;
        for (var left = bounds.Length; left > 0; left--)
        {
            var nearest = IndexOfSmallest(bounds);
            if (!(bounds[nearest] * search.BoundFactor < search.BestSquared))
            {
                return;
            }

            bounds[nearest] = double.PositiveInfinity;
            var copy = state.Copies[nearest];
            var below = copy.LevelsLeft(levels);
            search.Trail[depth] = nearest;
            VisitGeneral(_table.At(below), below, position, map * copy.Map, depth + 1, ref search);
        }
    }

    private void TestBase(Vector position, AffineMap map, int depth, ref Search search)
    {
        var mesh = _fractal.BaseMesh;
        search.FaceTests += mesh.FaceCount;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var squared = FaceKernel.ClosestPoint(position, map * a, map * b, map * c).DistanceSquared;
            if (squared < search.BestSquared)
            {
                search.Improve(squared, face, depth);
            }
        }
    }

    private bool IsTooSmall(SubFractal state, double scaleSquared, int depth) =>
        state.RadiusSquared * scaleSquared <= _precisionSquared || depth >= DeepestSearch;

    /// <summary>The squared distance from a position to a box around the image of a box under a map.</summary>
    private static double ImageDistanceSquared(AffineMap map, Geometry.BoundingBox box, Vector position) =>
        box.Transform(map) switch { var image => DistanceSquared(image.Minimum, image.Maximum, position) };

    private static double DistanceSquared(Vector minimum, Vector maximum, Vector position)
    {
        var x = Math.Max(Math.Max(minimum.X - position.X, position.X - maximum.X), 0);
        var y = Math.Max(Math.Max(minimum.Y - position.Y, position.Y - maximum.Y), 0);
        var z = Math.Max(Math.Max(minimum.Z - position.Z, position.Z - maximum.Z), 0);
        return (x * x) + (y * y) + (z * z);
    }

    /// <summary>The squared distances to the boxes of all copies, four at a time.</summary>
    private static void MeasureBoxes(SubFractal state, Vector position, Span<double> distances)
    {
        var padded = state.Padded;
        ref var bounds = ref MemoryMarshal.GetArrayDataReference(state.Bounds);
        ref var result = ref MemoryMarshal.GetReference(distances);
        var (x, y, z) = (Vector256.Create(position.X), Vector256.Create(position.Y), Vector256.Create(position.Z));
        for (var i = 0; i < padded; i += SubFractal.Lanes)
        {
            var dx = Outside(ref bounds, i, 0, padded, x);
            var dy = Outside(ref bounds, i, 1, padded, y);
            var dz = Outside(ref bounds, i, 2, padded, z);
            ((dx * dx) + (dy * dy) + (dz * dz)).StoreUnsafe(ref result, (nuint)i);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> Outside(ref double bounds, int box, int axis, int padded, Vector256<double> coordinate)
    {
        var minimum = Vector256.LoadUnsafe(ref bounds, (nuint)((axis * padded) + box));
        var maximum = Vector256.LoadUnsafe(ref bounds, (nuint)(((3 + axis) * padded) + box));
        return Vector256.Max(Vector256.Max(minimum - coordinate, coordinate - maximum), Vector256<double>.Zero);
    }

    private static int IndexOfSmallest(ReadOnlySpan<double> values)
    {
        var (smallest, index) = (values[0], 0);
        for (var i = 1; i < values.Length; i++)
        {
            if (values[i] < smallest)
            {
                (smallest, index) = (values[i], i);
            }
        }

        return index;
    }

    /// <summary>Goes the way to the nearest face once more: the map of its instance, and its number at each level.</summary>
    private AffineMap Follow(in Search search, QueryRecord record)
    {
        var (map, levels) = (AffineMap.Identity, _table.Levels);
        for (var depth = 0; depth < search.BestDepth; depth++)
        {
            var copy = _table.At(levels).Copies[search.BestTrail[depth]];
            var below = copy.LevelsLeft(levels);
            map *= copy.Map;
            // Levels that are passed over take their identity.
            var last = copy.Set == CopySet.Identity ? below : below + 1;
            for (var level = levels; level > last; level--)
            {
                record.AppendToPath(_table.At(level).Set!.IdentityIndex);
            }

            if (copy.Set != CopySet.Identity)
            {
                record.AppendToPath(copy.Index);
            }

            levels = below;
        }

        for (; levels > 0 && _table.At(levels).EmitsBase && levels <= DeepestSearch; levels--)
        {
            record.AppendToPath(_table.At(levels).Set!.IdentityIndex);
        }

        return map;
    }

    /// <summary>What a query has found so far, and its counters.</summary>
    private ref struct Search
    {
        public double BestSquared;
        public double BoundFactor;
        public long FaceTests;
        public long BoundTests;
        public int Face;
        public int BestDepth;
        public Span<int> Trail;
        public Span<int> BestTrail;

        public void Improve(double squared, int face, int depth)
        {
            (BestSquared, Face, BestDepth) = (squared, face, depth);
            Trail[..depth].CopyTo(BestTrail);
        }
    }
}
