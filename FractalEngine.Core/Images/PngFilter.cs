using System.Diagnostics;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Images;

/// <summary>
/// Filters rows of RGBA pixels, of 8 or 16 bits, and chooses the filter: the one whose differences, taken as signed numbers, have the least
/// sum of magnitudes (PNG, third edition, §12.7). Of equal ones the first. Costs about 0.6 ns a byte.
/// </summary>
/// <param name="rowBytes">Bytes of a row.</param>
/// <param name="distance">Bytes from a pixel to the next: 4 or 8.</param>
internal sealed class PngFilter(int rowBytes, int distance = 4)
{
    // The bytes that follow the last whole vector are filtered so many at once.
    private const int TailBytes = 4;

    private const int FilterCount = 5;

    // Magnitudes up to 128, two of them added to each of eight 16-bit sums a step: 255 steps stay below 65536.
    private const int StepsOfNarrowSum = 255;

    // A pixel of zeros stands before each row, as the filters see it.
    private byte[] _row = new byte[distance + rowBytes];
    private byte[] _above = new byte[distance + rowBytes];

    // The type of the filter, then the differences. The best one so far, and the one that is tried.
    private byte[] _best = new byte[1 + rowBytes];
    private byte[] _tried = new byte[1 + rowBytes];

    /// <summary>Filters the next row.</summary>
    /// <param name="row">Its bytes.</param>
    /// <returns>The type of the filter and the filtered bytes; valid until the next call.</returns>
    public ReadOnlySpan<byte> Apply(ReadOnlySpan<byte> row)
    {
        Debug.Assert(row.Length == rowBytes);
        (_row, _above) = (_above, _row);
        row.CopyTo(_row.AsSpan(distance));
        var least = long.MaxValue;
        for (var filter = 0; filter < FilterCount; filter++)
        {
            _tried[0] = (byte)filter;
            var sum = Subtract(filter);
            if (sum < least)
            {
                least = sum;
                (_best, _tried) = (_tried, _best);
            }
        }

        return _best;
    }

    private long Subtract(int filter) => filter switch
    {
        0 => Subtract<PngNonePredictor>(),
        1 => Subtract<PngSubPredictor>(),
        2 => Subtract<PngUpPredictor>(),
        3 => Subtract<PngAveragePredictor>(),
        _ => Subtract<PngPaethPredictor>(),
    };

    /// <summary>Writes the differences from what is predicted, and returns the sum of their magnitudes.</summary>
    private long Subtract<TPredictor>()
        where TPredictor : struct, IPngPredictor
    {
        var row = _row.AsSpan();
        var above = _above.AsSpan();
        var target = _tried.AsSpan(1);
        var total = 0L;
        var i = 0;
        while (i <= rowBytes - Vector128<byte>.Count)
        {
            var narrow = Vector128<ushort>.Zero;
            var end = Math.Min(rowBytes - Vector128<byte>.Count, i + ((StepsOfNarrowSum - 1) * Vector128<byte>.Count));
            for (; i <= end; i += Vector128<byte>.Count)
            {
                var difference = Vector128.Create<byte>(row[(i + distance)..]) - TPredictor.Predict(
                    Vector128.Create<byte>(row[i..]), Vector128.Create<byte>(above[(i + distance)..]), Vector128.Create<byte>(above[i..]));
                difference.CopyTo(target[i..]);
                var (low, high) = Vector128.Widen(Vector128.Min(difference, -difference));
                narrow += low + high;
            }

            var (sums1, sums2) = Vector128.Widen(narrow);
            total += Vector128.Sum(sums1 + sums2);
        }

        for (; i < rowBytes; i += TailBytes)
        {
            var difference = Load(row[(i + distance)..]) - TPredictor.Predict(
                Load(row[i..]), Load(above[(i + distance)..]), Load(above[i..]));
            MemoryMarshal.Write(target[i..], difference.AsUInt32().ToScalar());
            var (low, _) = Vector128.Widen(Vector128.Min(difference, -difference));
            total += Vector128.Sum(low);
        }

        return total;
    }

    /// <summary>Loads four bytes into the first ones of a vector; the others are 0.</summary>
    private static Vector128<byte> Load(ReadOnlySpan<byte> bytes) => Vector128.CreateScalar(MemoryMarshal.Read<uint>(bytes)).AsByte();
}
