using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Bvh;

/// <summary>Finds the nearest triangle of a mesh along rays.</summary>
/// <param name="bvh">The triangles.</param>
internal sealed class TriangleBvhRays(TriangleBvh bvh)
{
    // All triangles of a small mesh, gathered when the first ray comes.
    private Vector256<double>[]? _quads;
    private RayBox? _box;

    /// <summary>Finds the nearest triangle along a ray, or any.</summary>
    /// <param name="ray">In the mesh's frame.</param>
    /// <param name="search">Receives the hit and the cost.</param>
    /// <returns>True when there is a nearer hit than before.</returns>
    public bool TryIntersect(in LocalRay ray, ref RaySearch search) => bvh.HasNodes
        ? TryIntersectNodes(in ray, ref search)
        : !bvh.AllFaces.IsEmpty && TryIntersectAllTriangles(in ray, ref search);

    [SkipLocalsInit]
    private bool TryIntersectAllTriangles(in LocalRay ray, ref RaySearch search)
    {
        var triangleRay = new TriangleRay(in ray, search.Error);
        var faces = bvh.AllFaces;
        var quads = _quads ??= RayTriangles.GatherAll(bvh.Mesh, faces);
        search.FaceTests += faces.Length;
        var isHit = false;
        for (var first = 0; first < faces.Length; first += RayTriangles.Count)
        {
            if (triangleRay.TryIntersect(ref quads[first / RayTriangles.Count * TriangleRay.VectorsPerQuad], ref search))
            {
                search.Face = faces[Math.Min(first + search.Face, faces.Length - 1)];
                isHit = true;
                if (search.StopsAtFirst)
                {
                    return true;
                }
            }
        }

        return isHit;
    }

    [SkipLocalsInit]
    private bool TryIntersectNodes(in LocalRay ray, ref RaySearch search)
    {
        _box ??= new(bvh.Mesh.UsedBounds);
        var approached = ray;
        if (!_box.TryApproach(ref approached, in search))
        {
            return false;
        }

        var speed = ray.Speed;
        var floatRay = new FloatRay(in approached, speed, 1 / speed, SimdAffineMap.ToVector256(bvh.Origin), bvh.Scale, in search);
        var triangleRay = new TriangleRay(in approached, search.Error);
        var (nearX, farX) = Sides(in floatRay, 0, out var nearOriginX, out var farOriginX);
        var (nearY, farY) = Sides(in floatRay, 1, out var nearOriginY, out var farOriginY);
        var (nearZ, farZ) = Sides(in floatRay, 2, out var nearOriginZ, out var farOriginZ);
        var ix = Vector256.Create(floatRay.InverseDirection[0]);
        var iy = Vector256.Create(floatRay.InverseDirection[1]);
        var iz = Vector256.Create(floatRay.InverseDirection[2]);
        var limit = floatRay.Limit;
        Span<ulong> stack = stackalloc ulong[bvh.StackSize];
        Span<Vector256<double>> quad = stackalloc Vector256<double>[TriangleRay.VectorsPerQuad];
        ref var stackBase = ref MemoryMarshal.GetReference(stack);
        ref var nodes = ref bvh.Node(BvhChild.Root);
        nint stackCount = 0;
        var isHit = false;
        var current = BvhChild.Root;
        while (true)
        {
            if (current.IsNode)
            {
                search.BoundTests += BvhLayout.BranchingFactor;
                ref var node = ref Unsafe.Add(ref nodes, (nint)current.NodeIndex * BvhLayout.VectorsPerNode);
                var near = Vector256.MaxNative(
                    Vector256.MaxNative(
                        (Unsafe.Add(ref node, nearX) - nearOriginX) * ix, (Unsafe.Add(ref node, nearY) - nearOriginY) * iy),
                    Vector256.MaxNative((Unsafe.Add(ref node, nearZ) - nearOriginZ) * iz, Vector256<float>.Zero));
                var far = Vector256.MinNative(
                    Vector256.MinNative(
                        (Unsafe.Add(ref node, farX) - farOriginX) * ix, (Unsafe.Add(ref node, farY) - farOriginY) * iy),
                    Vector256.MinNative((Unsafe.Add(ref node, farZ) - farOriginZ) * iz, Vector256.Create(limit)));
                var hits = Vector256.LessThanOrEqual(near, far);
                var hitCount = BitOperations.PopCount(hits.ExtractMostSignificantBits());
                if (hitCount != 0)
                {
                    ChildStack.Push(near, hits, Unsafe.Add(ref node, 6).AsUInt32(), ref Unsafe.Add(ref stackBase, stackCount));
                    stackCount += hitCount - 1;
                    current = BvhChild.FromBits((uint)Unsafe.Add(ref stackBase, stackCount));
                    continue;
                }
            }
            else if (TryIntersectLeaf(current, in triangleRay, quad, ref search))
            {
                isHit = true;
                if (search.StopsAtFirst)
                {
                    return true;
                }

                limit = FloatRay.LimitFor(in approached, floatRay.PerDistance, search.MaxDistance);
            }

            do
            {
                if (stackCount == 0)
                {
                    return isHit;
                }

                stackCount--;
            }
            while (!(BitConverter.UInt32BitsToSingle((uint)(Unsafe.Add(ref stackBase, stackCount) >> 32)) <= limit));
            current = BvhChild.FromBits((uint)Unsafe.Add(ref stackBase, stackCount));
        }
    }

    private bool TryIntersectLeaf(BvhChild leaf, in TriangleRay ray, Span<Vector256<double>> quad, ref RaySearch search)
    {
        var faces = bvh.Faces(leaf);
        search.FaceTests += faces.Length;
        var isHit = false;
        for (var first = 0; first < faces.Length; first += RayTriangles.Count)
        {
            var four = faces[first..Math.Min(first + RayTriangles.Count, faces.Length)];
            RayTriangles.Gather(bvh.Mesh, four, ref quad[0]);
            if (ray.TryIntersect(ref quad[0], ref search))
            {
                search.Face = four[Math.Min(search.Face, four.Length - 1)];
                isHit = true;
                if (search.StopsAtFirst)
                {
                    break;
                }
            }
        }

        return isHit;
    }

    /// <summary>Finds the sides of boxes where a ray enters and leaves them along an axis.</summary>
    /// <param name="ray">The ray.</param>
    /// <param name="axis">0 for x, 1 for y, 2 for z.</param>
    /// <param name="nearOrigin">Its origin, moved so that near sides are widened.</param>
    /// <param name="farOrigin">Its origin, moved so that far sides are widened.</param>
    /// <returns>The vectors of a node that hold these sides.</returns>
    private static (nint Near, nint Far) Sides(
        in FloatRay ray, int axis, out Vector256<float> nearOrigin, out Vector256<float> farOrigin)
    {
        var widening = float.CopySign(ray.Widening, ray.Direction.GetElement(axis));
        nearOrigin = Vector256.Create(ray.Origin.GetElement(axis) + widening);
        farOrigin = Vector256.Create(ray.Origin.GetElement(axis) - widening);
        return widening > 0 ? (axis, axis + 3) : (axis + 3, axis);
    }
}
