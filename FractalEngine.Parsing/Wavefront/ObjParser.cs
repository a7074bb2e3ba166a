using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Wavefront;

/// <summary>
/// The grammar of Wavefront OBJ meshes (paper §4.1.1): vertices, texture coordinates, normals, polygons of any size, names,
/// groups and materials. Lines, points and unknown keywords are ignored, the latter with one warning.
/// </summary>
/// <remarks>
/// Coordinates are used as written: no axis is flipped. Cost: about a second per 100 MB. For files there is <see cref="ObjReader"/>, whose
/// kernel reads plain lines, and which calls this parser for all others.
/// </remarks>
public sealed class ObjParser : ObjElementParser
{
    // Characters between two reports of progress, at least.
    private const int ProgressInterval = 1 << 20;

    private ObjParser(SourceText source, ObjContents contents, ElementCounts before)
        : base(source, contents, before)
    {
    }

    /// <summary>Parses a whole OBJ file.</summary>
    /// <param name="source">Text of the file.</param>
    /// <param name="progress">Receives the fraction that is done, from 0 to 1.</param>
    /// <exception cref="SourceException">The text is not an OBJ file, or refers to elements that don't exist.</exception>
    public static ParsedObj Parse(SourceText source, IProgress<double>? progress = null)
    {
        var contents = new ObjContents();
        ParseLines(source, contents, progress);
        progress?.Report(1);
        return contents.HasDeclaration ? contents.Complete(threadCount: 1, source.ByteCount) : throw EmptyError(source);
    }

    /// <summary>Parses some lines and adds what they declare.</summary>
    internal static void ParseLines(SourceText source, ObjContents contents, IProgress<double>? progress = null)
    {
        var parser = new ObjParser(source, contents, contents.Counts);
        parser.ParseLines(progress);
        contents.Add(parser.Elements.ToBlock());
    }

    /// <summary>Parses a line that has no vertex, texture coordinate, normal or face.</summary>
    /// <param name="source">Text of the line.</param>
    /// <param name="contents">Receives what the line declares.</param>
    /// <param name="before">Has the number of faces before the line.</param>
    internal static void ParseStatement(SourceText source, ObjContents contents, ElementCounts before) =>
        new ObjParser(source, contents, before).ParseLines(null);

    /// <summary>Creates the error of a file that declares nothing.</summary>
    /// <param name="source">The beginning of the file: at least its first line.</param>
    internal static SourceException EmptyError(SourceText source) =>
        source.Error(0, "the file declares nothing: it has no vertex, face, group or material");

    private void ParseLines(IProgress<double>? progress)
    {
        var nextReport = ProgressInterval;
        for (var cursor = Source.Start; !cursor.IsAtEnd;)
        {
            if (!ParseLine(cursor, out cursor))
            {
                throw SyntaxError();
            }

            if (cursor.Offset >= nextReport)
            {
                progress?.Report((double)cursor.Offset / Source.Text.Length);
                nextReport = cursor.Offset + ProgressInterval;
            }
        }
    }

    private bool ParseLine(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        return (start.Current, start.Peek(1), start.Peek(2)) switch
        {
            ('v', ' ' or '\t', _) => ParsePosition(start.Advance(1), out rest) && MarkDeclared(),
            ('f', ' ' or '\t', _) => ParseFace(start, out rest) && MarkDeclared(),
            ('v', 'n', ' ' or '\t') => ParseNormal(start.Advance(2), out rest) && MarkDeclared(),
            ('v', 't', ' ' or '\t') => ParseTextureCoordinate(start.Advance(2), out rest) && MarkDeclared(),
            _ => ParseOtherStatement(start, out rest),
        };
    }

    private bool ParseOtherStatement(Cursor start, out Cursor rest)
    {
        if (IsAtEndOfLine(start) || start.Current == '#')
        {
            return ParseCommentAndEndOfLine(start, out rest);
        }

        rest = start;
        if (!char.IsLetter(start.Current) || !ParseName(start, "a keyword", out var keyword, out rest))
        {
            return Fail(start, "a keyword");
        }

        return keyword switch
        {
            "o" => ParseDeclaredName(rest, (name, _) => Contents.Groups.ChangeObject(name, Counts.Faces), out rest),
            "g" => ParseDeclaredName(rest, (name, _) => Contents.Groups.ChangeGroup(name, Counts.Faces), out rest),
            "usemtl" => ParseDeclaredName(rest, UseMaterial, out rest),
            "mtllib" => ParseDeclaredName(rest, (file, start) => Contents.AddMaterialLibrary(file, PositionOf(start)), out rest),
            "s" => ParseSmoothingGroup(rest, out rest) && MarkDeclared(),
            "l" or "p" => ParseRestOfLine(rest, out _, out rest) && MarkDeclared(),
            // These keywords come here only without a blank behind them, since ParseLine handles all others.
            "v" or "vn" or "vt" => ParseComponents(rest, out _, out rest),
            "f" => ParseFace(start, out rest) && MarkDeclared(),
            _ => SkipUnknown(start, out rest),
        };
    }

    /// <summary>Parses a name up to the end of the line, and uses it together with the place where it stands.</summary>
    private bool ParseDeclaredName(Cursor cursor, Action<string, Cursor> use, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        if (!ParseRestOfLine(start, out var name, out rest))
        {
            return false;
        }

        use(name, start);
        return MarkDeclared();
    }

    private void UseMaterial(string name, Cursor start)
    {
        Contents.AddMaterial(name, PositionOf(start));
        Contents.Groups.ChangeMaterial(name, Counts.Faces);
    }

    private bool MarkDeclared() => Contents.HasDeclaration = true;

    private bool SkipUnknown(Cursor start, out Cursor rest)
    {
        Contents.UnknownLines.Add(PositionOf(start), $"unknown keyword {Describe(start)} skipped");
        return ParseRestOfLine(start, out _, out rest);
    }

    private bool ParseSmoothingGroup(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        if (ParseInteger(rest, "a number or 'off'", out var number, out var next) || ParseWord(rest, "off", out next)
            || ParseWord(rest, "on", out next))
        {
            var isOn = rest.Current == 'o' && rest.Peek(1) == 'n';
            Contents.Groups.ChangeSmoothing(isOn ? 1 : number, Counts.Faces);
            return ParseCommentAndEndOfLine(next, out rest);
        }

        return false;
    }

    /// <summary>Parses a text that may contain blanks, up to the end of the line or to a comment.</summary>
    private bool ParseRestOfLine(Cursor cursor, out string text, out Cursor rest)
    {
        text = ReadRestOfLine(cursor, out rest);
        return ParseCommentAndEndOfLine(rest, out rest);
    }
}
