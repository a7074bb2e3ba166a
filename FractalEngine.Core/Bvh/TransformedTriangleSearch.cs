using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Bvh;

/// <summary>Finds the triangle of a mesh's image under any map that is closest to a position, in double precision.</summary>
internal static class TransformedTriangleSearch
{
    /// <summary>Finds the closest triangle of the mesh's image under a map, in double precision.</summary>
    /// <param name="bvh">The triangles.</param>
    /// <param name="position">In the frame of the image, finite.</param>
    /// <param name="map">From the mesh's frame to that of the image.</param>
    /// <param name="closest">The limit; receives the closest triangle and the cost.</param>
    /// <param name="boundFactor">As in <see cref="ClosestTriangleSearch.Find"/>.</param>
    public static void Find(
        TriangleBvh bvh, in Vector position, in AffineMap map, ref ClosestTriangle closest, double boundFactor)
    {
        if (!bvh.HasNodes)
        {
            TestAll(bvh, in position, in map, ref closest);
            return;
        }

        Traverse(bvh, BvhChild.Root, in position, in map, ref closest, boundFactor);
    }

    /// <summary>Tests the image of every triangle, whatever the bounds are.</summary>
    /// <param name="bvh">The triangles.</param>
    /// <param name="position">In the frame of the image, finite.</param>
    /// <param name="map">From the mesh's frame to that of the image.</param>
    /// <param name="closest">The limit; receives the closest triangle and the cost.</param>
    public static void TestAll(TriangleBvh bvh, in Vector position, in AffineMap map, ref ClosestTriangle closest)
    {
        if (bvh.Precomputed is not null)
        {
            for (var quad = 0; quad < bvh.Precomputed.QuadCount; quad++)
            {
                bvh.Precomputed.TestTransformed(quad, in position, in map, ref closest);
            }
        }
        else
        {
            TestFaces(bvh.Mesh, bvh.AllFaces, in position, in map, ref closest);
        }

        closest.FaceTests += bvh.AllFaces.Length;
    }

    private static void Traverse(
        TriangleBvh bvh, BvhChild node, in Vector position, in AffineMap map, ref ClosestTriangle closest, double boundFactor)
    {
        Span<double> bounds = stackalloc double[BvhLayout.BranchingFactor];
        ComputeBounds(bvh, node, in position, in map, bounds);
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
            var next = bvh.Children(node)[closestChild];
            if (next.IsNode)
            {
                Traverse(bvh, next, in position, in map, ref closest, boundFactor);
                continue;
            }

            closest.FaceTests += next.TriangleCount;
            if (bvh.Precomputed is not null)
            {
                bvh.Precomputed.TestTransformed(bvh.Precomputed.QuadOf(next), in position, in map, ref closest);
            }
            else
            {
                TestFaces(bvh.Mesh, bvh.Faces(next), in position, in map, ref closest);
            }
        }
    }

    /// <summary>Computes the squared distances to the boxes around the images of a node's eight boxes.</summary>
    private static void ComputeBounds(TriangleBvh bvh, BvhChild node, in Vector position, in AffineMap map, Span<double> bounds)
    {
        var boxes = bvh.NodeBounds(node);
        var inverseScale = 1 / bvh.Scale;
        var fromOrigin = VectorX4.Broadcast(position - (map * bvh.Origin));
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

    private static void TestFaces(
        Mesh mesh, ReadOnlySpan<int> faces, ref readonly Vector position, ref readonly AffineMap map, ref ClosestTriangle closest)
    {
        for (; faces.Length > 0; faces = faces[Math.Min(VectorX4.Count, faces.Length)..])
        {
            var quad = faces[..Math.Min(VectorX4.Count, faces.Length)];
            closest.Update(TriangleX4.DistancesSquared(mesh, quad, in position, in map), quad);
        }
    }
}
