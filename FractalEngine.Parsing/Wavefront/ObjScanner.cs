using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Wavefront;

/// <summary>
/// The fast kernel of <see cref="ObjParser"/>: reads the plain lines of a block of bytes, and stops at the first line that is not plain,
/// be it wrong or only unusual.
/// </summary>
/// <remarks>
/// Plain are elements with finite numbers, in ASCII, without joined lines; comments; and all statements with names, which are only found
/// here. What comes before the block need not be known: <see cref="Required"/> tells which indices exist. One instance is used for one
/// block after the other.
/// </remarks>
internal sealed partial class ObjScanner
{
    private double[] _positions = [];
    private double[] _colours = [];
    private double[] _textureCoordinates = [];
    private double[] _normals = [];
    private int[] _positionIndices = [];
    private int[] _textureIndices = [];
    private int[] _normalIndices = [];
    private ushort[] _polygonSizes = [];

    private int _end;
    private int _positionCount;
    private int _textureCoordinateCount;
    private int _normalCount;
    private int _cornerCount;
    private int _polygonCount;
    private int _faceCount;

    // Vertices below have entries in the array of colours; 0 until a vertex has any.
    private int _colourCount;

    // Corners below have entries in the arrays of texture coordinates and normals; 0 until a corner has any.
    private int _textureIndexCount;
    private int _normalIndexCount;
    private bool _hasPolygonSizes;
    private bool _hasRelativeIndices;
    private int _requiredPositions;
    private int _requiredTextureCoordinates;
    private int _requiredNormals;

    /// <summary>Offset of the first line that is not plain, or the length of the block.</summary>
    public int ScannedLength { get; private set; }

    /// <summary>Statements with names, in order.</summary>
    public List<ObjStatement> Statements { get; } = [];

    /// <summary>Whether there is a line that declares something, other than <see cref="Statements"/>.</summary>
    public bool HasDeclaration { get; private set; }

    /// <summary>Number of line breaks before the end of the scanned lines.</summary>
    public int LineCount { get; private set; }

    /// <summary>Numbers of elements that must come before the block, or some index does not exist.</summary>
    public ObjCounts Required => new(_requiredPositions, _requiredTextureCoordinates, _requiredNormals, 0);

    /// <summary>Reads the plain lines at the beginning of a block.</summary>
    /// <param name="bytes">The block, and behind it a line feed and the padding of <see cref="Utf8NumberReader"/>.</param>
    /// <param name="length">Length of the block.</param>
    public void Scan(byte[] bytes, int length)
    {
        Restart(length);
        ScannedLength = Math.Min((int)ScanLines(ref MemoryMarshal.GetArrayDataReference(bytes)), length);
        HasDeclaration |= _positionCount > 0 || _textureCoordinateCount > 0 || _normalCount > 0 || _polygonCount > 0;
    }

    /// <summary>Creates a block of all elements that were read.</summary>
    public ObjBlock ToBlock()
    {
        FillColours();
        FillIndices(_textureIndices, ref _textureIndexCount);
        FillIndices(_normalIndices, ref _normalIndexCount);
        return new()
        {
            Counts = new(_positionCount, _textureCoordinateCount, _normalCount, _faceCount),
            Positions = Copy(_positions, 3 * _positionCount),
            Colours = Copy(_colours, 3 * _colourCount),
            TextureCoordinates = Copy(_textureCoordinates, 2 * _textureCoordinateCount),
            Normals = Copy(_normals, 3 * _normalCount),
            PositionIndices = Copy(_positionIndices, _cornerCount),
            TextureIndices = Copy(_textureIndices, _textureIndexCount),
            NormalIndices = Copy(_normalIndices, _normalIndexCount),
            PolygonSizes = Copy(_polygonSizes, _hasPolygonSizes ? _polygonCount : 0),
            HasRelativeIndices = _hasRelativeIndices,
        };
    }

    private static T[] Copy<T>(T[] buffer, int length)
    {
        if (length == 0)
        {
            return [];
        }

        var array = GC.AllocateUninitializedArray<T>(length);
        buffer.AsSpan(0, length).CopyTo(array);
        return array;
    }

    /// <summary>Makes a buffer large enough; what it holds is lost.</summary>
    private static void Resize<T>(ref T[] buffer, int length)
    {
        if (buffer.Length < length)
        {
            buffer = GC.AllocateUninitializedArray<T>(length);
        }
    }

