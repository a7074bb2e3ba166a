using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Bvh.Splitting;

/// <summary>Computes the bounding boxes of all triangles of a mesh in single precision, rounded outwards.</summary>
/// <param name="mesh">A mesh with at least one face.</param>
/// <param name="origin">Origin of the boxes' coordinates.</param>
/// <param name="scale">Factor by which coordinates relative to the origin are multiplied.</param>
internal sealed class TriangleBoundsBuilder(Mesh mesh, Vector origin, double scale)
{
    // Chunks of this size keep a thread busy for some hundred microseconds.
    private const int ChunkSize = 16_384;

    /// <summary>Computes the boxes of all triangles.</summary>
    /// <param name="triangles">Receives one box a face, in the order of the faces.</param>
    /// <param name="loop">Runs the work on several threads.</param>
    /// <returns>The range of all triangles.</returns>
    public TriangleRange Compute(TriangleBounds[] triangles, ParallelLoop loop)
    {
        var chunks = new TriangleRange[(triangles.Length + ChunkSize - 1) / ChunkSize];
        loop.For(chunks.Length, chunk =>
        {
            var start = chunk * ChunkSize;
            chunks[chunk] = ComputeChunk(triangles, start, Math.Min(ChunkSize, triangles.Length - start));
        });
        return chunks.Aggregate((range1, range2) => new(
            0,
            range1.Count + range2.Count,
            range1.Bounds.Including(range2.Bounds),
            range1.DoubledCentreBounds.Including(range2.DoubledCentreBounds)));
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private TriangleRange ComputeChunk(TriangleBounds[] triangles, int start, int count)
    {
        var simdOrigin = SimdAffineMap.ToVector256(origin);
        var simdScale = Vector256.Create(scale);
        var bounds = SimdBoundingBox.Empty;
        var doubledCentreBounds = SimdBoundingBox.Empty;
        for (var face = start; face < start + count; face++)
        {
            var (vertexA, vertexB, vertexC) = mesh.Face(face);
            var a = SimdAffineMap.ToVector256(vertexA);
            var b = SimdAffineMap.ToVector256(vertexB);
            var c = SimdAffineMap.ToVector256(vertexC);
            var minimum = Vector256.MinNative(Vector256.MinNative(a, b), c);
            var maximum = Vector256.MaxNative(Vector256.MaxNative(a, b), c);
            var lower = FloatRounding.Down((minimum - simdOrigin) * simdScale).AsInt32().WithElement(3, face).AsSingle();
            var upper = FloatRounding.Up((maximum - simdOrigin) * simdScale);
            var box = new SimdBoundingBox(lower, upper);
            triangles[face] = new(box);
            bounds = bounds.Including(box);
            doubledCentreBounds = doubledCentreBounds.Including(SimdBoundingBox.Of(box.DoubledCentre));
        }

        return new(start, count, bounds, doubledCentreBounds);
    }
}
