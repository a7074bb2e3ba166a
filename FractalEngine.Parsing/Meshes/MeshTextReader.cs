using System.Globalization;
using System.Runtime.InteropServices;
using System.Text;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Reads the words and numbers of PLY and STL text, between which any blanks and line breaks may stand.</summary>
/// <param name="bytes">The file.</param>
internal sealed class MeshTextReader(MeshBytes bytes)
{
    // A word of more characters is cut in messages.
    private const int MaxShownWord = 40;

    /// <summary>Offset in bytes of the next character.</summary>
    public int Position { get; set; }

    /// <summary>Offset in bytes of the word or number read last.</summary>
    public int WordStart { get; private set; }

    /// <summary>Returns whether only blanks are left.</summary>
    public bool IsAtEnd()
    {
        SkipBlanks(areLineBreaksBlank: true);
        return Position >= bytes.Length;
    }

    /// <summary>Reads the next word, whatever it is.</summary>
    /// <param name="expected">What the word should be, for the message.</param>
    /// <exception cref="SourceException">The text ends before it.</exception>
    public ReadOnlySpan<byte> ReadWord(string expected)
    {
        var word = PeekWord();
        Position = WordStart + word.Length;
        return word.Length > 0 ? word : throw Unexpected(expected);
    }

    /// <summary>Reads the next word if it is a given one; upper and lower case are alike.</summary>
    public bool TryReadKeyword(string keyword)
    {
        var word = PeekWord();
        var isKeyword = Ascii.EqualsIgnoreCase(word, keyword);
        Position = isKeyword ? WordStart + word.Length : Position;
        return isKeyword;
    }

    /// <summary>Reads a given word, which must follow.</summary>
    /// <exception cref="SourceException">Another one follows.</exception>
    public void ReadKeyword(string keyword)
    {
        if (!TryReadKeyword(keyword))
        {
            throw Unexpected($"'{keyword}'");
        }
    }

    /// <summary>Reads a number; it is NaN where a program wrote an undefined one.</summary>
    /// <exception cref="SourceException">Something else follows, or a number beyond the range of a double.</exception>
    public double ReadNumber()
    {
        SkipBlanks(areLineBreaksBlank: true);
        WordStart = Position;
        var value = 0.0;
        var end = Utf8NumberReader.Read(ref MemoryMarshal.GetArrayDataReference(bytes.Buffer), Position, ref value);
        if (end == Utf8NumberReader.None || end > bytes.Length || !IsBlank(bytes.Buffer[end]))
        {
            return ReadUnusualNumber();
        }

        Position = (int)end;
        return value;
    }

    /// <summary>Reads a whole number without a sign, up to a limit.</summary>
    /// <exception cref="SourceException">Something else follows, or a larger number.</exception>
    public int ReadCount(string expected, int max)
    {
        var word = ReadWord(expected);
        if (!long.TryParse(word, NumberStyles.None, CultureInfo.InvariantCulture, out var count))
        {
            throw Unexpected(expected);
        }

        return count <= max ? (int)count : throw Error(FormattableString.Invariant($"{count} is more than the limit of {max}"), true);
    }

    /// <summary>Reads the rest of the line, without blanks at its ends.</summary>
    public string ReadRestOfLine()
    {
        SkipBlanks(areLineBreaksBlank: false);
        WordStart = Position;
        var rest = bytes.Contents[Position..];
        var length = rest.IndexOfAny((byte)'\n', (byte)'\r');
        length = length < 0 ? rest.Length : length;
        Position += length;
        return Encoding.UTF8.GetString(rest[..length]).Trim();
    }

    /// <summary>Skips blanks, and requires the line to end there; the rest begins with the next line.</summary>
    /// <exception cref="SourceException">Another word follows.</exception>
    public void ReadEndOfLine()
    {
        SkipBlanks(areLineBreaksBlank: false);
        WordStart = Position;
        if (Position < bytes.Length && bytes.Buffer[Position] is not ((byte)'\n' or (byte)'\r'))
        {
            throw Unexpected("the end of the line");
        }

        var isCrLf = bytes.Contents[Position..].StartsWith("\r\n"u8);
        Position = Math.Min(Position + (isCrLf ? 2 : 1), bytes.Length);
    }

    /// <summary>Creates the error of the word read last.</summary>
    public SourceException Error(string message, bool isLimitExceeded = false) =>
        bytes.TextError(WordStart, message, isLimitExceeded);

    /// <summary>Creates the error of a word that should be something else.</summary>
    public SourceException Unexpected(string expected) => Error($"unexpected {Describe()}, expected {expected}");

    private double ReadUnusualNumber()
    {
        var word = Encoding.Latin1.GetString(PeekWord());
        var isUndefined = NumberReader.IsUndefined(word);
        var value = double.NaN;
        if (!isUndefined && (!NumberReader.TryRead(word, out value, out var length) || length != word.Length))
        {
            throw Unexpected("a number");
        }

        Position = WordStart + word.Length;
        return isUndefined || double.IsFinite(value)
            ? value
            : throw Error($"the number {Describe()[1..^1]} is beyond the range of a double");
    }

    private ReadOnlySpan<byte> PeekWord()
    {
        SkipBlanks(areLineBreaksBlank: true);
        WordStart = Position;
        var end = Position;
        while (end < bytes.Length && !IsBlank(bytes.Buffer[end]))
        {
            end++;
        }

        return bytes.Contents[Position..end];
    }

    private string Describe()
    {
        var rest = bytes.Contents[WordStart..];
        if (rest.IsEmpty)
        {
            return "end of file";
        }

        var length = 0;
        while (length < rest.Length && length < MaxShownWord && !IsBlank(rest[length]))
        {
            length++;
        }

        var word = Encoding.UTF8.GetString(rest[..length]);
        return length == 0 ? "end of line"
            : char.IsControl(word[0]) ? FormattableString.Invariant($"character U+{(int)word[0]:X4}")
            : $"'{string.Concat(word.Select(c => char.IsControl(c) ? '?' : c))}'";
    }

    private static bool IsBlank(byte character) => character is (byte)' ' or (byte)'\t' or (byte)'\n' or (byte)'\r';

    private void SkipBlanks(bool areLineBreaksBlank)
    {
        while (Position < bytes.Length && IsBlank(bytes.Buffer[Position])
            && (areLineBreaksBlank || bytes.Buffer[Position] is (byte)' ' or (byte)'\t'))
        {
            Position++;
        }
    }
}
