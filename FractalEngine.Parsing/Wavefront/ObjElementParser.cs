using System.Buffers;
using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Wavefront;

/// <summary>Parses the elements of OBJ files: vertices, normals, texture coordinates, and faces by the numbers of these.</summary>
public abstract class ObjElementParser : Parser
{
    private static readonly SearchValues<char> WordEnds = SearchValues.Create(" \t\r\n#\\");

    private readonly ElementCounts _before;
    private readonly List<PolygonCorner> _corners = [];

    private protected ObjElementParser(SourceText source, ObjContents contents, ElementCounts before)
        : base(source)
    {
        Contents = contents;
        _before = before;
    }

    /// <summary>What the file has declared so far.</summary>
    private protected ObjContents Contents { get; }

    /// <summary>The elements of this text.</summary>
    private protected MeshBlockBuilder Elements { get; } = new();

    /// <summary>Numbers of elements in the file so far.</summary>
    private protected ElementCounts Counts => _before + Elements.Counts;

    /// <inheritdoc/>
    /// <remarks>A backslash before a line break joins two lines.</remarks>
    protected sealed override bool ParseBlanks(Cursor cursor, out Cursor rest)
    {
        base.ParseBlanks(cursor, out rest);
        while (rest.Current == '\\' && rest.Peek(1) is '\n' or '\r')
        {
            base.ParseBlanks(rest.Advance(rest.Peek(1) == '\r' && rest.Peek(2) == '\n' ? 3 : 2), out rest);
        }

        return true;
    }

    /// <summary>Parses x, y and z. A weight, which is ignored, a colour or both may follow.</summary>
    private protected bool ParsePosition(Cursor cursor, out Cursor rest)
    {
        if (!ParseThreeNumbers(cursor, out var position, out rest))
        {
            return false;
        }

        Span<double> numbers = stackalloc double[VertexColour.MaxNumbers];
        ParseOptionalNumbers(rest, numbers, out var count, out rest);
        if (VertexColour.Find(numbers, count) is { Length: > 0 } colour)
        {
            Elements.AddColour(colour);
        }

        Elements.AddPosition(position);
        return ParseCommentAndEndOfLine(rest, out rest);
    }

    private protected bool ParseNormal(Cursor cursor, out Cursor rest)
    {
        if (!ParseThreeNumbers(cursor, out var normal, out rest) || !ParseCommentAndEndOfLine(rest, out rest))
        {
            return false;
        }

        Elements.AddNormal(normal);
        return true;
    }

    /// <summary>Parses u and an optional v, 0 by default. An optional w is ignored.</summary>
    private protected bool ParseTextureCoordinate(Cursor cursor, out Cursor rest)
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

        Elements.AddTextureCoordinate(u, v);
        return ParseCommentAndEndOfLine(rest, out rest);
    }

    private bool ParseThreeNumbers(Cursor cursor, out Vector numbers, out Cursor rest)
    {
        numbers = default;
        ParseBlanks(cursor, out rest);
        return ParseNumber(rest, out var x, out rest) && ParseBlanks(rest, out rest)
            && ParseNumber(rest, out var y, out rest) && ParseBlanks(rest, out rest)
            && ParseNumber(rest, out var z, out rest) && Set(ref numbers, new(x, y, z));
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

    private protected bool ParseFace(Cursor start, out Cursor rest)
    {
        var counts = Counts;
        _corners.Clear();
        rest = start.Advance(1);
        while (ParseBlanks(rest, out rest) && !IsAtEndOfLine(rest) && rest.Current != '#')
        {
            if (!ParseCorner(rest, counts, out var corner, out rest))
            {
                return false;
            }

            _corners.Add(corner);
        }

        if (_corners.Count < 3)
        {
            Contents.ShortFaces.Add(
                PositionOf(start), $"a face needs at least three corners, this one has {_corners.Count}: skipped");
            return ParseCommentAndEndOfLine(rest, out rest);
        }

        if (_corners.Count > ParsingLimits.PolygonCorners.Value)
        {
            throw Error(start, $"the polygon has {_corners.Count} corners, more than the limit of {ParsingLimits.PolygonCorners.Value}",
                isLimitExceeded: true);
        }

        Elements.AddPolygon(CollectionsMarshal.AsSpan(_corners));
        return ParseCommentAndEndOfLine(rest, out rest);
    }

    /// <summary>
    /// Parses one corner of a face: <c>v</c>, <c>v/vt</c>, <c>v//vn</c> or <c>v/vt/vn</c>. Nothing behind a slash means none.
    /// </summary>
    private bool ParseCorner(Cursor cursor, ElementCounts counts, out PolygonCorner corner, out Cursor rest)
    {
        var texture = PolygonCorner.None;
        var normal = PolygonCorner.None;
        corner = default;
        if (!ParseIndex(cursor, "vertex", counts.Positions, isRequired: true, out var position, out rest))
        {
            return false;
        }

        if (rest.Current == '/')
        {
            rest = rest.Advance(1);
            if (rest.Current != '/' && !IsAtEndOfCorner(rest)
                && !ParseIndex(rest, "texture coordinate", counts.TextureCoordinates, isRequired: false, out texture, out rest))
            {
                return false;
            }

            if (rest.Current == '/')
            {
                rest = rest.Advance(1);
                if (!IsAtEndOfCorner(rest)
                    && !ParseIndex(rest, "normal", counts.Normals, isRequired: false, out normal, out rest))
                {
                    return false;
                }
            }
        }

        corner = new(position, texture, normal);
        return IsAtEndOfCorner(rest) || Fail(rest, "a blank");
    }

    private static bool IsAtEndOfCorner(Cursor cursor) => IsAtEndOfLine(cursor) || cursor.Current is ' ' or '\t' or '#' or '\\';

    /// <summary>Parses the number of an element: from 1 upwards, or from −1 backwards. The resulting index counts from 0.</summary>
    private bool ParseIndex(Cursor cursor, string elementName, int count, bool isRequired, out int index, out Cursor rest)
    {
        var isRelative = cursor.Current == '-';
        if (!ParseInteger(isRelative ? cursor.Advance(1) : cursor, $"a {elementName} number", out var number, out rest))
        {
            index = 0;
            return false;
        }

        index = isRelative ? count - number : number - 1;
        if (number == 0)
        {
            throw Error(cursor, $"{elementName} number 0: numbers start at 1");
        }

        if (index >= 0 && index < count)
        {
            return true;
        }

        var written = TextBetween(cursor, rest);
        var message = isRelative
            ? $"{elementName} {written} of {count} so far: it is before the first"
            : $"{elementName} {written} of {count} so far: it is beyond the last";
        ThrowIf(isRequired, cursor, message);
        // A face can do without normals or texture coordinates, and some programs write numbers of ones that they omit.
        Contents.InvalidIndices.Add(PositionOf(cursor), $"{message}: the index is ignored");
        index = PolygonCorner.None;
        return true;
    }

    private protected SourcePosition PositionOf(Cursor cursor) => new(Source, cursor.Offset);
}
