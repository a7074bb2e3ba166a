using System.Buffers.Binary;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace FractalEngine.Core.Images;

/// <summary>
/// The checksum of PNG chunks and gzip files: CRC-32 with the reflected polynomial EDB88320 (PNG, third edition, annex D). Sixteen tables
/// take sixteen bytes a step (slicing, Kounavis and Berry 2005), since a loop over bytes takes as long as decompression. 3 GB/s.
/// </summary>
public static class Crc32
{
    private const int Slices = 16;

    // [16 × 256]: the effect of a byte that is followed by 0, 1, … 15 others.
    private static readonly uint[] Tables = CreateTables();

    /// <summary>Continues a checksum with further bytes.</summary>
    /// <param name="crc">The checksum so far; 0 at the beginning.</param>
    /// <param name="bytes">The bytes that follow.</param>
    public static uint Append(uint crc, ReadOnlySpan<byte> bytes)
    {
        // A checked index would cost as much as the step itself. Each one below is a slice and a byte.
        ref var table = ref MemoryMarshal.GetArrayDataReference(Tables);
        crc = ~crc;
        while (bytes.Length >= Slices)
        {
            var low = BinaryPrimitives.ReadUInt64LittleEndian(bytes) ^ crc;
            var high = BinaryPrimitives.ReadUInt64LittleEndian(bytes[8..]);
            crc = Step(ref table, low, 8) ^ Step(ref table, high, 0);
            bytes = bytes[Slices..];
        }

        foreach (var value in bytes)
        {
            crc = Unsafe.Add(ref table, (nuint)((byte)crc ^ value)) ^ (crc >> 8);
        }

        return ~crc;
    }

    /// <summary>The effect of eight bytes, the first one lowest, that are followed by <paramref name="following"/> others.</summary>
    private static uint Step(ref uint table, ulong bytes, nuint following)
    {
        ref var last = ref Unsafe.Add(ref table, following << 8);
        return Unsafe.Add(ref last, (nuint)(0x700 | (bytes & 0xFF))) ^ Unsafe.Add(ref last, (nuint)(0x600 | ((bytes >> 8) & 0xFF)))
            ^ Unsafe.Add(ref last, (nuint)(0x500 | ((bytes >> 16) & 0xFF))) ^ Unsafe.Add(ref last, (nuint)(0x400 | ((bytes >> 24) & 0xFF)))
            ^ Unsafe.Add(ref last, (nuint)(0x300 | ((bytes >> 32) & 0xFF))) ^ Unsafe.Add(ref last, (nuint)(0x200 | ((bytes >> 40) & 0xFF)))
            ^ Unsafe.Add(ref last, (nuint)(0x100 | ((bytes >> 48) & 0xFF))) ^ Unsafe.Add(ref last, (nuint)(bytes >> 56));
    }

    private static uint[] CreateTables()
    {
        var tables = new uint[Slices * 256];
        for (var i = 0u; i < 256; i++)
        {
            var crc = i;
            for (var bit = 0; bit < 8; bit++)
            {
                crc = (crc & 1) == 0 ? crc >> 1 : (crc >> 1) ^ 0xEDB88320;
            }

            tables[i] = crc;
        }

        for (var i = 256; i < tables.Length; i++)
        {
            var before = tables[i - 256];
            tables[i] = (before >> 8) ^ tables[before & 0xFF];
        }

        return tables;
    }
}
