using System.Buffers;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Wavefront;

/// <content>Parses the lines of vertices, normals and texture coordinates.</content>
public sealed partial class ObjParser
{
    private static readonly SearchValues<char> WordEnds = SearchValues.Create(" \t\r\n#\\");

    /// <summary>Parses x, y and z. A weight, which is ignored, a colour or both may follow.</summary>
    private bool ParsePosition(Cursor cursor, out Cursor rest)
    {
        if (!ParseThreeNumbers(cursor, out var position, out rest))
        {
            return false;
        }

        _elements.AddPosition(position);
        Span<double> numbers = stackalloc double[ObjColour.MaxNumbers];
        ParseOptionalNumbers(rest, numbers, out var count, out rest);
        if (ObjColour.Find(numbers, count) is { Length: > 0 } colour)
        {
            _elements.AddColour(colour);
        }

        return ParseCommentAndEndOfLine(rest, out rest);
    }

    private bool ParseNormal(Cursor cursor, out Cursor rest)
    {
        if (!ParseThreeNumbers(cursor, out var normal, out rest) || !ParseCommentAndEndOfLine(rest, out rest))
        {
            return false;
        }

        _elements.AddNormal(normal);
        return true;
    }

    /// <summary>Parses u and an optional v, 0 by default. An optional w is ignored.</summary>
    private bool ParseTextureCoordinate(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        if (!ParseNumber(rest, out var u, out rest))
        {
            return false;
        }

        var v = 0.0;
        if (ParseBlanks(rest, out var next) && IsNumberStart(next) && ParseNumber(next, out v, out rest))
        {
            ParseOptionalNumbers(rest, [0], out _, out rest);
        }

        _elements.AddTextureCoordinate(u, v);
        return ParseCommentAndEndOfLine(rest, out rest);
    }

    private bool ParseThreeNumbers(Cursor cursor, out Vector numbers, out Cursor rest)
    {
        numbers = default;
        ParseBlanks(cursor, out rest);
        if (!ParseNumber(rest, out var x, out rest) || !ParseBlanks(rest, out rest)
            || !ParseNumber(rest, out var y, out rest) || !ParseBlanks(rest, out rest)
            || !ParseNumber(rest, out var z, out rest))
        {
            return false;
        }

        numbers = new(x, y, z);
        return true;
    }

    /// <summary>Parses any number of numbers. The last element of the span receives all that have no other place.</summary>
    private void ParseOptionalNumbers(Cursor cursor, Span<double> numbers, out int count, out Cursor rest)
    {
        rest = cursor;
        count = 0;
        while (ParseBlanks(rest, out var next) && ParseOptionalNumber(next, out numbers[Math.Min(count, numbers.Length - 1)], out next))
        {
            rest = next;
            count++;
        }
    }

    /// <summary>Parses a number, or one that is undefined, as programs write for colours that they don't know: it counts as 1.</summary>
    private bool ParseOptionalNumber(Cursor cursor, out double number, out Cursor rest)
    {
        number = 1;
        return ParseUndefinedNumber(cursor, out rest) || (IsNumberStart(cursor) && ParseNumber(cursor, out number, out rest));
    }

    private static bool ParseUndefinedNumber(Cursor cursor, out Cursor rest)
    {
        var length = cursor.Rest.IndexOfAny(WordEnds);
        length = length < 0 ? cursor.Rest.Length : length;
        var isUndefined = NumberReader.IsUndefined(cursor.Rest[..length]);
        rest = isUndefined ? cursor.Advance(length) : cursor;
        return isUndefined;
    }

    private static bool IsNumberStart(Cursor cursor) => char.IsAsciiDigit(cursor.Current) || cursor.Current is '-' or '+' or '.';
}
