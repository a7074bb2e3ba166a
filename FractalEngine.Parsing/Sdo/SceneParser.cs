using System.Collections.Immutable;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Reads scene files (paper §4.1.5). Their grammar is in docs/manual.md.</summary>
public sealed class SceneParser : FilmParser
{
    // Faulty lines that are told together, see Parse.
    private const int MaxFaults = 100;

    // In the order in which messages list them.
    private static readonly (string Keyword, SceneDeclarationKind Kind, DeclarationParser Parse)[] Declarations =
    [
        ("c", SceneDeclarationKind.Camera, static (parser, cursor, out rest) => parser.ParseCamera(cursor, out rest)),
        ("o", SceneDeclarationKind.SceneObject, static (parser, cursor, out rest) => parser.ParseObject(cursor, out rest)),
        ("p", SceneDeclarationKind.SceneObject, static (parser, cursor, out rest) => parser.ParsePhysicsObject(cursor, out rest)),
        ("handed", SceneDeclarationKind.Handedness, static (parser, cursor, out rest) => parser.ParseHandedness(cursor, out rest)),
        ("projection", SceneDeclarationKind.Projection, static (parser, cursor, out rest) => parser.ParseProjection(cursor, out rest)),
        ("aspect", SceneDeclarationKind.Aspect, static (parser, cursor, out rest) => parser.ParseAspect(cursor, out rest)),
        ("clip", SceneDeclarationKind.Clip, static (parser, cursor, out rest) => parser.ParseClip(cursor, out rest)),
        ("background", SceneDeclarationKind.Background, static (parser, cursor, out rest) => parser.ParseBackground(cursor, out rest)),
        ("light", SceneDeclarationKind.Light, static (parser, cursor, out rest) => parser.ParseLight(cursor, out rest)),
        ("sun", SceneDeclarationKind.Light, static (parser, cursor, out rest) => parser.ParseSun(cursor, out rest)),
        ("sky", SceneDeclarationKind.Sky, static (parser, cursor, out rest) => parser.ParseSky(cursor, out rest)),
        ("probe", SceneDeclarationKind.Probe, static (parser, cursor, out rest) => parser.ParseProbe(cursor, out rest)),
        ("exposure", SceneDeclarationKind.Exposure, static (parser, cursor, out rest) => parser.ParseExposure(cursor, out rest)),
        ("tone", SceneDeclarationKind.Tone, static (parser, cursor, out rest) => parser.ParseTone(cursor, out rest)),
        ("fog", SceneDeclarationKind.Fog, static (parser, cursor, out rest) => parser.ParseFog(cursor, out rest)),
        ("gravity", SceneDeclarationKind.Gravity, static (parser, cursor, out rest) => parser.ParseGravity(cursor, out rest)),
        ("player", SceneDeclarationKind.Player, static (parser, cursor, out rest) => parser.ParsePlayer(cursor, out rest)),
        ("film", SceneDeclarationKind.Film, static (parser, cursor, out rest) => parser.ParseFilm(cursor, out rest)),
        ("at", SceneDeclarationKind.FilmKey, static (parser, cursor, out rest) => parser.ParseKey(cursor, out rest)),
    ];

    private readonly Dictionary<SceneDeclarationKind, int> _declarationOffsets = [];

    private SceneParser(SourceText source)
        : base(source)
    {
    }

    private delegate bool DeclarationParser(SceneParser parser, Cursor cursor, out Cursor rest);

    /// <summary>The words of all declarations that a scene has at most once.</summary>
    internal static IEnumerable<string> UniqueKeywords =>
        Declarations.Where(static row => IsUnique(row.Kind)).Select(static row => row.Keyword);

    /// <summary>Parses a whole scene file. The files that it names are not read.</summary>
    /// <exception cref="SourceException">The text is not a scene, or has no valid meaning.</exception>
    public static ParsedScene Parse(SourceText source) => new SceneParser(source).ParseFile(null);

    /// <summary>Parses a whole scene file without its faulty lines, to find the faults of them all.</summary>
    /// <param name="source">Text of the file.</param>
    /// <param name="faults">Receives the faults, a hundred at most: finding its line takes a search for each.</param>
    /// <exception cref="SourceException">The file has more lines than the limit.</exception>
    internal static ParsedScene Parse(SourceText source, ICollection<Diagnostic> faults) => new SceneParser(source).ParseFile(faults);

