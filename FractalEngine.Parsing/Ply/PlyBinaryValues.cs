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
        if (type.Size > RemainingBytes)
        {
            throw Error("the file ends here, expected a number");
        }

        Span<byte> value = stackalloc byte[sizeof(double)];
        value = value[..type.Size];
        bytes.Contents.Slice(_position, type.Size).CopyTo(value);
        _position += type.Size;
        if (isBigEndian)
        {
            value.Reverse();
        }

        return type.Decode(value);
    }

    /// <inheritdoc/>
    public override int MinSize(PlyType type) => type.Size;

    /// <inheritdoc/>
    public override SourceException Error(string message, bool isLimitExceeded = false) =>
        bytes.ByteError(_valueStart, message, isLimitExceeded);
}
