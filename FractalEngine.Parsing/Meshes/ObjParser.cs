using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Meshes;

/// <summary>
/// Reads Wavefront OBJ meshes (paper §4.1.1): vertices, texture coordinates, normals, polygons of any size, names,
/// groups and materials. Lines and points are passed over, and so are unknown keywords, with one warning.
/// </summary>
/// <remarks>Coordinates are taken as they stand: no axis is flipped. A scan of 100 MB takes about a second.</remarks>
public sealed class ObjParser : Parser
{
    // Progress is reported at most once for so many characters.
    private const int ProgressStep = 1 << 20;

    private readonly ObjMeshBuilder _mesh = new();
    private readonly List<ObjCorner> _corners = [];
    private readonly List<int> _libraryOffsets = [];
    private readonly Dictionary<string, int> _materialOffsets = [];
    private bool _hasDeclaration;
    private int _unknownLines;
    private Cursor? _firstUnknown;
    private int _missingNumbers;
    private (Cursor Place, string What)? _firstMissing;

    private ObjParser(SourceText source)
        : base(source)
    {
    }

    /// <summary>Parses a whole file.</summary>
    /// <param name="source">Its text.</param>
    /// <param name="progress">Told the fraction that is done, from 0 to 1.</param>
    /// <exception cref="SourceException">The text is no OBJ file, or refers to elements that it does not have.</exception>
    public static ObjFile Parse(SourceText source, IProgress<double>? progress = null) => new ObjParser(source).ParseFile(progress);

    /// <inheritdoc/>
    /// <remarks>A backslash before a line break joins two lines.</remarks>
    protected override bool ParseBlanks(Cursor cursor, out Cursor rest)
    {
        base.ParseBlanks(cursor, out rest);
        while (rest.Current == '\\' && rest.Peek(1) is '\n' or '\r')
        {
            base.ParseBlanks(rest.Advance(rest.Peek(1) == '\r' && rest.Peek(2) == '\n' ? 3 : 2), out rest);
        }

        return true;
    }

    private ObjFile ParseFile(IProgress<double>? progress)
    {
        var nextReport = ProgressStep;
        for (var cursor = Source.Start; !cursor.IsAtEnd;)
        {
            if (!ParseLine(cursor, out cursor))
            {
                throw SyntaxError();
            }

            if (cursor.Offset >= nextReport)
            {
                progress?.Report((double)cursor.Offset / Source.Text.Length);
                nextReport = cursor.Offset + ProgressStep;
            }
        }

        progress?.Report(1);
        if (!_hasDeclaration)
        {
            throw Error(Source.Start, "the file declares nothing: it has no vertex, face, group or material");
        }

        return new(_mesh.Build(), Warnings())
        {
            MaterialLibraryOffsets = [.. _libraryOffsets],
            MaterialOffsets = _materialOffsets.ToImmutableDictionary(),
        };
    }

    private ImmutableArray<Diagnostic> Warnings()
    {
        var warnings = ImmutableArray.CreateBuilder<Diagnostic>();
        if (_firstUnknown is { } unknown)
        {
            var all = _unknownLines == 1 ? "" : $" ({_unknownLines} lines with unknown keywords in all)";
            warnings.Add(Source.Diagnose(unknown.Offset, $"unknown keyword {Describe(unknown)} skipped{all}", DiagnosticSeverity.Warning));
        }

        if (_firstMissing is var (place, what))
        {
            var all = _missingNumbers == 1 ? "" : $" ({_missingNumbers} such corners in all)";
            warnings.Add(Source.Diagnose(place.Offset, $"{what}: the corner goes without{all}", DiagnosticSeverity.Warning));
        }

        return warnings.ToImmutable();
    }

    private bool ParseLine(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        return (start.Current, start.Peek(1), start.Peek(2)) switch
        {
            ('v', ' ' or '\t', _) => ParsePosition(start.Advance(1), out rest) && Declare(),
            ('f', ' ' or '\t', _) => ParseFace(start, out rest) && Declare(),
            ('v', 'n', ' ' or '\t') => ParseNormal(start.Advance(2), out rest) && Declare(),
            ('v', 't', ' ' or '\t') => ParseTextureCoordinate(start.Advance(2), out rest) && Declare(),
            _ => ParseOther(start, out rest),
        };
    }

