using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Detail;

/// <content>What instances cover.</content>
internal sealed partial class StripSearch
{
    private void Emit(DetailState state, in AffineLanes map, in Footprint footprint, Trail path)
    {
        var placed = map;
        if (!state.IsStandInIdentity)
        {
            var standIn = state.StandIn;
            placed = AffineLanes.Compose(in map, in standIn);
        }

        if (_settings.SkipsHidden && footprint.IsWhole && _object.IsOpaque && _mesh.Faces.Length > 0 && !Covers(in placed))
        {
            _cost.Uncovering++;
            return;
        }

        IsCut |= !footprint.IsWhole;
        var rows = footprint.IsShared || !footprint.IsWhole ? Shared : Rows;
        var inWorld = AffineLanes.Compose(in _toWorld, in placed);
        rows.Add(in inWorld, _origin, path.Number);
        if (_object.Gradient != GradientKind.None)
        {
            rows.SetTint(path.Way.Tint(_object.Gradient, _object.Table.Levels));
        }
    }

    /// <summary>Draws the base mesh. True when it is the nearest at the middle of some pixel.</summary>
    private bool Covers(in AffineLanes map)
    {
        var place = map.Apply(AffineLanes.Of(_mesh.Middle));
        var (v1, v2, v3) = (map.V1, map.V2, map.V3);
        var (x1, x2, x3, x) = (Vector256.Create((float)v1[0]), Vector256.Create((float)v2[0]), Vector256.Create((float)v3[0]), Vector256.Create((float)place[0]));
        var (y1, y2, y3, y) = (Vector256.Create((float)v1[1]), Vector256.Create((float)v2[1]), Vector256.Create((float)v3[1]), Vector256.Create((float)place[1]));
        var (z1, z2, z3, z) = (Vector256.Create((float)v1[2]), Vector256.Create((float)v2[2]), Vector256.Create((float)v3[2]), Vector256.Create((float)place[2]));
        ref var meshX = ref MemoryMarshal.GetArrayDataReference(_mesh.X);
        ref var meshY = ref MemoryMarshal.GetArrayDataReference(_mesh.Y);
        ref var meshZ = ref MemoryMarshal.GetArrayDataReference(_mesh.Z);
        ref var screenX = ref MemoryMarshal.GetArrayDataReference(_screenX);
        ref var screenY = ref MemoryMarshal.GetArrayDataReference(_screenY);
        ref var nearness = ref MemoryMarshal.GetArrayDataReference(_nearness);
        var (scaleX, scaleY) = (Vector256.Create((float)(SubPixel * _scaleX)), Vector256.Create((float)(-SubPixel * _scaleY)));
        var (middleX, middleY) = (Vector256.Create((float)(SubPixel * _middleX)), Vector256.Create((float)(SubPixel * _middleY)));
        var perSubPixel = Vector256.Create(1 / SubPixel);
        for (var i = 0; i < _mesh.Padded; i += Vector256<float>.Count)
        {
            var (cornerX, cornerY, cornerZ) = (
                Vector256.LoadUnsafe(ref meshX, (nuint)i), Vector256.LoadUnsafe(ref meshY, (nuint)i), Vector256.LoadUnsafe(ref meshZ, (nuint)i));
            var viewX = x + (x1 * cornerX) + (x2 * cornerY) + (x3 * cornerZ);
            var viewY = y + (y1 * cornerX) + (y2 * cornerY) + (y3 * cornerZ);
            var viewZ = z + (z1 * cornerX) + (z2 * cornerY) + (z3 * cornerZ);
            var near = _view.IsPerspective ? Vector256<float>.One / viewZ : -viewZ;
            if (_view.IsPerspective)
            {
                (viewX, viewY) = (viewX * near, viewY * near);
            }

            // As rasterizers do, on a grid of 1/256 pixel.
            (Vector256.Round(middleX + (scaleX * viewX)) * perSubPixel).StoreUnsafe(ref screenX, (nuint)i);
            (Vector256.Round(middleY + (scaleY * viewY)) * perSubPixel).StoreUnsafe(ref screenY, (nuint)i);
            near.StoreUnsafe(ref nearness, (nuint)i);
        }

        return DrawFaces(Math.Sign(_object.SolidSign) * (IsMirrored(v1, v2, v3) ? -1 : 1));
    }

    private bool DrawFaces(int side)
    {
        var covers = false;
        var faces = _mesh.Faces;
        ref var screenX = ref MemoryMarshal.GetArrayDataReference(_screenX);
        ref var screenY = ref MemoryMarshal.GetArrayDataReference(_screenY);
        for (var i = 0; i + 2 < faces.Length; i += 3)
        {
            var (a, b, c) = (faces[i], faces[i + 1], faces[i + 2]);
            var (ax, ay) = (Unsafe.Add(ref screenX, a), Unsafe.Add(ref screenY, a));
            var (bx, by) = (Unsafe.Add(ref screenX, b), Unsafe.Add(ref screenY, b));
            var (cx, cy) = (Unsafe.Add(ref screenX, c), Unsafe.Add(ref screenY, c));
            // Of a solid only the front is seen: on the screen, y downwards, it is wound clockwise.
            var area = ((bx - ax) * (cy - ay)) - ((by - ay) * (cx - ax));
            if (side == 0 || area * side > 0)
            {
                covers |= _coverage.Draw(ax, ay, _nearness[a], bx, by, _nearness[b], cx, cy, _nearness[c]);
            }
        }

        return covers;
    }

    private static bool IsMirrored(Vector256<double> v1, Vector256<double> v2, Vector256<double> v3) =>
        (v1[0] * ((v2[1] * v3[2]) - (v2[2] * v3[1]))) + (v1[1] * ((v2[2] * v3[0]) - (v2[0] * v3[2]))) + (v1[2] * ((v2[0] * v3[1]) - (v2[1] * v3[0]))) < 0;
}
