using System.Buffers.Binary;
using FractalEngine.Core;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Exports;

/// <summary>Writes numbers of binary formats to a stream through a buffer, the lowest byte first.</summary>
/// <param name="stream">Receives the bytes; left open.</param>
/// <param name="progress">Told the part of all bytes that is written; null for nobody.</param>
/// <param name="total">Number of all bytes.</param>
internal sealed class LittleEndianWriter(Stream stream, IProgress<double>? progress, long total)
{
    // Floats have fewer digits below, and a thousandth of a part of that size is still told.
    private const double MinSize = 1e-34;

    // A tenth of what is so much smaller than its coordinates is still told.
    private const double RelativePrecision = 1e-6;

    private readonly byte[] _buffer = new byte[1 << 18];
    private int _length;
    private long _written;

    /// <summary>Writes bytes as they are, such as a header.</summary>
    public void WriteBytes(ReadOnlySpan<byte> bytes) => bytes.CopyTo(Reserve(bytes.Length));

    /// <summary>Writes a triangle as a list: a byte with the number 3, and three whole numbers of 32 bits.</summary>
    public void WriteTriangle(uint a, uint b, uint c)
    {
        WriteBytes([3]);
        WriteUInt32(a);
        WriteUInt32(b);
        WriteUInt32(c);
    }

    /// <summary>Writes a whole number of 16 bits.</summary>
    public void WriteUInt16(ushort number) => BinaryPrimitives.WriteUInt16LittleEndian(Reserve(sizeof(ushort)), number);

    /// <summary>Writes a whole number of 32 bits.</summary>
    public void WriteUInt32(uint number) => BinaryPrimitives.WriteUInt32LittleEndian(Reserve(sizeof(uint)), number);

    /// <summary>Requires a vector that floats can tell.</summary>
    /// <exception cref="FractalEngineException">A coordinate is beyond the range of a float.</exception>
    public static Vector RequireSingle(Vector vector) => vector.MaxAbsComponent() <= float.MaxValue ? vector
        : throw new FractalEngineException($"a coordinate is beyond the range of a float: {vector}");

    /// <summary>Tells that floats can't tell the parts of a scene, which is too small, or small and far from the origin.</summary>
    public static string[] LossesOf(LoadedScene scene, AffineMap frame)
    {
        var scale = frame.Linear.V1.Length();
        var bounds = scene.Bounds;
        var size = scale * bounds.Diagonal;
        var farthest = scale * Math.Max(bounds.Minimum.MaxAbsComponent(), bounds.Maximum.MaxAbsComponent());
        return !bounds.IsEmpty && size > 0 && size < Math.Max(MinSize, RelativePrecision * farthest)
            ? [FormattableString.Invariant(
                $"floats can't tell the parts of what is {size:G3} units large and up to {farthest:G3} from the origin")]
            : [];
    }

    /// <summary>Writes a number as a float.</summary>
    public void WriteSingle(double number) => BinaryPrimitives.WriteSingleLittleEndian(Reserve(sizeof(float)), (float)number);

    /// <summary>Writes a vector as three floats.</summary>
    /// <exception cref="FractalEngineException">A coordinate is beyond the range of a float.</exception>
    public void WriteSingle(Vector vector)
    {
        var (x, y, z) = RequireSingle(vector);
        WriteSingle(x);
        WriteSingle(y);
        WriteSingle(z);
    }

    /// <summary>Writes a vector as three doubles.</summary>
    /// <exception cref="FractalEngineException">A coordinate is beyond the range of a double.</exception>
    public void WriteDouble(Vector vector)
    {
        if (!vector.IsFinite())
        {
            throw new FractalEngineException("a vertex of an instance is beyond the range of a double");
        }

        var bytes = Reserve(3 * sizeof(double));
        BinaryPrimitives.WriteDoubleLittleEndian(bytes, vector.X);
        BinaryPrimitives.WriteDoubleLittleEndian(bytes[sizeof(double)..], vector.Y);
        BinaryPrimitives.WriteDoubleLittleEndian(bytes[(2 * sizeof(double))..], vector.Z);
    }

    /// <summary>Passes all buffered bytes on to the stream.</summary>
    public void Flush()
    {
        stream.Write(_buffer.AsSpan(0, _length));
        _written += _length;
        _length = 0;
        progress?.Report((double)_written / total);
    }

    /// <summary>Makes room for some bytes, fewer than a thousand, behind those before.</summary>
    private Span<byte> Reserve(int count)
    {
        if (_buffer.Length - _length < count)
        {
            Flush();
        }

        _length += count;
        return _buffer.AsSpan(_length - count, count);
    }
}
