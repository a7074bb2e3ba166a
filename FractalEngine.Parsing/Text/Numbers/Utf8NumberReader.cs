using System.Buffers.Binary;
using System.Globalization;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Parsing.Text.Numbers;

/// <summary>
/// Reads the numbers of <see cref="NumberReader"/> from bytes, eight digits at a time. This is the kernel for large files: what it refuses,
/// it leaves to the parsers.
/// </summary>
/// <remarks>
/// All methods read up to <see cref="Padding"/> bytes beyond the number, so that the text needs as many behind its end. Positions are
/// offsets from a reference to the text, which inner loops pass instead of spans to save the checks.
/// </remarks>
internal static class Utf8NumberReader
{
    /// <summary>Number of readable bytes, of any value but digits at first, that must follow the text.</summary>
    public const int Padding = 32;

    /// <summary>Position that says that the text has no number, or one that only the parsers read.</summary>
    public const nint None = -1;

    private const ulong ZeroDigits = 0x3030303030303030;
    private const ulong HighBits = 0x8080808080808080;
    private const int MaxExponentDigits = 6;

    private static ReadOnlySpan<ulong> PowersOfTen => [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

    /// <summary>Reads a finite number and returns the position behind it, or <see cref="None"/>.</summary>
    /// <param name="text">Start of a padded text.</param>
    /// <param name="position">Position of the number's sign, first digit or point.</param>
    /// <param name="value">Receives the closest double.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static nint Read(ref byte text, nint position, ref double value)
    {
        // The other characters among the first sixteen say where the parts end. The first may be a sign.
        var characters = Vector128.LoadUnsafe(ref text, (nuint)position);
        var digitValues = characters - Vector128.Create((byte)'0');
        var others = Vector128.GreaterThan(digitValues, Vector128.Create((byte)9)).ExtractMostSignificantBits();
        var sign = (int)(others & 1);
        others &= ~1u;
        var point = BitOperations.TrailingZeroCount(others);
        var end = BitOperations.TrailingZeroCount(others & (others - 1));
        var count = end - 1 - sign;
        var first = (uint)Unsafe.Add(ref text, position);
        if (count > 8 || end == point + 1 || Unsafe.Add(ref text, position + point) != '.' || (sign != 0 && !IsSign(first))
            || (Unsafe.Add(ref text, position + end) | 0x20) == 'e')
        {
            return ReadLong(ref text, position, ref value);
        }

        // Both parts together are one integer of up to eight digits, at least one of them behind the point. The bytes behind the last
        // digit are shifted out.
        var wholeBits = 8 * (point - sign);
        var whole = LoadDigits(ref text, position + sign) & ((1UL << wholeBits) - 1);
        var fraction = LoadDigits(ref text, position + point + 1) << wholeBits;
        var digits = (whole | fraction) << (64 - (8 * count));
        var magnitude = (double)(long)CombineDigits(digits)
            / Unsafe.Add(ref MemoryMarshal.GetReference(DecimalConversion.ExactPowersOfTen), (nint)(uint)(end - point - 1));
        value = ApplySign(magnitude, first);
        return position + end;
    }

    /// <summary>Reads an integer of one to eight digits and returns the position behind it, or <see cref="None"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static nint ReadInteger(ref byte text, nint position, out int value)
    {
        var digits = LoadDigits(ref text, position);
        var count = CountDigits(digits);
        if (count == 0)
        {
            value = 0;
            return None;
        }

        value = (int)CombineDigits(digits << (64 - (8 * count)));
        return position + count;
    }

    /// <summary>Reads any number with up to 19 significant digits, or asks the framework.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static nint ReadLong(ref byte text, nint position, ref double value)
    {
        var first = (uint)Unsafe.Add(ref text, position);
        var start = position + (IsSign(first) ? 1 : 0);
        var mantissa = 0UL;
        var end = ReadDigits(ref text, start, ref mantissa);
        var digitCount = end - start;
        var exponent = 0;
        if (Unsafe.Add(ref text, end) == '.')
        {
            var fractionStart = end + 1;
            end = ReadDigits(ref text, fractionStart, ref mantissa);
            exponent = (int)(fractionStart - end);
            digitCount += end - fractionStart;
        }

        if (digitCount == 0)
        {
            return None;
        }

        if ((Unsafe.Add(ref text, end) | 0x20) == 'e')
        {
            end = ReadExponent(ref text, end + 1, ref exponent);
            if (end == None)
            {
                return None;
            }
        }

        if (digitCount > DecimalConversion.MaxDigits)
        {
            return ReadByFramework(ref text, position, end, ref value);
        }

        value = ApplySign(DecimalConversion.ToDouble(mantissa, exponent), first);
        return double.IsFinite(value) ? end : None;
    }

    private static nint ReadByFramework(ref byte text, nint position, nint end, ref double value)
    {
        var number = MemoryMarshal.CreateReadOnlySpan(ref Unsafe.Add(ref text, position), (int)(end - position));
        value = double.Parse(number, NumberStyles.Float, CultureInfo.InvariantCulture);
        return double.IsFinite(value) ? end : None;
    }

    /// <summary>Appends digits to a mantissa, modulo 2⁶⁴, and returns the position behind them.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static nint ReadDigits(ref byte text, nint position, ref ulong mantissa)
    {
        var digits = LoadDigits(ref text, position);
        var count = CountDigits(digits);
        while (count == 8)
        {
            mantissa = (mantissa * 100_000_000) + CombineDigits(digits);
            position += 8;
            digits = LoadDigits(ref text, position);
            count = CountDigits(digits);
        }

        if (count > 0)
        {
            mantissa = (mantissa * Unsafe.Add(ref MemoryMarshal.GetReference(PowersOfTen), (nint)(uint)count))
                + CombineDigits(digits << (64 - (8 * count)));
        }

        return position + count;
    }

    /// <summary>Adds the exponent behind an 'e' to another one; <see cref="None"/> without digits or with too many.</summary>
    private static nint ReadExponent(ref byte text, nint position, ref int exponent)
    {
        var isNegative = Unsafe.Add(ref text, position) == '-';
        position += isNegative || Unsafe.Add(ref text, position) == '+' ? 1 : 0;
        var end = ReadInteger(ref text, position, out var written);
        if (end == None || end - position > MaxExponentDigits)
        {
            return None;
        }

        exponent += isNegative ? -written : written;
        return end;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static bool IsSign(uint character) => character is '+' or '-';

    /// <summary>Loads eight characters, the first into the lowest byte, with digits as 0 to 9.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static ulong LoadDigits(ref byte text, nint position)
    {
        var characters = Unsafe.ReadUnaligned<ulong>(ref Unsafe.Add(ref text, position));
        return (BitConverter.IsLittleEndian ? characters : BinaryPrimitives.ReverseEndianness(characters)) ^ ZeroDigits;
    }

    /// <summary>Counts the bytes from 0 to 9 before the first other one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static int CountDigits(ulong digits)
    {
        // Adding 0x76 sets the high bit of bytes above 9. A carry out of a byte can spoil only those behind the first other one.
        var others = ((digits + 0x7676767676767676) | digits) & HighBits;
        return BitOperations.TrailingZeroCount(others) >> 3;
    }

    /// <summary>Combines eight digits, the most significant in the lowest byte, by pairs, fours and eights.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static ulong CombineDigits(ulong digits)
    {
        digits = (digits * 10) + (digits >> 8);
        const ulong Pairs = 0x000000FF000000FF;
        return (((digits & Pairs) * (100 + (1_000_000UL << 32))) + (((digits >> 16) & Pairs) * (1 + (10_000UL << 32)))) >> 32;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static double ApplySign(double magnitude, uint first)
    {
        var sign = first == '-' ? 1UL << 63 : 0;
        return BitConverter.UInt64BitsToDouble(BitConverter.DoubleToUInt64Bits(magnitude) | sign);
    }
}
