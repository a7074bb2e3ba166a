using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Bounds of copies that are all of the same solid, in any sizes but none of them turned, as in Sierpiński's and Menger's fractals: what is known of the
/// solid in one direction serves all of them, four at a time.
/// </summary>
internal sealed class CopyShifts
{
    private const int Lanes = SubFractal.Lanes;

    // With more facets the solid is round, and they say little more than directions.
    private const int MostFacets = 8;

    private readonly HullBound _solid;
    private readonly int _padded;
    private readonly double[] _shifts;
    private readonly Vector[] _normals;
    private readonly double[] _offsets;

    private CopyShifts(HullBound solid, Copy[] copies, int padded)
    {
        (_solid, _padded, _shifts) = (solid, padded, new double[4 * padded]);
        var planes = solid.Planes.Count <= MostFacets ? solid.Planes : [];
        _normals = [.. planes.Select(plane => plane.Normal)];
        _offsets = new double[planes.Count * padded];
        for (var i = 0; i < copies.Length; i++)
        {
            var (shift, scale) = (copies[i].Map.Translation, copies[i].Map.Linear.V1.X);
            (_shifts[i], _shifts[padded + i], _shifts[(2 * padded) + i], _shifts[(3 * padded) + i]) = (shift.X, shift.Y, shift.Z, scale);
            for (var plane = 0; plane < planes.Count; plane++)
            {
                _offsets[(plane * padded) + i] = Vector.Dot(planes[plane].Normal, shift) + (scale * planes[plane].Offset);
            }
        }
    }

    /// <summary>Bytes of the arrays.</summary>
    public long StorageBytes => (sizeof(double) * (_shifts.Length + (3 * _normals.Length) + _offsets.Length)) + 64;

    /// <summary>True where no copy is turned.</summary>
    public static bool AreNone(Copy[] copies) =>
        copies.All(copy => copy.Down == copies[0].Down && copy.Map.Linear.V1.X > 0 && copy.Map.Linear == copy.Map.Linear.V1.X * Matrix.Identity);

    /// <summary>For copies, if they are so.</summary>
    /// <param name="solid">That they are copies of; null where their boxes are as good.</param>
    /// <param name="copies">Of the same level all.</param>
    /// <param name="padded">Their number, made a multiple of four.</param>
    public static CopyShifts? Of(HullBound? solid, Copy[] copies, int padded) => solid is not null && AreNone(copies) ? new(solid, copies, padded) : null;

    /// <summary>Raises the bounds of all copies by the planes of their facets: for positions among them.</summary>
    /// <param name="position">In the frame of the shifts: x, y, z, 0.</param>
    /// <param name="queue">Of the copies.</param>
    public void RaiseByFacets(Vector256<double> position, CopyQueue queue)
    {
        Vector p = new(position[0], position[1], position[2]);
        Span<double> heights = stackalloc double[MostFacets];
        for (var plane = 0; plane < _normals.Length; plane++)
        {
            heights[plane] = Vector.Dot(_normals[plane], p);
        }

        ref var offset = ref MemoryMarshal.GetArrayDataReference(_offsets);
        for (var i = 0; i < _padded; i += Lanes)
        {
            var most = Vector256<double>.Zero;
            for (var plane = 0; plane < _normals.Length; plane++)
            {
                most = Vector256.MaxNative(most, Vector256.Create(heights[plane]) - Vector256.LoadUnsafe(ref offset, (nuint)((plane * _padded) + i)));
            }

            queue.Raise(most * most, i);
        }
    }

    /// <summary>Raises the bounds of all copies by how far they reach in one direction: for positions outside.</summary>
    /// <param name="direction">From about the middle of all copies to the position: x, y, z, 0.</param>
    /// <param name="squared">Of its length.</param>
    /// <param name="position">In the frame of the shifts.</param>
    /// <param name="queue">Of the copies.</param>
    public void RaiseByReach(Vector256<double> direction, double squared, Vector256<double> position, CopyQueue queue)
    {
        var unit = direction * (1 / Math.Sqrt(squared));
        ref var shift = ref MemoryMarshal.GetArrayDataReference(_shifts);
        var (x, y, z) = (Vector256.Create(unit[0]), Vector256.Create(unit[1]), Vector256.Create(unit[2]));
        var (height, support) = (Vector256.Create(Vector256.Dot(unit, position)), Vector256.Create(_solid.Reach(unit)));
        for (var i = 0; i < _padded; i += Lanes)
        {
            var place = VectorQuartet.Load(ref shift, i, _padded);
            var reach = height - ((x * place.X) + (y * place.Y) + (z * place.Z)) - (Vector256.LoadUnsafe(ref shift, (nuint)((3 * _padded) + i)) * support);
            reach = Vector256.MaxNative(reach, Vector256<double>.Zero);
            queue.Raise(reach * reach, i);
        }
    }
}
