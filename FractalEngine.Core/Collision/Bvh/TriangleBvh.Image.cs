using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Bvh;

/// <content>The search on the image of the faces under a map.</content>
internal sealed partial class TriangleBvh
{
    /// <summary>The same on the image of the faces under any map, one level after another in double precision.</summary>
    /// <param name="position">In the frame of the image.</param>
    /// <param name="map">To that frame.</param>
    /// <param name="closestDistanceSquared">As in <see cref="FindClosest"/>.</param>
    /// <param name="closestFace">As in <see cref="FindClosest"/>.</param>
    /// <param name="boundFactor">As in <see cref="FindClosest"/>.</param>
    /// <param name="faceTests">Increased by the faces looked at.</param>
    /// <param name="boundTests">Increased by the bounds looked at.</param>
    public void FindClosestTransformed(
        Vector position, in AffineMap map, ref double closestDistanceSquared, ref int closestFace, double boundFactor, ref long faceTests,
        ref long boundTests)
    {
        if (_mesh.FaceCount <= MaxBruteForceFaces)
        {
            TestAllTransformedTriangles(position, in map, ref closestDistanceSquared, ref closestFace, ref faceTests);
            return;
        }

        var state = new TraversalState(position, Vector.Zero, closestDistanceSquared, closestFace);
        FindClosestTransformed(ref state, 0, in map, boundFactor);
        (closestDistanceSquared, closestFace) = (state.ClosestDistanceSquared, state.ClosestFace);
        faceTests += state.FaceTests;
        boundTests += state.BoundTests;
    }

    private void FindClosestTransformed(ref TraversalState state, int node, in AffineMap map, double boundFactor)
    {
        var boxes = _nodeBounds.AsSpan(node * BvhLayout.VectorsPerNode, BvhLayout.VectorsPerNode);
        var inverseScale = 1 / _scale;
        var fromOrigin = VectorX4.Broadcast(state.Position - (map * _origin));
        var (v1, v2, v3) = (VectorX4.Broadcast(inverseScale * map.Linear.V1), VectorX4.Broadcast(inverseScale * map.Linear.V2),
            VectorX4.Broadcast(inverseScale * map.Linear.V3));
        Span<double> bounds = stackalloc double[TriangleBvhBuilder.BranchingFactor];
        var half = Vector256.Create(0.5);
        for (var halfIndex = 0; halfIndex < 2; halfIndex++)
        {
            VectorX4 minimum = new(WidenHalf(boxes[0], halfIndex), WidenHalf(boxes[1], halfIndex), WidenHalf(boxes[2], halfIndex));
            VectorX4 maximum = new(WidenHalf(boxes[3], halfIndex), WidenHalf(boxes[4], halfIndex), WidenHalf(boxes[5], halfIndex));
            var centre = half * (minimum + maximum);
            var fromCentre = fromOrigin - ((centre.X * v1) + (centre.Y * v2) + (centre.Z * v3));
            TransformedBoxDistance.DistanceSquared(fromCentre, half * (maximum - minimum), v1, v2, v3).CopyTo(bounds[(4 * halfIndex)..]);
        }

        state.BoundTests += TriangleBvhBuilder.BranchingFactor;
        while (true)
        {
            var (closestChild, smallestBound) = (-1, double.PositiveInfinity);
            for (var child = 0; child < bounds.Length; child++)
            {
                // False for NaN, which children have that are not there.
                (closestChild, smallestBound) = bounds[child] < smallestBound ? (child, bounds[child]) : (closestChild, smallestBound);
            }

            // Boxes are wider than their faces by more than rounding.
            if (closestChild < 0 || !(smallestBound * boundFactor < state.ClosestDistanceSquared))
            {
                return;
            }

            bounds[closestChild] = double.PositiveInfinity;
            var next = _children[(node * TriangleBvhBuilder.BranchingFactor) + closestChild];
            if (next >= 0)
            {
                FindClosestTransformed(ref state, next, in map, boundFactor);
                continue;
            }

            var encodedLeaf = (uint)~next;
            var leaf = (int)(encodedLeaf / TriangleBvhBuilder.MaxLeafTriangles);
            state.FaceTests += (encodedLeaf % TriangleBvhBuilder.MaxLeafTriangles) + 1;
            TryUpdateClosest(TransformedDistancesSquared(leaf, in state.Position, in map), leaf, ref state.ClosestDistanceSquared,
                ref state.ClosestFace);
        }
    }

    private static Vector256<double> WidenHalf(Vector256<float> lanes, int halfIndex) =>
        halfIndex == 0 ? Vector256.WidenLower(lanes) : Vector256.WidenUpper(lanes);

    /// <summary>Looks at the image of every face.</summary>
    /// <param name="position">In the frame of the images.</param>
    /// <param name="map">To that frame.</param>
    /// <param name="closestDistanceSquared">As in <see cref="FindClosest"/>.</param>
    /// <param name="closestFace">As in <see cref="FindClosest"/>.</param>
    /// <param name="faceTests">Increased by the faces of the mesh.</param>
    public void TestAllTransformedTriangles(Vector position, in AffineMap map, ref double closestDistanceSquared, ref int closestFace,
        ref long faceTests)
    {
        for (var leaf = 0; leaf < _leaves.Length; leaf++)
        {
            TryUpdateClosest(TransformedDistancesSquared(leaf, in position, in map), leaf, ref closestDistanceSquared, ref closestFace);
        }

        faceTests += _mesh.FaceCount;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Vector256<double> TransformedDistancesSquared(int leaf, ref readonly Vector position, ref readonly AffineMap map) =>
        TriangleX4.DistancesSquared(in _leaves[leaf], _mesh.Positions.AsSpan(), in position, in map);
}
