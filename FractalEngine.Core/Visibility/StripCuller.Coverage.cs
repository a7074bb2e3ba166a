using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Visibility;

/// <content>What instances cover.</content>
internal sealed partial class StripCuller
{
    private void Emit(LodNode node, in SimdAffineMap map, in Footprint footprint, CullingPath path)
    {
        var instanceToView = map;
        if (!node.IsProxyIdentity)
        {
            var proxyMap = node.ProxyMap;
            instanceToView = SimdAffineMap.Compose(in map, in proxyMap);
        }

        if (_settings.OcclusionCulling && footprint.IsBeyondNearPlane && _object.IsOpaque && _occluder.VertexIndices.Length > 0
            && !RasterizeOccluder(in instanceToView))
        {
            _statistics.ZeroCoverage++;
            return;
        }

        IsNearClipped |= !footprint.IsBeyondNearPlane;
        var instances = footprint.IsShared || !footprint.IsBeyondNearPlane ? SharedInstances : Instances;
        var instanceToWorld = SimdAffineMap.Compose(in _viewToWorld, in instanceToView);
        instances.Add(in instanceToWorld, _vertexOrigin, path.Hash);
        if (_object.GradientKind != GradientKind.None)
        {
            instances.SetGradientFactor(path.ColourPath.ComputeGradientFactor(_object.GradientKind, _object.Hierarchy.LevelCount));
        }
    }

    /// <summary>Draws the base mesh. True when it is the nearest at the middle of some pixel.</summary>
    private bool RasterizeOccluder(in SimdAffineMap map)
    {
        var centre = map.Apply(SimdAffineMap.ToVector256(_occluder.Centre));
        var (v1, v2, v3) = (map.V1, map.V2, map.V3);
        var (x1, x2, x3, x) = (Vector256.Create((float)v1[0]), Vector256.Create((float)v2[0]), Vector256.Create((float)v3[0]),
            Vector256.Create((float)centre[0]));
        var (y1, y2, y3, y) = (Vector256.Create((float)v1[1]), Vector256.Create((float)v2[1]), Vector256.Create((float)v3[1]),
            Vector256.Create((float)centre[1]));
        var (z1, z2, z3, z) = (Vector256.Create((float)v1[2]), Vector256.Create((float)v2[2]), Vector256.Create((float)v3[2]),
            Vector256.Create((float)centre[2]));
        ref var meshX = ref MemoryMarshal.GetArrayDataReference(_occluder.X);
        ref var meshY = ref MemoryMarshal.GetArrayDataReference(_occluder.Y);
        ref var meshZ = ref MemoryMarshal.GetArrayDataReference(_occluder.Z);
        ref var screenX = ref MemoryMarshal.GetArrayDataReference(_screenX);
        ref var screenY = ref MemoryMarshal.GetArrayDataReference(_screenY);
        ref var inverseDepths = ref MemoryMarshal.GetArrayDataReference(_inverseDepths);
        var (scaleX, scaleY) =
            (Vector256.Create((float)(SubPixelsPerPixel * _scaleX)), Vector256.Create((float)(-SubPixelsPerPixel * _scaleY)));
        var (centreX, centreY) =
            (Vector256.Create((float)(SubPixelsPerPixel * _centreX)), Vector256.Create((float)(SubPixelsPerPixel * _centreY)));
        var subPixelSize = Vector256.Create(1 / SubPixelsPerPixel);
        for (var i = 0; i < _occluder.PaddedVertexCount; i += Vector256<float>.Count)
        {
            var (vertexX, vertexY, vertexZ) = (
                Vector256.LoadUnsafe(ref meshX, (nuint)i), Vector256.LoadUnsafe(ref meshY, (nuint)i),
                Vector256.LoadUnsafe(ref meshZ, (nuint)i));
            var viewX = x + (x1 * vertexX) + (x2 * vertexY) + (x3 * vertexZ);
            var viewY = y + (y1 * vertexX) + (y2 * vertexY) + (y3 * vertexZ);
            var viewZ = z + (z1 * vertexX) + (z2 * vertexY) + (z3 * vertexZ);
            var inverseDepth = _view.IsPerspective ? Vector256<float>.One / viewZ : -viewZ;
            if (_view.IsPerspective)
            {
                (viewX, viewY) = (viewX * inverseDepth, viewY * inverseDepth);
            }

            // As rasterizers do, on a grid of 1/256 pixel.
            (Vector256.Round(centreX + (scaleX * viewX)) * subPixelSize).StoreUnsafe(ref screenX, (nuint)i);
            (Vector256.Round(centreY + (scaleY * viewY)) * subPixelSize).StoreUnsafe(ref screenY, (nuint)i);
            inverseDepth.StoreUnsafe(ref inverseDepths, (nuint)i);
        }

        return RasterizeTriangles(Math.Sign(_object.WindingSign) * (IsMirrored(v1, v2, v3) ? -1 : 1));
    }

    private bool RasterizeTriangles(int windingSign)
    {
        var isVisible = false;
        var indices = _occluder.VertexIndices;
        ref var screenX = ref MemoryMarshal.GetArrayDataReference(_screenX);
        ref var screenY = ref MemoryMarshal.GetArrayDataReference(_screenY);
        for (var i = 0; i + 2 < indices.Length; i += 3)
        {
            var (a, b, c) = (indices[i], indices[i + 1], indices[i + 2]);
            var (ax, ay) = (Unsafe.Add(ref screenX, a), Unsafe.Add(ref screenY, a));
            var (bx, by) = (Unsafe.Add(ref screenX, b), Unsafe.Add(ref screenY, b));
            var (cx, cy) = (Unsafe.Add(ref screenX, c), Unsafe.Add(ref screenY, c));
            // Of a solid only the front is seen: on the screen, y downwards, it is wound clockwise.
            var area = ((bx - ax) * (cy - ay)) - ((by - ay) * (cx - ax));
            if (windingSign == 0 || area * windingSign > 0)
            {
                isVisible |= _occlusionBuffer.RasterizeTriangle(ax, ay, _inverseDepths[a], bx, by, _inverseDepths[b], cx, cy,
                    _inverseDepths[c]);
            }
        }

        return isVisible;
    }

    private static bool IsMirrored(Vector256<double> v1, Vector256<double> v2, Vector256<double> v3) =>
        (v1[0] * ((v2[1] * v3[2]) - (v2[2] * v3[1]))) + (v1[1] * ((v2[2] * v3[0]) - (v2[0] * v3[2])))
        + (v1[2] * ((v2[0] * v3[1]) - (v2[1] * v3[0]))) < 0;
}
