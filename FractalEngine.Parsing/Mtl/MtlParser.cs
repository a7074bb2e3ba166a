using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Mtl;

/// <summary>
/// Reads Wavefront material files: <c>newmtl</c>, <c>Kd</c>, <c>Ka</c>, <c>Ks</c>, <c>Ke</c>, <c>Ns</c>, <c>d</c>, <c>Tr</c>,
/// <c>map_Kd</c>, <c>map_d</c>; and <c>map_Ke</c>, <c>map_Bump</c>, <c>norm</c>, <c>Pr</c>, <c>Pm</c>, which drawn frames do not show,
/// with one warning per file.
/// </summary>
/// <remarks>
/// Other statements are ignored. Faulty ones are ignored with one warning per file: a surface of the wrong colour is better than none.
/// </remarks>
public sealed partial class MtlParser : Parser
{
    // Each fault costs a search through the text for its line. A file with more of them is not a material file.
    private const int MaxFaults = 100;

    // Immutable dictionaries took half of the time of large files.
    private readonly Dictionary<string, Material> _materials = [];
    private readonly Dictionary<MaterialTexture, int> _textureNameOffsets = new(ReferenceEqualityComparer.Instance);
    private Material? _current;
    private bool _hasOpacity;
    private Diagnostic? _firstFault;
    private int _faultCount;
    private UnshownStatements _tracedOnly;
    private UnshownStatements _unshown;

    private MtlParser(SourceText source)
        : base(source)
    {
    }

    /// <summary>Parses a whole file. Faults in it give a warning, never an error.</summary>
    public static ParsedMtl Parse(SourceText source) => new MtlParser(source).ParseFile();

    private ParsedMtl ParseFile()
    {
        for (var cursor = Source.Start; !cursor.IsAtEnd && _faultCount < MaxFaults; cursor = SkipLine(cursor))
        {
            try
            {
                if (!ParseLine(cursor))
                {
                    RecordFault(SyntaxError());
                }
            }
            catch (SourceException fault)
            {
                RecordFault(fault);
            }
        }

        CommitMaterial();
        return new(Source, _materials, _textureNameOffsets, [.. CreateWarnings()]);
    }

    private IEnumerable<Diagnostic> CreateWarnings()
    {
        if (_firstFault is not null)
        {
            yield return CreateWarning(_firstFault);
        }

        if (_tracedOnly.Count > 0)
        {
            yield return CreateWarning(_tracedOnly, "is shown in traced images only") with { ConcernsDrawnFrames = true };
        }

        if (_unshown.Count > 0)
        {
            yield return CreateWarning(_unshown, "is kept but not shown");
        }
    }

    private void RecordFault(SourceException fault)
    {
        _firstFault ??= fault.Diagnostic;
        _faultCount++;
    }

    private Diagnostic CreateWarning(Diagnostic fault) => fault with
    {
        Severity = DiagnosticSeverity.Warning,
        Message = _faultCount switch
        {
            1 => $"{fault.Message}: the statement is ignored",
            MaxFaults => $"{fault.Message}: the statement is ignored (after {MaxFaults} such statements the rest of the file is, too)",
            _ => $"{fault.Message}: the statement is ignored ({_faultCount} such statements in all)",
        },
    };

    /// <summary>Adds the current material to the result. The first of several materials with the same name wins.</summary>
    private void CommitMaterial()
    {
        if (_current is { } material)
        {
            _materials.TryAdd(material.Name, material);
            _current = null;
        }
    }

    private Diagnostic CreateWarning(UnshownStatements statements, string problem)
    {
        var totalNote = statements.Count == 1 ? "" : $" ({statements.Count} such statements in all)";
        return Source.Diagnose(statements.First.Offset, $"{statements.Keyword} {problem}{totalNote}", DiagnosticSeverity.Warning);
    }