    private bool ParseOther(Cursor start, out Cursor rest)
    {
        if (IsAtEndOfLine(start) || start.Current == '#')
        {
            return ParseLineEnd(start, out rest);
        }

        rest = start;
        if (!char.IsLetter(start.Current) || !ParseName(start, "a keyword", out var keyword, out rest))
        {
            return Fail(start, "a keyword");
        }

        return keyword switch
        {
            "o" => ParseNames(rest, out var name, out rest) && Declare(() => _mesh.ObjectName = name),
            "g" => ParseNames(rest, out var name, out rest) && Declare(() => _mesh.GroupName = name),
            "usemtl" => ParseMaterial(rest, out rest) && Declare(),
            "mtllib" => ParseMaterialLibrary(rest, out rest) && Declare(),
            "s" => ParseSmoothingGroup(rest, out rest) && Declare(),
            "l" or "p" => ParseNames(rest, out _, out rest) && Declare(),
            // A keyword with nothing behind it stands here because the branches above want a blank.
            "v" or "vn" or "vt" => ParseComponents(rest, out _, out rest),
            "f" => ParseFace(start, out rest),
            _ => SkipUnknown(start, out rest),
        };
    }

    private bool ParseMaterial(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        if (!ParseNames(start, out var name, out rest))
        {
            return false;
        }

        _materialOffsets.TryAdd(name, start.Offset);
        _mesh.Material = name;
        return true;
    }

    private bool ParseMaterialLibrary(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        if (!ParseNames(start, out var file, out rest))
        {
            return false;
        }

        if (_mesh.AddMaterialLibrary(file))
        {
            _libraryOffsets.Add(start.Offset);
        }

        return true;
    }

    private bool Declare(Action? effect = null)
    {
        effect?.Invoke();
        return _hasDeclaration = true;
    }

    private bool SkipUnknown(Cursor start, out Cursor rest)
    {
        _firstUnknown ??= start;
        _unknownLines++;
        return ParseNames(start, out _, out rest);
    }

    /// <summary>x y z, then a weight or a colour or both, which are not used.</summary>
    private bool ParsePosition(Cursor cursor, out Cursor rest) =>
        ParseNumbers(cursor, out var position, out rest) && Add(position) && ParseOptionalNumbers(rest, out rest) && ParseLineEnd(rest, out rest);

    private bool Add(Vector position)
    {
        _mesh.AddPosition(position);
        return true;
    }

    private bool ParseNormal(Cursor cursor, out Cursor rest)
    {
        if (!ParseNumbers(cursor, out var normal, out rest) || !ParseLineEnd(rest, out rest))
        {
            return false;
        }

        _mesh.AddNormal(normal);
        return true;
    }

    /// <summary>u, then v (0 if missing) and w, which is not used.</summary>
    private bool ParseTextureCoordinate(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        if (!ParseNumber(rest, out var u, out rest))
        {
            return false;
        }

        var v = 0.0;
        if (ParseBlanks(rest, out var next) && NumberStandsAt(next) && ParseNumber(next, out v, out rest))
        {
            ParseOptionalNumbers(rest, out rest);
        }

        _mesh.AddTextureCoordinate(u, v);
        return ParseLineEnd(rest, out rest);
    }

    private bool ParseNumbers(Cursor cursor, out Vector numbers, out Cursor rest)
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

    private bool ParseOptionalNumbers(Cursor cursor, out Cursor rest)
    {
        rest = cursor;
        while (ParseBlanks(rest, out var next) && NumberStandsAt(next) && ParseNumber(next, out _, out next))
        {
            rest = next;
        }

        return true;
    }

