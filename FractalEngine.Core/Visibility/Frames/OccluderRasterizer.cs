using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Frames;

/// <summary>Rasterizes instances of a base mesh into the occlusion buffer of a strip.</summary>
internal sealed class OccluderRasterizer
{
    // Vertices are rounded to a grid of 1/256 pixel, as graphics hardware does.
    private const float SubPixelsPerPixel = 256;

    private readonly OcclusionBuffer _buffer = new();
    private float[] _screenX = [];
    private float[] _screenY = [];
    private float[] _inverseDepths = [];

    /// <summary>Clears the occlusion buffer for a frame.</summary>
    public void Clear(in StripFrame frame) => _buffer.Clear(frame.Left, frame.Right, frame.Height, frame.IsMultisampled);

    /// <summary>Tests whether everything in a footprint is hidden behind what has been rasterized.</summary>
    public bool IsOccluded(in ScreenFootprint footprint) =>
        _buffer.IsOccluded(footprint.Left, footprint.Top, footprint.Right, footprint.Bottom, footprint.MaxInverseDepth);

    /// <summary>Rasterizes an instance that lies beyond the near plane.</summary>
    /// <param name="frame">Strip that the instance is projected to.</param>
    /// <param name="mesh">Base mesh of the instance.</param>
    /// <param name="map">Map from the base mesh's frame to view space.</param>
    /// <param name="windingSign">
    /// 1 where the base mesh is a closed solid wound outwards, −1 inwards, so that its back faces are never visible; 0 where that is
    /// unknown.
    /// </param>
    /// <returns>True when the instance is the closest at some sample.</returns>
    public bool Rasterize(in StripFrame frame, OccluderMesh mesh, in SimdAffineMap map, int windingSign)
    {
        if (_screenX.Length < mesh.PaddedVertexCount)
        {
            _screenX = new float[mesh.PaddedVertexCount];
            _screenY = new float[mesh.PaddedVertexCount];
            _inverseDepths = new float[mesh.PaddedVertexCount];
        }

        ProjectVertices(in frame, mesh, in map);
        return RasterizeTriangles(mesh.VertexIndices, Math.Sign(windingSign) * (IsMirrored(in map) ? -1 : 1));
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private void ProjectVertices(in StripFrame frame, OccluderMesh mesh, in SimdAffineMap map)
    {
        var centre = map.Apply(SimdAffineMap.ToVector256(mesh.Centre));
        var rowX = new MapRowX8(in map, centre, 0);
        var rowY = new MapRowX8(in map, centre, 1);
        var rowZ = new MapRowX8(in map, centre, 2);
        ref var meshX = ref MemoryMarshal.GetArrayDataReference(mesh.X);
        ref var meshY = ref MemoryMarshal.GetArrayDataReference(mesh.Y);
        ref var meshZ = ref MemoryMarshal.GetArrayDataReference(mesh.Z);
        ref var screenX = ref MemoryMarshal.GetArrayDataReference(_screenX);
        ref var screenY = ref MemoryMarshal.GetArrayDataReference(_screenY);
        ref var inverseDepths = ref MemoryMarshal.GetArrayDataReference(_inverseDepths);
        var scaleX = Vector256.Create((float)(SubPixelsPerPixel * frame.ScaleX));
        var scaleY = Vector256.Create((float)(-SubPixelsPerPixel * frame.ScaleY));
        var centreX = Vector256.Create((float)(SubPixelsPerPixel * frame.CentreX));
        var centreY = Vector256.Create((float)(SubPixelsPerPixel * frame.CentreY));
        var subPixelSize = Vector256.Create(1 / SubPixelsPerPixel);
        for (var i = 0; i < mesh.PaddedVertexCount; i += Vector256<float>.Count)
        {
            var vertexX = Vector256.LoadUnsafe(ref meshX, (nuint)i);
            var vertexY = Vector256.LoadUnsafe(ref meshY, (nuint)i);
            var vertexZ = Vector256.LoadUnsafe(ref meshZ, (nuint)i);
            var viewX = rowX.Apply(vertexX, vertexY, vertexZ);
            var viewY = rowY.Apply(vertexX, vertexY, vertexZ);
            var viewZ = rowZ.Apply(vertexX, vertexY, vertexZ);
            var inverseDepth = -viewZ;
            if (frame.IsPerspective)
            {
                inverseDepth = Vector256<float>.One / viewZ;
                viewX *= inverseDepth;
                viewY *= inverseDepth;
            }

            (Vector256.Round(centreX + (scaleX * viewX)) * subPixelSize).StoreUnsafe(ref screenX, (nuint)i);
            (Vector256.Round(centreY + (scaleY * viewY)) * subPixelSize).StoreUnsafe(ref screenY, (nuint)i);
            inverseDepth.StoreUnsafe(ref inverseDepths, (nuint)i);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private bool RasterizeTriangles(int[] indices, int windingSign)
    {
        var isVisible = false;
        ref var screenX = ref MemoryMarshal.GetArrayDataReference(_screenX);
        ref var screenY = ref MemoryMarshal.GetArrayDataReference(_screenY);
        for (var i = 0; i + 2 < indices.Length; i += 3)
        {
            var (a, b, c) = (indices[i], indices[i + 1], indices[i + 2]);
            var (ax, ay) = (Unsafe.Add(ref screenX, a), Unsafe.Add(ref screenY, a));
            var (bx, by) = (Unsafe.Add(ref screenX, b), Unsafe.Add(ref screenY, b));
            var (cx, cy) = (Unsafe.Add(ref screenX, c), Unsafe.Add(ref screenY, c));
            // Only front faces of a solid are visible: on the screen, y downwards, they are wound clockwise.
            var area = ((bx - ax) * (cy - ay)) - ((by - ay) * (cx - ax));
            if (windingSign == 0 || area * windingSign > 0)
            {
                isVisible |= _buffer.RasterizeTriangle(ax, ay, _inverseDepths[a], bx, by, _inverseDepths[b], cx, cy, _inverseDepths[c]);
            }
        }

        return isVisible;
    }

    private static bool IsMirrored(in SimdAffineMap map)
    {
        var (v1, v2, v3) = (map.V1, map.V2, map.V3);
        return (v1[0] * ((v2[1] * v3[2]) - (v2[2] * v3[1]))) + (v1[1] * ((v2[2] * v3[0]) - (v2[0] * v3[2])))
            + (v1[2] * ((v2[0] * v3[1]) - (v2[1] * v3[0]))) < 0;
    }
}
