using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Wavefront;

/// <summary>
/// The fast kernel of <see cref="ObjParser"/>: reads the plain lines of a block of bytes, and stops at the first line that is not plain,
/// be it wrong or only unusual.
/// </summary>
/// <remarks>
/// Plain are elements with finite numbers, in ASCII, without joined lines; comments; and all statements with names, which are only found
/// here. What comes before the block need not be known: <see cref="ObjElementScanner.Required"/> tells which indices exist. One
/// instance is used for one block after the other.
/// </remarks>
internal sealed class ObjScanner : ObjElementScanner
{
    /// <summary>Offset of the first line that is not plain, or the length of the block.</summary>
    public int ScannedLength { get; private set; }

    /// <summary>Statements with names, in order.</summary>
    public List<ObjStatement> Statements { get; } = [];

    /// <summary>Whether there is a line that declares something, other than <see cref="Statements"/>.</summary>
    public bool HasDeclaration { get; private set; }

    /// <summary>Number of line breaks before the end of the scanned lines.</summary>
    public int LineCount { get; private set; }

    /// <summary>Reads the plain lines at the beginning of a block.</summary>
    /// <param name="bytes">The block, and behind it a line feed and the padding of <see cref="Utf8NumberReader"/>.</param>
    /// <param name="length">Length of the block.</param>
    public void Scan(byte[] bytes, int length)
    {
        Restart(Math.Max(length, Math.Min(bytes.Length, ObjReader.DefaultBlockSize)), length);
        Statements.Clear();
        (HasDeclaration, LineCount) = (false, 0);
        ScannedLength = Math.Min((int)ScanLines(ref MemoryMarshal.GetArrayDataReference(bytes)), length);
        HasDeclaration |= _positionCount > 0 || _textureCoordinateCount > 0 || _normalCount > 0 || _polygonCount > 0;
    }

    /// <summary>Reads lines, and returns the position of the first that is not plain, or one that is not before the end.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private nint ScanLines(ref byte text)
    {
        nint end = End;
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
                Statements.Add(new((int)line, (int)(Math.Min(next, End) - line), LineCount, _faceCount));
                return next;
        }
    }
}
