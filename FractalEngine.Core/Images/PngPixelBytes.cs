using System.Buffers.Binary;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Images;

/// <summary>How many bytes filters take for a pixel; loads and stores exactly these.</summary>
internal interface IPngPixelBytes
{
    /// <summary>The number of bytes, 1 to 8.</summary>
    static abstract int Count { get; }

    /// <summary>Loads a pixel into the first bytes of a vector; the others are 0.</summary>
    static abstract Vector128<byte> Load(ReadOnlySpan<byte> pixel);

    /// <summary>Stores the first bytes of a vector.</summary>
    static abstract void Store(Span<byte> pixel, Vector128<byte> value);
}

/// <summary>Pixels of up to 8 bits.</summary>
internal readonly struct PngOneByte : IPngPixelBytes
{
    public static int Count => 1;

    public static Vector128<byte> Load(ReadOnlySpan<byte> pixel) => Vector128.CreateScalar(pixel[0]);

    public static void Store(Span<byte> pixel, Vector128<byte> value) => pixel[0] = value.ToScalar();
}

/// <summary>Grey of 16 bits, or grey and alpha of 8.</summary>
internal readonly struct PngTwoBytes : IPngPixelBytes
{
    public static int Count => 2;

    public static Vector128<byte> Load(ReadOnlySpan<byte> pixel) => Vector128.CreateScalar(MemoryMarshal.Read<ushort>(pixel)).AsByte();

    public static void Store(Span<byte> pixel, Vector128<byte> value) => MemoryMarshal.Write(pixel, value.AsUInt16().ToScalar());
}

/// <summary>RGB of 8 bits.</summary>
internal readonly struct PngThreeBytes : IPngPixelBytes
{
    public static int Count => 3;

    public static Vector128<byte> Load(ReadOnlySpan<byte> pixel) =>
        Vector128.CreateScalar(BinaryPrimitives.ReadUInt16LittleEndian(pixel) | ((uint)pixel[2] << 16)).AsByte();

    public static void Store(Span<byte> pixel, Vector128<byte> value)
    {
        var bytes = value.AsUInt32().ToScalar();
        pixel[2] = (byte)(bytes >> 16);
        BinaryPrimitives.WriteUInt16LittleEndian(pixel, (ushort)bytes);
    }
}

/// <summary>RGBA of 8 bits, or grey and alpha of 16.</summary>
internal readonly struct PngFourBytes : IPngPixelBytes
{
    public static int Count => 4;

    public static Vector128<byte> Load(ReadOnlySpan<byte> pixel) => Vector128.CreateScalar(MemoryMarshal.Read<uint>(pixel)).AsByte();

    public static void Store(Span<byte> pixel, Vector128<byte> value) => MemoryMarshal.Write(pixel, value.AsUInt32().ToScalar());
}

/// <summary>RGB of 16 bits.</summary>
internal readonly struct PngSixBytes : IPngPixelBytes
{
    public static int Count => 6;

    public static Vector128<byte> Load(ReadOnlySpan<byte> pixel) => Vector128.CreateScalar(
        BinaryPrimitives.ReadUInt32LittleEndian(pixel) | ((ulong)BinaryPrimitives.ReadUInt16LittleEndian(pixel[4..]) << 32)).AsByte();

    public static void Store(Span<byte> pixel, Vector128<byte> value)
    {
        var bytes = value.AsUInt64().ToScalar();
        BinaryPrimitives.WriteUInt16LittleEndian(pixel[4..], (ushort)(bytes >> 32));
        BinaryPrimitives.WriteUInt32LittleEndian(pixel, (uint)bytes);
    }
}

/// <summary>RGBA of 16 bits.</summary>
internal readonly struct PngEightBytes : IPngPixelBytes
{
    public static int Count => 8;

    public static Vector128<byte> Load(ReadOnlySpan<byte> pixel) => Vector128.CreateScalar(MemoryMarshal.Read<ulong>(pixel)).AsByte();

    public static void Store(Span<byte> pixel, Vector128<byte> value) => MemoryMarshal.Write(pixel, value.AsUInt64().ToScalar());
}
