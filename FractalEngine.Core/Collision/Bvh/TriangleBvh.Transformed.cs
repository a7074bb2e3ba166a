using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Bvh;

/// <content>The search on the image of the mesh under any map.</content>
internal sealed partial class TriangleBvh
{
    /// <summary>Finds the closest triangle of the mesh's image under a map, in double precision.</summary>
    /// <param name="position">In the frame of the image, finite.</param>
    /// <param name="map">From the mesh's frame to that of the image.</param>
    /// <param name="closest">The limit; receives the closest triangle and the cost.</param>
    /// <param name="boundFactor">As in <see cref="FindClosest"/>.</param>
    public void FindClosestTransformed(in Vector position, in AffineMap map, ref ClosestTriangle closest, double boundFactor)
    {
        if (_mesh.FaceCount <= MaxBruteForceTriangles || !_isInSafeRange)
        {
            TestAllTransformedTriangles(in position, in map, ref closest);
            return;
        }

        TraverseTransformed(BvhChild.Root, in position, in map, ref closest, boundFactor);
    }

    /// <summary>Tests the image of every triangle, whatever the bounds are.</summary>
    /// <param name="position">In the frame of the image, finite.</param>
    /// <param name="map">From the mesh's frame to that of the image.</param>
    /// <param name="closest">The limit; receives the closest triangle and the cost.</param>
    public void TestAllTransformedTriangles(in Vector position, in AffineMap map, ref ClosestTriangle closest)
    {
        if (_precomputed is not null)
        {
            for (var quad = 0; quad < _precomputed.QuadCount; quad++)
            {
                _precomputed.TestTransformed(quad, in position, in map, ref closest);
            }
        }
        else
        {
            TestTransformedFaces(_faces, in position, in map, ref closest);
        }

        closest.FaceTests += _mesh.FaceCount;
    }

    private void TraverseTransformed(
        BvhChild node, in Vector position, in AffineMap map, ref ClosestTriangle closest, double boundFactor)
    {
        Span<double> bounds = stackalloc double[BvhLayout.BranchingFactor];
        ComputeTransformedBounds(node, in position, in map, bounds);
        closest.BoundTests += BvhLayout.BranchingFactor;
        while (true)
        {
            var closestChild = -1;
            var smallestBound = double.PositiveInfinity;
            for (var child = 0; child < bounds.Length; child++)
            {
                // False for NaN, the bound of an absent child.
                if (bounds[child] < smallestBound)
                {
                    closestChild = child;
                    smallestBound = bounds[child];
                }
            }

            // Boxes are wider than their triangles by more than rounding.
            if (closestChild < 0 || !(smallestBound * boundFactor <= closest.DistanceSquared))
            {
                return;
            }

            bounds[closestChild] = double.PositiveInfinity;
            var next = Children(node)[closestChild];
            if (next.IsNode)
            {
                TraverseTransformed(next, in position, in map, ref closest, boundFactor);
                continue;
            }

            closest.FaceTests += next.TriangleCount;
            if (_precomputed is not null)
            {
                _precomputed.TestTransformed(_precomputed.QuadOf(next), in position, in map, ref closest);
            }
            else
            {
                TestTransformedFaces(_faces.AsSpan(next.FirstTriangle, next.TriangleCount), in position, in map, ref closest);
            }
        }
    }

    /// <summary>Computes the squared distances to the boxes around the images of a node's eight boxes.</summary>
    private void ComputeTransformedBounds(BvhChild node, in Vector position, in AffineMap map, Span<double> bounds)
    {
        var boxes = NodeBounds(node);
        var inverseScale = 1 / _scale;
        var fromOrigin = VectorX4.Broadcast(position - (map * _origin));
        var v1 = VectorX4.Broadcast(inverseScale * map.Linear.V1);
        var v2 = VectorX4.Broadcast(inverseScale * map.Linear.V2);
        var v3 = VectorX4.Broadcast(inverseScale * map.Linear.V3);
        var half = Vector256.Create(0.5);
        for (var i = 0; i < 2; i++)
        {
            VectorX4 minimum = new(
                FloatRounding.WidenHalf(boxes[0], i), FloatRounding.WidenHalf(boxes[1], i), FloatRounding.WidenHalf(boxes[2], i));
            VectorX4 maximum = new(
                FloatRounding.WidenHalf(boxes[3], i), FloatRounding.WidenHalf(boxes[4], i), FloatRounding.WidenHalf(boxes[5], i));
            var centre = half * (minimum + maximum);
            var fromCentre = fromOrigin - ((centre.X * v1) + (centre.Y * v2) + (centre.Z * v3));
            TransformedBoxDistance.DistanceSquared(fromCentre, half * (maximum - minimum), v1, v2, v3)
                .CopyTo(bounds[(VectorX4.Count * i)..]);
        }
    }

    private void TestTransformedFaces(
        ReadOnlySpan<int> faces, ref readonly Vector position, ref readonly AffineMap map, ref ClosestTriangle closest)
    {
        for (; faces.Length > 0; faces = faces[Math.Min(VectorX4.Count, faces.Length)..])
        {
            var quad = faces[..Math.Min(VectorX4.Count, faces.Length)];
            closest.Update(TriangleX4.DistancesSquared(_mesh, quad, in position, in map), quad);
        }
    }
}
