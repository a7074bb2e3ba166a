using System.Buffers;
using System.Text.Unicode;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Wavefront;

/// <summary>
/// Cuts the bytes of a file into blocks of whole lines, those that a backslash joins included. A line with a NUL byte may be cut.
/// </summary>
/// <remarks>The length of the file is asked for once: what is written behind it meanwhile is not read.</remarks>
internal sealed class ObjBlockReader
{
    private readonly Stream _stream;
    private readonly string _fileName;
    private readonly int _blockSize;
    private readonly long _start;
    private byte[] _carry = [];
    private int _carryLength;
    private int _blockCount;

    // Position in the file of the first byte that no block has.
    private long _position;

    /// <summary>Begins behind the byte order mark, if there is one.</summary>
    /// <param name="stream">Stream with a length, which can seek.</param>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <param name="blockSize">Usual size of blocks in bytes; a longer line makes a larger one.</param>
    /// <exception cref="SourceException">The file can't be read.</exception>
    public ObjBlockReader(Stream stream, string fileName, int blockSize)
    {
        _stream = stream;
        _fileName = fileName;
        _blockSize = blockSize;
        Length = stream.Length;
        stream.Position = 0;
        var mark = new byte[Math.Min(3, Length)];
        ReadExactly(mark, 0, mark.Length);
        _start = SourceText.MeasureByteOrderMark(mark);
        Seek(_start);
    }

    /// <summary>Size of the file in bytes.</summary>
    public long Length { get; }

    /// <summary>Rents a buffer for blocks of the usual size.</summary>
    public byte[] RentBuffer() => ArrayPool<byte>.Shared.Rent(BufferSize((int)Math.Min(_blockSize, Length)));

    /// <summary>Continues at a position in the file, which must be the beginning or end of a block.</summary>
    public void Seek(long position)
    {
        _stream.Position = position;
        _position = position;
        _carryLength = 0;
    }

    /// <summary>Reads the next block; false at the end of the file.</summary>
    /// <param name="buffer">Receives the block, a line feed and padding. A larger one replaces it where it is too small.</param>
    /// <param name="block">Describes the block.</param>
    /// <exception cref="SourceException">The file can't be read.</exception>
    public bool TryRead(ref byte[] buffer, out ObjBlockBytes block)
    {
        var length = _carryLength;
        Grow(ref buffer, 0, length);
        _carry.AsSpan(0, length).CopyTo(buffer);
        _carryLength = 0;
        var cut = 0;
        for (long target = _blockSize; cut == 0 && length < Length - _position; target = 2L * length)
        {
            var end = (int)Math.Min(Math.Max(target, length + 1L), Length - _position);
            Grow(ref buffer, length, end);
            ReadExactly(buffer, length, end - length);
            var isBinary = buffer.AsSpan(length, end - length).Contains((byte)0);
            length = end;
            cut = length == Length - _position ? length : FindCut(buffer.AsSpan(0, length));
            // A binary file may have no line break at all, and would be taken into memory whole. The caller refuses the block.
            cut = cut == 0 && isBinary ? length : cut;
        }

        Keep(buffer.AsSpan(cut, length - cut));
        block = new(_blockCount++, _position, cut);
        _position += cut;
        if (cut > 0)
        {
            buffer.AsSpan(cut, 1 + Utf8NumberReader.Padding).Fill((byte)'\n');
        }

        return cut > 0;
    }

    /// <summary>Tells whether bytes are text: without NUL, and of which encoding.</summary>
    public static ObjTextKind Classify(ReadOnlySpan<byte> bytes) =>
        bytes.Contains((byte)0) ? ObjTextKind.Binary : Utf8.IsValid(bytes) ? ObjTextKind.Utf8 : ObjTextKind.Latin1;

    /// <summary>Creates the error of the first NUL byte of the file. Reads all before it once more.</summary>
    /// <param name="position">Position of the byte in the file.</param>
    public SourceException CreateNulError(long position)
    {
        Seek(_start);
        var buffer = RentBuffer();
        var lineFeeds = 0;
        var lastLineFeed = _start - 1;
        while (_position < position && TryRead(ref buffer, out var block))
        {
            var before = buffer.AsSpan(0, (int)Math.Min(block.Length, position - block.Position));
            lineFeeds += before.Count((byte)'\n');
            lastLineFeed = before.LastIndexOf((byte)'\n') is >= 0 and var last ? block.Position + last : lastLineFeed;
        }

        ArrayPool<byte>.Shared.Return(buffer);
        return SourceText.NulError(_fileName, lineFeeds, (int)(position - lastLineFeed));
    }

    private static int BufferSize(int length) => length + 1 + Utf8NumberReader.Padding;

    private static void Grow(ref byte[] buffer, int length, int newLength)
    {
        if (buffer.Length >= BufferSize(newLength))
        {
            return;
        }

        var larger = ArrayPool<byte>.Shared.Rent(BufferSize(newLength));
        buffer.AsSpan(0, length).CopyTo(larger);
        ArrayPool<byte>.Shared.Return(buffer);
        buffer = larger;
    }

    /// <summary>Returns the end of the last line that surely ends there, or 0.</summary>
    private static int FindCut(ReadOnlySpan<byte> bytes)
    {
        // What follows a CR at the end is not known yet.
        for (var rest = bytes[^1] == '\r' ? bytes[..^1] : bytes; rest.LastIndexOfAny((byte)'\n', (byte)'\r') is >= 0 and var last;)
        {
            rest = rest[..last];
            if (bytes[last] == '\n' && rest is [.., (byte)'\r'])
            {
                rest = rest[..^1];
            }

            if (rest is not [.., (byte)'\\'])
            {
                return last + 1;
            }
        }

        return 0;
    }

    private void Keep(ReadOnlySpan<byte> bytes)
    {
        if (_carry.Length < bytes.Length)
        {
            _carry = new byte[Math.Max(bytes.Length, 1 << 12)];
        }

        bytes.CopyTo(_carry);
        _carryLength = bytes.Length;
    }

    private void ReadExactly(byte[] buffer, int offset, int count) => SourceText.Access(_fileName, () =>
    {
        _stream.ReadExactly(buffer, offset, count);
        return true;
    });
}