    private static bool NumberStandsAt(Cursor cursor) => char.IsAsciiDigit(cursor.Current) || cursor.Current is '-' or '+' or '.';

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
            throw Error(start, $"a face needs at least three corners, this one has {_corners.Count}");
        }

        if (_corners.Count > ParsingLimits.PolygonCorners)
        {
            throw Error(start, $"the polygon has {_corners.Count} corners, more than the limit of {ParsingLimits.PolygonCorners}", isLimit: true);
        }

        _mesh.AddPolygon(CollectionsMarshal.AsSpan(_corners));
        return ParseLineEnd(rest, out rest);
    }

    /// <summary><c>v</c>, <c>v/vt</c>, <c>v//vn</c> or <c>v/vt/vn</c>.</summary>
    private bool ParseCorner(Cursor cursor, out ObjCorner corner, out Cursor rest)
    {
        var (texture, normal) = (ObjCorner.None, ObjCorner.None);
        corner = default;
        if (!ParseIndex(cursor, "vertex", _mesh.PositionCount, isRequired: true, out var position, out rest))
        {
            return false;
        }

        if (rest.Current == '/')
        {
            rest = rest.Advance(1);
            if (rest.Current != '/' && !ParseIndex(rest, "texture coordinate", _mesh.TextureCoordinateCount, isRequired: false, out texture, out rest))
            {
                return false;
            }

            if (rest.Current == '/' && !ParseIndex(rest.Advance(1), "normal", _mesh.NormalCount, isRequired: false, out normal, out rest))
            {
                return false;
            }
        }

        corner = new(position, texture, normal);
        return IsAtEndOfLine(rest) || rest.Current is ' ' or '\t' or '#' or '\\' || Fail(rest, "a blank");
    }

    /// <summary>A number of an element from 1, or back from the last one as −1; the result counts from 0.</summary>
    private bool ParseIndex(Cursor cursor, string element, int count, bool isRequired, out int index, out Cursor rest)
    {
        var backwards = cursor.Current == '-';
        if (!ParseInteger(backwards ? cursor.Advance(1) : cursor, $"a {element} number", out var number, out rest))
        {
            index = 0;
            return false;
        }

        index = backwards ? count - number : number - 1;
        if (number == 0)
        {
            throw Error(cursor, $"{element} number 0: numbers start at 1");
        }

        if (index >= 0 && index < count)
        {
            return true;
        }

        var written = Written(cursor, rest);
        var message = backwards
            ? $"{element} {written} of {count} so far: it is before the first"
            : $"{element} {written} of {count} so far: it is beyond the last";
        if (isRequired)
        {
            throw Error(cursor, message);
        }

        // A face needs no normals or texture coordinates, and some programs write the numbers of ones that they left out.
        _firstMissing ??= (cursor, message);
        _missingNumbers++;
        index = ObjCorner.None;
        return true;
    }

    private bool ParseSmoothingGroup(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        if (ParseInteger(rest, "a number or 'off'", out var number, out var next) || ParseWord(rest, "off", out next) || ParseWord(rest, "on", out next))
        {
            _mesh.SmoothingGroup = rest.Current == 'o' ? (rest.Peek(1) == 'n' ? 1 : 0) : number;
            return ParseLineEnd(next, out rest);
        }

        return false;
    }

    /// <summary>All to the end of the line or to a comment, blanks at the ends taken off. Names may have blanks in them.</summary>
    private bool ParseNames(Cursor cursor, out string names, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        rest = start;
        while (!IsAtEndOfLine(rest) && !(rest.Current == '#' && rest.Offset > 0 && rest.Peek(-1) is ' ' or '\t'))
        {
            ParseBlanks(rest, out var next);
            rest = next.Offset > rest.Offset ? next : rest.Advance(1);
        }

        names = start.Rest[..(rest.Offset - start.Offset)].Trim().ToString();
        return ParseLineEnd(rest, out rest);
    }

    /// <summary>A comment, if any, and the end of the line.</summary>
    private bool ParseLineEnd(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        if (rest.Current == '#')
        {
            var length = rest.Rest.IndexOfAny('\n', '\r');
            rest = rest.Advance(length < 0 ? rest.Rest.Length : length);
        }

        return ParseEndOfLine(rest, out rest);
    }
}
