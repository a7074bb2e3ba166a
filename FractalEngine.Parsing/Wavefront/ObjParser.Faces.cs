using System.Runtime.InteropServices;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Wavefront;

/// <content>Parses faces: corners by the numbers of their elements.</content>
public sealed partial class ObjParser
{
    private readonly List<ObjCorner> _corners = [];

    private bool ParseFace(Cursor start, out Cursor rest)
    {
        _corners.Clear();
        rest = start.Advance(1);
        while (ParseBlanks(rest, out rest) && !IsAtEndOfLine(rest) && rest.Current != '#')
        {
            if (!ParseCorner(rest, out var corner, out rest))
            {
                return false;
            }

            _corners.Add(corner);
        }

        if (_corners.Count < 3)
        {
            _contents.AddShortFace(PositionOf(start), _corners.Count);
            return ParseCommentAndEndOfLine(rest, out rest);
        }

        if (_corners.Count > ParsingLimits.MaxPolygonCorners)
        {
            throw Error(start, $"the polygon has {_corners.Count} corners, more than the limit of {ParsingLimits.MaxPolygonCorners}",
                isLimitExceeded: true);
        }

        _elements.AddPolygon(CollectionsMarshal.AsSpan(_corners));
        return ParseCommentAndEndOfLine(rest, out rest);
    }

    /// <summary>
    /// Parses one corner of a face: <c>v</c>, <c>v/vt</c>, <c>v//vn</c> or <c>v/vt/vn</c>. Nothing behind a slash means none.
    /// </summary>
    private bool ParseCorner(Cursor cursor, out ObjCorner corner, out Cursor rest)
    {
        var texture = ObjCorner.None;
        var normal = ObjCorner.None;
        corner = default;
        if (!ParseIndex(cursor, "vertex", _elements.PositionCount, isRequired: true, out var position, out rest))
        {
            return false;
        }

        if (rest.Current == '/')
        {
            rest = rest.Advance(1);
            if (rest.Current != '/' && !IsAtEndOfCorner(rest)
                && !ParseIndex(rest, "texture coordinate", _elements.TextureCoordinateCount, isRequired: false, out texture, out rest))
            {
                return false;
            }

            if (rest.Current == '/')
            {
                rest = rest.Advance(1);
                if (!IsAtEndOfCorner(rest)
                    && !ParseIndex(rest, "normal", _elements.NormalCount, isRequired: false, out normal, out rest))
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
        if (isRequired)
        {
            throw Error(cursor, message);
        }

        // A face can do without normals or texture coordinates, and some programs write numbers of ones that they omit.
        _contents.AddInvalidIndex(PositionOf(cursor), message);
        index = ObjCorner.None;
        return true;
    }
}
