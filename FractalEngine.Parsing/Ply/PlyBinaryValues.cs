using System.Buffers.Binary;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Ply;

/// <summary>Reads numbers that are written as bytes.</summary>
internal sealed class PlyBinaryValues(MeshBytes bytes, int start, bool isBigEndian) : PlyValues
{
    private int _position = start;
    private int _valueStart = start;

    /// <inheritdoc/>
    public override long RemainingBytes => bytes.Length - _position;

    /// <inheritdoc/>
    public override double Read(PlyType type)
    {
        _valueStart = _position;
        var size = MinSize(type);
        if (size > RemainingBytes)
        {
            throw Error("the file ends here, expected a number");
        }

        var value = bytes.Buffer.AsSpan(_position, size);
        _position += size;
        return type switch
        {
            PlyType.Int8 => (sbyte)value[0],
            PlyType.UInt8 => value[0],
            PlyType.Int16 => isBigEndian ? BinaryPrimitives.ReadInt16BigEndian(value) : BinaryPrimitives.ReadInt16LittleEndian(value),
            PlyType.UInt16 => isBigEndian ? BinaryPrimitives.ReadUInt16BigEndian(value) : BinaryPrimitives.ReadUInt16LittleEndian(value),
            PlyType.Int32 => isBigEndian ? BinaryPrimitives.ReadInt32BigEndian(value) : BinaryPrimitives.ReadInt32LittleEndian(value),
            PlyType.UInt32 => isBigEndian ? BinaryPrimitives.ReadUInt32BigEndian(value) : BinaryPrimitives.ReadUInt32LittleEndian(value),
            PlyType.Float => isBigEndian ? BinaryPrimitives.ReadSingleBigEndian(value) : BinaryPrimitives.ReadSingleLittleEndian(value),
            _ => isBigEndian ? BinaryPrimitives.ReadDoubleBigEndian(value) : BinaryPrimitives.ReadDoubleLittleEndian(value),
        };
    }

    /// <inheritdoc/>
    public override int MinSize(PlyType type) => type switch
    {
        PlyType.Int8 or PlyType.UInt8 => 1,
        PlyType.Int16 or PlyType.UInt16 => 2,
        PlyType.Double => 8,
        _ => 4,
    };

    /// <inheritdoc/>
    public override SourceException Error(string message, bool isLimitExceeded = false) =>
        bytes.ByteError(_valueStart, message, isLimitExceeded);
}