    /// <summary>Clears all counts, and makes room for the largest number of elements that so many bytes can hold.</summary>
    private void Restart(int length)
    {
        // The shortest lines are "v 0 0 0", "vt 0", "vn 0 0 0" and "f 1 1 1" with a line break, the shortest corner " 1".
        Resize(ref _positions, 3 * ((length / 8) + 2));
        Resize(ref _textureCoordinates, 2 * ((length / 5) + 2));
        Resize(ref _normals, 3 * ((length / 9) + 2));
        Resize(ref _positionIndices, (length / 2) + 2);
        Resize(ref _textureIndices, (length / 2) + 2);
        Resize(ref _normalIndices, (length / 2) + 2);
        Resize(ref _polygonSizes, (length / 8) + 2);
        Statements.Clear();
        _end = length;
        HasDeclaration = _hasPolygonSizes = _hasRelativeIndices = false;
        LineCount = 0;
        _colourCount = _positionCount = _textureCoordinateCount = _normalCount = 0;
        _cornerCount = _polygonCount = _faceCount = _textureIndexCount = _normalIndexCount = 0;
        _requiredPositions = _requiredTextureCoordinates = _requiredNormals = 0;
    }

    /// <summary>Reads lines, and returns the position of the first that is not plain, or one that is not before the end.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private nint ScanLines(ref byte text)
    {
        nint end = _end;
        nint line = 0;
        while (line < end)
        {
            var start = line;
            while (Unsafe.Add(ref text, start) is (byte)' ' or (byte)'\t')
            {
                start++;
            }

            uint first = Unsafe.Add(ref text, start);
            uint second = Unsafe.Add(ref text, start + 1);
            nint next;
            if (first == 'v' && IsBlank(second))
            {
                next = ScanPosition(ref text, start + 1);
            }
            else if (first == 'f' && IsBlank(second))
            {
                next = ScanFace(ref text, start + 1);
            }
            else if (first == 'v' && second == 't' && IsBlank(Unsafe.Add(ref text, start + 2)))
            {
                next = ScanTextureCoordinate(ref text, start + 2);
            }
            else if (first == 'v' && second == 'n' && IsBlank(Unsafe.Add(ref text, start + 2)))
            {
                next = ScanNormal(ref text, start + 2);
            }
            else
            {
                next = ScanOther(ref text, line, start);
            }

            if (next == Utf8NumberReader.None)
            {
                return line;
            }

            LineCount++;
            line = next;
        }

        return line;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static bool IsBlank(uint character) => character is ' ' or '\t';

    /// <summary>Skips blanks, a comment and a line break, and returns the position of the next line or none.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private nint ScanEndOfLine(ref byte text, nint position) =>
        Unsafe.Add(ref text, position) == '\n' ? position + 1 : ScanUnusualEndOfLine(ref text, position);

    private nint ScanUnusualEndOfLine(ref byte text, nint position)
    {
        while (IsBlank(Unsafe.Add(ref text, position)))
        {
            position++;
        }

        return (char)Unsafe.Add(ref text, position) switch
        {
            '\n' => position + 1,
            '\r' => SkipLineBreak(ref text, position),
            '#' => SkipLineBreak(ref text, FindLineBreak(ref text, position)),
            _ => Utf8NumberReader.None,
        };
    }

    private nint FindLineBreak(ref byte text, nint position)
    {
        var rest = MemoryMarshal.CreateReadOnlySpan(ref Unsafe.Add(ref text, position), _end - (int)position);
        var length = rest.IndexOfAny((byte)'\n', (byte)'\r');
        return length < 0 ? _end : position + length;
    }

    private static nint SkipLineBreak(ref byte text, nint position) =>
        position + (Unsafe.Add(ref text, position) == '\r' && Unsafe.Add(ref text, position + 1) == '\n' ? 2 : 1);

    /// <summary>Skips an empty line, a comment or a statement, and returns the position of the next line or none.</summary>
    private nint ScanOther(ref byte text, nint line, nint start)
    {
        var first = (char)Unsafe.Add(ref text, start);
        if (!char.IsAsciiLetter(first))
        {
            return ScanUnusualEndOfLine(ref text, start);
        }

        var end = FindLineBreak(ref text, start);
        var keyword = start + 1;
        while (Unsafe.Add(ref text, keyword) is var c && (char.IsAsciiLetterOrDigit((char)c) || c == '_'))
        {
            keyword++;
        }

        // The line may be joined with the next, and the keyword may continue in another alphabet.
        if (Unsafe.Add(ref text, end - 1) == '\\' || Unsafe.Add(ref text, keyword) >= 0x80)
        {
            return Utf8NumberReader.None;
        }

        var next = SkipLineBreak(ref text, end);
        switch (MemoryMarshal.CreateReadOnlySpan(ref Unsafe.Add(ref text, start), (int)(keyword - start)))
        {
            case [(byte)'v' or (byte)'f'] or [(byte)'v', (byte)'t' or (byte)'n']:
                return Utf8NumberReader.None;
            case [(byte)'l' or (byte)'p']:
                HasDeclaration = true;
                return next;
            default:
                Statements.Add(new((int)line, (int)(Math.Min(next, _end) - line), LineCount, _faceCount));
                return next;
        }
    }
}
