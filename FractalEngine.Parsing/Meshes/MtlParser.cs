using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Meshes;

/// <summary>
/// Reads Wavefront material files: <c>newmtl</c>, <c>Kd</c>, <c>Ka</c>, <c>Ks</c>, <c>Ns</c>, <c>d</c>, <c>Tr</c>, <c>map_Kd</c>. Other
/// statements are passed over; so are faulty ones, with one warning a file, since a surface of the wrong colour is better than none.
/// </summary>
public sealed partial class MtlParser : Parser
{
    // Each fault costs a look through the text for its line; what has more of them is no material file.
    private const int MaxFaults = 100;

    private readonly ImmutableDictionary<string, Material>.Builder _materials = ImmutableDictionary.CreateBuilder<string, Material>();
    private readonly ImmutableDictionary<string, int>.Builder _textureNameOffsets = ImmutableDictionary.CreateBuilder<string, int>();
    private Material? _current;
    private bool _hasOpacity;
    private Diagnostic? _firstFault;
    private int _faultCount;

    private MtlParser(SourceText source)
        : base(source)
    {
    }

    /// <summary>Parses a whole file. Nothing in it is an error.</summary>
    public static MtlFile Parse(SourceText source) => new MtlParser(source).ParseFile();

    private MtlFile ParseFile()
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
        return new(Source, _materials.ToImmutable(), _textureNameOffsets.ToImmutable(), _firstFault is null
            ? []
            : [CreateWarning(_firstFault)]);
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
            1 => $"{fault.Message}: the statement is passed over",
            MaxFaults => $"{fault.Message}: the statement is passed over (after {MaxFaults} such statements the rest of the file is, too)",
            _ => $"{fault.Message}: the statement is passed over ({_faultCount} such statements in all)",
        },
    };

    /// <summary>What was declared first under a name stays.</summary>
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
        if (IsAtEndOfLine(start) || start.Current == '#' || !char.IsLetter(start.Current)
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
            "Ns" => ParseScalar(start, rest, static (material, number) => material with { SpecularExponent = number }),
            "d" => ParseOpacity(start, rest),
            "Tr" => ParseTransparency(start, rest),
            "map_Kd" => ParseTexture(start, rest),
            _ => true,
        };
    }

    private bool ParseDeclaration(Cursor cursor)
    {
        var name = ReadName(cursor, out _);
        if (name.Length == 0)
        {
            return Fail(cursor, "a name");
        }

        CommitMaterial();
        (_current, _hasOpacity) = (new(name), false);
        return true;
    }

    private bool UpdateMaterial(Cursor statement, Func<Material, Material> update)
    {
        _current = update(_current ?? throw Error(statement, "no material is declared above"));
        return true;
    }

    /// <summary>Three components, or one for all three.</summary>
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

    /// <summary><c>d</c> counts more than <c>Tr</c>, wherever they stand: programs disagree about what <c>Tr</c> means.</summary>
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

    /// <summary>A surface that <c>Tr</c> alone calls wholly transparent is opaque: the programs that write this mean so.</summary>
    private bool ParseTransparency(Cursor statement, Cursor cursor) => ParseScalar(statement, cursor, (material, number) =>
        _hasOpacity ? material : material with { Opacity = number >= 1 ? 1 : Math.Clamp(1 - number, 0, 1) });

    /// <summary>All to the end of the line or to a comment, blanks at the ends taken off. Names may have blanks in them.</summary>
    private static string ReadName(Cursor cursor, out Cursor rest)
    {
        rest = cursor;
        while (!IsAtEndOfLine(rest) && !(rest.Current == '#' && rest.Offset > 0 && rest.Peek(-1) is ' ' or '\t'))
        {
            rest = rest.Advance(1);
        }

        return cursor.Rest[..(rest.Offset - cursor.Offset)].Trim().ToString();
    }

    private static bool IsAtEndOfStatement(Cursor cursor) => IsAtEndOfLine(cursor) || cursor.Current == '#';

    private bool ParseEndOfStatement(Cursor cursor)
    {
        ParseBlanks(cursor, out var rest);
        return IsAtEndOfStatement(rest) || Fail(rest, "the end of the line");
    }
}
