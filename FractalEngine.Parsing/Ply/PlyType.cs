using System.Buffers.Binary;

namespace FractalEngine.Parsing.Ply;

/// <summary>A type of numbers in PLY files.</summary>
/// <param name="Name">Its older name.</param>
/// <param name="SizedName">Its name with the number of bits.</param>
/// <param name="Size">Number of bytes that a number takes in binary files.</param>
/// <param name="Decode">Reads a number from bytes, the lowest first.</param>
/// <param name="ColourUnit">Number that stands for the full component of a colour.</param>
internal sealed record PlyType(string Name, string SizedName, int Size, Func<ReadOnlySpan<byte>, double> Decode, double ColourUnit = 1)
{
    private static readonly PlyType[] All =
    [
        new("char", "int8", 1, static bytes => (sbyte)bytes[0]),
        new("uchar", "uint8", 1, static bytes => bytes[0], byte.MaxValue),
        new("short", "int16", 2, static bytes => BinaryPrimitives.ReadInt16LittleEndian(bytes)),
        new("ushort", "uint16", 2, static bytes => BinaryPrimitives.ReadUInt16LittleEndian(bytes), ushort.MaxValue),
        new("int", "int32", 4, static bytes => BinaryPrimitives.ReadInt32LittleEndian(bytes)),
        new("uint", "uint32", 4, static bytes => BinaryPrimitives.ReadUInt32LittleEndian(bytes)),
        new("float", "float32", 4, static bytes => BinaryPrimitives.ReadSingleLittleEndian(bytes)),
        new("double", "float64", 8, BinaryPrimitives.ReadDoubleLittleEndian),
    ];

    /// <summary>Whether its numbers are whole.</summary>
    public bool IsInteger => !SizedName.StartsWith("float", StringComparison.Ordinal);

    /// <summary>Returns the type of a name; null for none.</summary>
    public static PlyType? Find(string name) => Array.Find(All, type => name == type.Name || name == type.SizedName);
}
