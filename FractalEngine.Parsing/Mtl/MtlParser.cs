using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Mtl;

/// <summary>
/// Reads Wavefront material files: <c>newmtl</c>, <c>Kd</c>, <c>Ka</c>, <c>Ks</c>, <c>Ke</c>, <c>Ns</c>, <c>d</c>, <c>Tr</c>,
/// <c>Ni</c>, <c>Tf</c>, <c>Pr</c>, <c>Pm</c>, <c>map_Kd</c>, <c>map_d</c>, <c>map_Bump</c>, <c>norm</c>; and <c>map_Ke</c>, which is not
/// shown, with one warning per file.
/// </summary>
/// <remarks>
/// Other statements are ignored. Faulty ones are ignored with one warning per file: a surface of the wrong colour is better than none.
/// </remarks>
public sealed class MtlParser : MtlTextureParser
{
    // Each fault costs a search through the text for its line. A file with more of them is not a material file.
    private const int MaxFaults = 100;

    // Immutable dictionaries took half of the time of large files.
    private readonly Dictionary<string, Material> _materials = [];
    private readonly RepeatedWarning _unshown = new("such statements");
    private Material? _current;
    private bool _hasOpacity;
    private Diagnostic? _firstFault;
    private int _faultCount;

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
        return new(Source, _materials, TextureNameOffsets, [.. CreateWarnings()]);
    }

    private IEnumerable<Diagnostic> CreateWarnings()
    {
        if (_firstFault is not null)
        {
            yield return CreateWarning(_firstFault);
        }

        if (_unshown.ToDiagnostic() is { } unshown)
        {
            yield return unshown;
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
            "Ni" => ParseScalar(start, rest, static (material, number) => material with { RefractiveIndex = number }),
            "Tf" => ParseColour(start, rest, static (material, colour) => material with { Transmission = colour }),
            "d" => ParseOpacity(start, rest),
            "Tr" => ParseTransparency(start, rest),
            "map_Kd" or "map_d" => ParseTexture(start, rest, keyword),
            "map_Ke" => ParseTexture(start, rest, keyword) && _unshown.Add(new(Source, start.Offset), "map_Ke is kept but not shown"),
            "map_Bump" or "map_bump" or "bump" or "norm" => ParseTexture(start, rest, keyword),
            "Pr" => ParseScalar(start, rest, static (material, number) => material with { Roughness = number }),
            "Pm" => ParseScalar(start, rest, static (material, number) => material with { Metalness = number }),
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
        ParseNumber(cursor, out var number, out var rest) && ParseEndOfStatement(rest)
        && UpdateMaterial(statement, material => update(material, number));

    private bool ParseTexture(Cursor statement, Cursor cursor, string keyword) =>
        ParseTexture(cursor, out var texture)
        && UpdateMaterial(statement, material => TextureSlot.ByKeyword[keyword].With(material, texture));

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
}
