using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Maths;

/// <summary>Converts double precision vectors to single precision, to nearest or conservatively in one direction.</summary>
internal static class FloatRounding
{
    /// <summary>Rounds each lane to the nearest float.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector128<float> ToNearest(Vector256<double> v) => Vector128.Narrow(v.GetLower(), v.GetUpper());

    /// <summary>Rounds each lane down, by at least one place below the nearest float.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector128<float> Down(Vector256<double> v)
    {
        var nearest = ToNearest(v);
        return nearest - UlpBound(nearest);
    }

    /// <summary>Rounds each lane up, by at least one place above the nearest float.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector128<float> Up(Vector256<double> v)
    {
        var nearest = ToNearest(v);
        return nearest + UlpBound(nearest);
    }

    /// <summary>Widens four of eight floats to double precision.</summary>
    /// <param name="v">Eight floats.</param>
    /// <param name="halfIndex">0 for the lower four, 1 for the upper four.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector256<double> WidenHalf(Vector256<float> v, int halfIndex) =>
        halfIndex == 0 ? Vector256.WidenLower(v) : Vector256.WidenUpper(v);

    /// <summary>An upper bound of the distance to the next float, in either direction.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector128<float> UlpBound(Vector128<float> v) => (Vector128.Abs(v) * 1.1920929e-7f) + Vector128.Create(1.1754944e-38f);
}
