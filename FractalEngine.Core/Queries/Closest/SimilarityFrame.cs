using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>
/// The frame of a sub-fractal where all maps are similarities: the position is taken into the sub-fractal's frame, and distances there are
/// multiplied by the scale.
/// </summary>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
internal readonly struct SimilarityFrame(
    Vector256<double> position, double scaleSquared, double inverseScaleSquared, double inverseScale)
    : ISearchFrame<SimilarityFrame>
{
    private readonly Vector256<double> _position = position;
    private readonly double _scaleSquared = scaleSquared;
    private readonly double _inverseScaleSquared = inverseScaleSquared;
    private readonly double _inverseScale = inverseScale;

    /// <summary>Creates the frame of the whole fractal.</summary>
    /// <param name="position">Position of the query in the fractal's frame.</param>
    public SimilarityFrame(Vector position)
        : this(SimdAffineMap.ToVector256(position), 1, 1, 1)
    {
    }

    /// <inheritdoc/>
    public double RadiusSquared(SubFractal subFractal) => subFractal.RadiusSquared * _scaleSquared;

    /// <inheritdoc/>
    public double ChildCutoffSquared(in FractalSearchState search) => search.BoundCutoffSquared * _inverseScaleSquared;

    /// <inheritdoc/>
    public double ChildCutoff(in FractalSearchState search) => search.BoundCutoff * _inverseScale;

    /// <inheritdoc/>
    public Vector256<double> LocalPosition => _position;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool IsNear(SubFractal subFractal) =>
        subFractal.ChildBoundsX8 is not null && subFractal.IsWithinRadii(_position, ChildBoundsX8.MaxDistanceFactor);

    /// <inheritdoc/>
    public void FillQueue(SubFractal subFractal, in ChildQueue queue, ref FractalSearchState search)
    {
        var direction = _position - subFractal.Centre;
        var directionLengthSquared = Vector256.Dot(direction, direction);
        search.BoundTests += subFractal.Children.Length;
        if (subFractal.UnrotatedBounds is { } unrotatedBounds && directionLengthSquared > subFractal.RadiusSquared)
        {
            unrotatedBounds.FillQueue(direction, directionLengthSquared, _position, subFractal.ChildBounds, in queue);
        }
        else
        {
            SetBoxBounds(subFractal, in queue);
        }
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public SimilarityFrame Enter(ChildInstance child) => new(
        child.InverseSimdMap.Apply(_position), _scaleSquared * child.ScaleSquared, _inverseScaleSquared * child.InverseScaleSquared,
        _inverseScale * child.InverseScale);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool CanRefine(
        SubFractal parent, SubFractal childSubFractal, bool isSmallBase, bool isUrgent, in FractalSearchState search) =>
        !isUrgent && !isSmallBase
        && (parent.HasRotatedChildren || childSubFractal.Hull is not null || childSubFractal.Clusters is not null
            || search.NeedsTightBounds);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double RefinedBoundSquared(
        SubFractal parent, ChildInstance child, SubFractal childSubFractal, ref SimilarityFrame childFrame, double cutoffSquared,
        ref FractalSearchState search)
    {
        var bound = 0.0;
        var localCutoffSquared = cutoffSquared * child.InverseScaleSquared;
        if (parent.HasRotatedChildren)
        {
            // Without rotation, the box around the image is the image of the box.
            bound = childSubFractal.BoxDistanceSquared(childFrame._position);
            search.BoundTests++;
        }

        if (bound < localCutoffSquared && childSubFractal.Hull is { } hull)
        {
            bound = Math.Max(bound, hull.LowerBoundSquared(childFrame._position, localCutoffSquared));
            search.BoundTests++;
        }

        if (bound < localCutoffSquared && (search.NeedsTightBounds || childSubFractal.Clusters is not null))
        {
            bound = Math.Max(bound, TightBoundSquared(childSubFractal, in childFrame, localCutoffSquared, ref search));
        }

        return bound * child.ScaleSquared;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void TestTriangles(TriangleBvh bvh, ExpandedSubFractal? expanded, int depth, ref FractalSearchState search)
    {
        var closest = new ClosestTriangle(search.ClosestDistanceSquared * _inverseScaleSquared);
        ClosestTriangleSearch.Find(bvh, SimdAffineMap.ToVector(_position), ref closest, search.BoundFactor);
        search.AddStatistics(in closest);
        if (closest.FaceIndex >= 0)
        {
            search.UpdateClosest(closest.DistanceSquared * _scaleSquared, closest.FaceIndex, depth, expanded);
        }
    }

    /// <summary>Computes the bounds of the clusters, and of the solid in long searches. The distance of a box is exact already.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    private static double TightBoundSquared(
        SubFractal subFractal, in SimilarityFrame frame, double cutoffSquared, ref FractalSearchState search)
    {
        var bound = 0.0;
        if (subFractal.Clusters is { } clusters)
        {
            bound = clusters.LowerBoundSquared(frame._position);
            search.BoundTests++;
        }

        if (search.NeedsTightBounds && bound < cutoffSquared && subFractal.Solid is { IsBox: false } solid)
        {
            bound = Math.Max(bound, solid.LowerBoundSquared(frame._position, in SimdAffineMap.Identity, cutoffSquared));
            search.BoundTests++;
        }

        return bound;
    }

    private void SetBoxBounds(SubFractal subFractal, in ChildQueue queue)
    {
        var paddedCount = subFractal.PaddedCount;
        ref var rows = ref MemoryMarshal.GetArrayDataReference(subFractal.ChildBounds);
        var position = VectorX4.Broadcast(_position);
        for (var i = 0; i < paddedCount; i += VectorX4.Count)
        {
            var bounds = BoxDistance.SquaredX4(ref rows, paddedCount, i, position, out var centreDistances);
            queue.SetBounds(bounds, centreDistances, i);
        }
    }
}