    private ParsedScene ParseFile(ICollection<Diagnostic>? faults)
    {
        // Arrays that grow would be several times as large.
        Objects.EnsureCapacity((int)Math.Min(ParsingLimits.SceneLines.Value, Source.Text.AsSpan().Count('\n') + 1));
        var lines = ImmutableArray.CreateBuilder<SceneLine>(Objects.Capacity);
        for (var cursor = Source.Start; !cursor.IsAtEnd;)
        {
            if (lines.Count >= ParsingLimits.SceneLines.Value)
            {
                throw Error(cursor, $"the scene has more than the limit of {ParsingLimits.SceneLines.Value} lines", isLimitExceeded: true);
            }

            if (!TryParseLine(cursor, faults, out var kind, out var rest))
            {
                if (faults is { Count: >= MaxFaults })
                {
                    break;
                }

                cursor = SkipLine(cursor);
                continue;
            }

            var text = Source.Text.AsMemory(cursor.Offset, rest.Offset - cursor.Offset);
            var index = kind is { } declared ? IndexOfLast(declared) : 0;
            lines.Add(new(text, kind, index, kind is SceneDeclarationKind.SceneObject or SceneDeclarationKind.Sky ? FileNameOffset : 0));
            cursor = rest;
        }

        if (lines.All(line => line.Kind is null) && faults is null or { Count: 0 })
        {
            throw Error(Source.Start, "the scene declares nothing: it has no camera, object or light");
        }

        var scene = Scene with { Camera = TurnToTarget(Scene.Camera), Lights = [.. Lights], Objects = [.. Objects] };
        scene = scene with { Film = scene.Film is { } film ? film with { Keys = [.. Keys] } : null };
        return new(Source, scene, lines.DrainToImmutable()) { Warnings = Hints };
    }

    /// <summary>Parses a line. A fault is thrown, or added to a list that takes it; then nothing of the line is declared.</summary>
    private bool TryParseLine(Cursor cursor, ICollection<Diagnostic>? faults, out SceneDeclarationKind? kind, out Cursor rest)
    {
        var (objectCount, lightCount, keyCount) = (Objects.Count, Lights.Count, Keys.Count);
        try
        {
            return ParseLine(cursor, out kind, out rest) ? true : throw SyntaxError();
        }
        catch (SourceException exception) when (faults is not null)
        {
            var isLast = faults.Count + 1 >= MaxFaults;
            faults.Add(exception.Diagnostic with
            {
                Message = exception.Diagnostic.Message + (isLast ? $" (after {MaxFaults} faulty lines the rest is not read)" : ""),
            });
            Objects.RemoveRange(objectCount, Objects.Count - objectCount);
            Lights.RemoveRange(lightCount, Lights.Count - lightCount);
            Keys.RemoveRange(keyCount, Keys.Count - keyCount);
            (kind, rest) = (null, cursor);
            return false;
        }
    }

    private int IndexOfLast(SceneDeclarationKind kind) => kind switch
    {
        SceneDeclarationKind.Light => Lights.Count - 1,
        SceneDeclarationKind.SceneObject => Objects.Count - 1,
        SceneDeclarationKind.FilmKey => Keys.Count - 1,
        _ => 0,
    };

    private bool ParseLine(Cursor cursor, out SceneDeclarationKind? kind, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        kind = null;
        return ParseComment(start, out rest)
            || ((IsAtEndOfLine(start) || ParseDeclaration(start, out kind, out rest)) && ParseEndOfLine(rest, out rest));
    }

    private protected override string? Explain(SyntaxFailure failure) => SceneMistakes.Explain(failure);

    /// <summary>Parses a keyword and its values. All kinds but lights, objects and keys may be declared only once.</summary>
    private bool ParseDeclaration(Cursor cursor, out SceneDeclarationKind? kind, out Cursor rest)
    {
        foreach (var (keyword, declared, parse) in Declarations)
        {
            if (ParseWord(cursor, keyword, out rest))
            {
                if (IsUnique(declared) && !_declarationOffsets.TryAdd(declared, cursor.Offset))
                {
                    throw Error(cursor, $"'{keyword}' is declared twice, first in line {Source.LineOf(_declarationOffsets[declared])}");
                }

                ParseBlanks(rest, out rest);
                kind = declared;
                return parse(this, rest, out rest);
            }
        }

        kind = null;
        rest = cursor;
        return false;
    }

    private static bool IsUnique(SceneDeclarationKind kind) =>
        kind is not (SceneDeclarationKind.Light or SceneDeclarationKind.SceneObject or SceneDeclarationKind.FilmKey);
}