    private bool ParseLine(Cursor cursor)
    {
        ParseBlanks(cursor, out var start);
        if (IsAtEndOfStatement(start) || !char.IsLetter(start.Current)
            || !ParseName(start, "a keyword", out var keyword, out var rest))
        {
            return true;
        }

        ParseBlanks(rest, out rest);
        return keyword switch
        {
            "newmtl" => ParseDeclaration(rest),
            "Kd" => ParseColour(start, rest, static (material, colour) => material with { Diffuse = colour }),
            "Ka" => ParseColour(start, rest, static (material, colour) => material with { Ambient = colour }),
            "Ks" => ParseColour(start, rest, static (material, colour) => material with { Specular = colour }),
            "Ke" => ParseColour(start, rest, static (material, colour) => material with { Emission = colour }),
            "Ns" => ParseScalar(start, rest, static (material, number) => material with { SpecularExponent = number }),
            "d" => ParseOpacity(start, rest),
            "Tr" => ParseTransparency(start, rest),
            "map_Kd" => ParseTexture(start, rest, static (material, texture) => material with { Texture = texture }),
            "map_d" => ParseTexture(start, rest, static (material, texture) => material with { OpacityTexture = texture }),
            "map_Ke" => ParseTexture(rest, out var emission)
                && Keep(ref _unshown, start, keyword, material => material with { EmissionTexture = emission }),
            "map_Bump" or "map_bump" or "bump" => ParseTexture(rest, out var bumps)
                && Keep(ref _tracedOnly, start, keyword, material => material with { BumpTexture = bumps }),
            "norm" => ParseTexture(rest, out var normals)
                && Keep(ref _tracedOnly, start, keyword, material => material with { NormalTexture = normals }),
            "Pr" => ParseScalar(rest, out var roughness)
                && Keep(ref _tracedOnly, start, keyword, material => material with { Roughness = roughness }),
            "Pm" => ParseScalar(rest, out var metalness)
                && Keep(ref _tracedOnly, start, keyword, material => material with { Metalness = metalness }),
            _ => true,
        };
    }

    private bool ParseDeclaration(Cursor cursor)
    {
        var name = ReadRestOfLine(cursor, out _);
        if (name.Length == 0)
        {
            return Fail(cursor, "a name");
        }

        CommitMaterial();
        _current = new(name);
        _hasOpacity = false;
        return true;
    }

    private bool UpdateMaterial(Cursor statement, Func<Material, Material> update)
    {
        _current = update(_current ?? throw Error(statement, "no material is declared above"));
        return true;
    }

    /// <summary>Parses three components of a colour, or one for all three.</summary>
    private bool ParseColour(Cursor statement, Cursor cursor, Func<Material, Colour, Material> update)
    {
        if (!ParseNumber(cursor, out var red, out var rest) || !ParseBlanks(rest, out rest))
        {
            return false;
        }

        if (IsAtEndOfStatement(rest))
        {
            return UpdateMaterial(statement, material => update(material, new(red, red, red)));
        }

        return ParseNumber(rest, out var green, out rest) && ParseBlanks(rest, out rest)
            && ParseNumber(rest, out var blue, out rest) && ParseEndOfStatement(rest)
            && UpdateMaterial(statement, material => update(material, new(red, green, blue)));
    }

    private bool ParseScalar(Cursor statement, Cursor cursor, Func<Material, double, Material> update) =>
        ParseScalar(cursor, out var number) && UpdateMaterial(statement, material => update(material, number));

    private bool ParseScalar(Cursor cursor, out double number) =>
        ParseNumber(cursor, out number, out var rest) && ParseEndOfStatement(rest);

    /// <summary>Updates the material by a statement that makes no difference to some images.</summary>
    private bool Keep(ref UnshownStatements statements, Cursor statement, string keyword, Func<Material, Material> update)
    {
        UpdateMaterial(statement, update);
        statements = statements.Count == 0 ? new(statement, keyword, 1) : statements with { Count = statements.Count + 1 };
        return true;
    }

    /// <summary>
    /// Parses an opacity. <c>d</c> overrides <c>Tr</c> in any order, because programs disagree about the meaning of <c>Tr</c>.
    /// </summary>
    private bool ParseOpacity(Cursor statement, Cursor cursor)
    {
        if (cursor.Rest.StartsWith("-halo", StringComparison.Ordinal))
        {
            ParseBlanks(cursor.Advance("-halo".Length), out cursor);
        }

        return ParseScalar(statement, cursor, (material, number) =>
        {
            _hasOpacity = true;
            return material with { Opacity = Math.Clamp(number, 0, 1) };
        });
    }

    /// <summary>Parses a transparency. <c>Tr 1</c> without <c>d</c> means opaque, as the programs that write it intend.</summary>
    private bool ParseTransparency(Cursor statement, Cursor cursor) => ParseScalar(statement, cursor, (material, number) =>
        _hasOpacity ? material : material with { Opacity = number >= 1 ? 1 : Math.Clamp(1 - number, 0, 1) });

    private static bool IsAtEndOfStatement(Cursor cursor) => IsAtEndOfLine(cursor) || cursor.Current == '#';

    private bool ParseEndOfStatement(Cursor cursor) => ParseCommentAndEndOfLine(cursor, out _);

    /// <summary>The first of some statements, for a warning about all of them.</summary>
    private readonly record struct UnshownStatements(Cursor First, string Keyword, int Count);
}
