using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>
/// The frame of a sub-fractal under any maps: bounds are taken into the frame of the query, since distances there are not proportional to
/// those in the sub-fractal's frame.
/// </summary>
/// <param name="position">Position of the query in the query's frame: x, y, z, 0.</param>
/// <param name="map">From the sub-fractal's frame to that of the query.</param>
/// <param name="inverse">The inverse of that map.</param>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
internal readonly struct AffineFrame(Vector256<double> position, in SimdAffineMap map, in SimdAffineMap inverse)
    : ISearchFrame<AffineFrame>
{
    private readonly Vector256<double> _position = position;
    private readonly SimdAffineMap _map = map;
    private readonly SimdAffineMap _inverse = inverse;

    /// <summary>Creates the frame of the whole fractal.</summary>
    /// <param name="position">Position of the query in the query's frame.</param>
    /// <param name="map">From the fractal's frame to that of the query.</param>
    public AffineFrame(Vector position, in AffineMap map)
        : this(SimdAffineMap.ToVector256(position), new(map), new(map.Inverse()))
    {
    }

    /// <summary>Finds the closest triangle of the base mesh under a map, if it is closer than all before.</summary>
    /// <param name="bvh">The hierarchy of the base mesh.</param>
    /// <param name="position">In the frame of the query: x, y, z, 0.</param>
    /// <param name="map">From the frame of the base mesh to that of the query.</param>
    /// <param name="search">Receives the cost.</param>
    /// <param name="closest">The triangle and its squared distance in the frame of the query.</param>
    public static bool TryFindTriangle(
        TriangleBvh bvh, Vector256<double> position, in SimdAffineMap map, ref FractalSearchState search, out ClosestTriangle closest)
    {
        closest = new(search.ClosestDistanceSquared);
        TransformedTriangleSearch.Find(bvh, SimdAffineMap.ToVector(position), map.ToAffineMap(), ref closest, search.BoundFactor);
        search.AddStatistics(in closest);
        return closest.FaceIndex >= 0;
    }

    /// <inheritdoc/>
    public double RadiusSquared(SubFractal subFractal) => subFractal.RadiusSquared * _map.FrobeniusNormSquared();

    /// <inheritdoc/>
    public double ChildCutoffSquared(in FractalSearchState search) => search.BoundCutoffSquared;

    /// <inheritdoc/>
    public double ChildCutoff(in FractalSearchState search) => search.BoundCutoff;

    /// <inheritdoc/>
    public Vector256<double> LocalPosition => _inverse.Apply(_position);

    /// <inheritdoc/>
    public bool IsNear(SubFractal subFractal) => false;

    /// <inheritdoc/>
    public void FillQueue(SubFractal subFractal, in ChildQueue queue, ref FractalSearchState search)
    {
        TransformedBoxDistance.FillQueue(in queue, subFractal.ChildBounds, subFractal.PaddedCount, _position, in _map);
        search.BoundTests += subFractal.Children.Length;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public AffineFrame Enter(ChildInstance child) => new(
        _position, SimdAffineMap.Compose(in _map, in child.Map), SimdAffineMap.Compose(in child.InverseSimdMap, in _inverse));

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool CanRefine(
        SubFractal parent, SubFractal childSubFractal, bool isSmallBase, bool isUrgent, in FractalSearchState search) => !isUrgent;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double RefinedBoundSquared(
        SubFractal parent, ChildInstance child, SubFractal childSubFractal, ref AffineFrame childFrame, double cutoffSquared,
        ref FractalSearchState search)
    {
        var bound = childSubFractal.TransformedLowerBoundSquared(
            _position, in childFrame._map, in childFrame._inverse, cutoffSquared, out var isHullTested);
        search.BoundTests += isHullTested ? 2 : 1;
        if (bound < cutoffSquared && childSubFractal.Clusters is { } clusters)
        {
            bound = Math.Max(bound, clusters.LowerBoundSquared(_position, in childFrame._map));
            search.BoundTests++;
        }

        if (search.NeedsTightBounds && bound < cutoffSquared && childSubFractal.Solid is { } solid)
        {
            bound = Math.Max(bound, solid.LowerBoundSquared(_position, in childFrame._map, cutoffSquared));
            search.BoundTests++;
        }

        return bound;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void TestTriangles(TriangleBvh bvh, ExpandedSubFractal? expanded, int depth, ref FractalSearchState search)
    {
        if (TryFindTriangle(bvh, _position, in _map, ref search, out var closest))
        {
            search.UpdateClosest(closest.DistanceSquared, closest.FaceIndex, depth, expanded);
        }
    }
}
