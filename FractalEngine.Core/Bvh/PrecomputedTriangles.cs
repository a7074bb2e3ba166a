using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Bvh;

/// <summary>
/// The triangles of a small mesh by fours, with all that does not depend on a position. They are tested in double precision, since a search
/// of few triangles would not earn back what it takes to decide between its candidates.
/// </summary>
internal sealed class PrecomputedTriangles
{
    private readonly TriangleX4[] _quads;
    private readonly int[] _faces;
    private readonly byte[] _firstTriangles;
    private readonly byte[] _quadIndices;

    /// <summary>Precomputes all triangles of a mesh.</summary>
    /// <param name="mesh">A mesh of up to 255 faces.</param>
    /// <param name="faces">Its face indices, in the order of the fours.</param>
    /// <param name="counts">Number of triangles in each quad, one to four.</param>
    public PrecomputedTriangles(Mesh mesh, int[] faces, ReadOnlySpan<int> counts)
    {
        _faces = faces;
        _quads = new TriangleX4[counts.Length];
        _firstTriangles = new byte[counts.Length + 1];
        _quadIndices = new byte[faces.Length];
        var first = 0;
        for (var quad = 0; quad < counts.Length; quad++)
        {
            _quads[quad] = TriangleX4.Create(mesh, faces.AsSpan(first, counts[quad]));
            _quadIndices[first] = (byte)quad;
            first += counts[quad];
            _firstTriangles[quad + 1] = (byte)first;
        }
    }

    /// <summary>Number of bytes kept beside the mesh.</summary>
    public long StorageBytes =>
        (_quads.Length * (long)Unsafe.SizeOf<TriangleX4>()) + _firstTriangles.Length + _quadIndices.Length;

    /// <summary>Number of fours that the triangles make.</summary>
    public int QuadCount => _quads.Length;

    /// <summary>The index of the four that a leaf consists of.</summary>
    /// <param name="leaf">A leaf of at most four triangles.</param>
    public int QuadOf(BvhChild leaf) => _quadIndices[leaf.FirstTriangle];

    /// <summary>Tests four triangles in the mesh's own frame.</summary>
    /// <param name="quad">Index of the four.</param>
    /// <param name="position">In the mesh's frame.</param>
    /// <param name="closest">The limit; receives the closest triangle.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Test(int quad, in Vector position, ref ClosestTriangle closest) =>
        Update(TriangleX4.DistancesSquared(in _quads[quad], in position, closest.DistanceSquared), quad, ref closest);

    /// <summary>Tests the images of four triangles under a map.</summary>
    /// <param name="quad">Index of the four.</param>
    /// <param name="position">In the frame of the images.</param>
    /// <param name="map">From the mesh's frame to that of the images.</param>
    /// <param name="closest">The limit; receives the closest triangle.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void TestTransformed(int quad, in Vector position, in AffineMap map, ref ClosestTriangle closest) =>
        Update(TriangleX4.DistancesSquared(in _quads[quad], in position, in map), quad, ref closest);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private void Update(Vector256<double> distancesSquared, int quad, ref ClosestTriangle closest)
    {
        if (Vector256.LessThanOrEqualAny(distancesSquared, Vector256.Create(closest.DistanceSquared)))
        {
            closest.Update(distancesSquared, _faces.AsSpan(_firstTriangles[quad].._firstTriangles[quad + 1]));
        }
    }
}
