using System.Collections.Immutable;
using System.Globalization;
using System.Text;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>Writes one file of a model, in the plainest form or in a random one of the same meaning.</summary>
/// <param name="file">The file.</param>
/// <param name="random">Chooses forms; null for the plainest ones.</param>
internal sealed class GraphFileWriter(GraphFile file, Random? random)
{
    private readonly StringBuilder _text = new();
    private readonly Dictionary<MapLeaf, string> _calls = [];
    private readonly Dictionary<string, string> _functions = [];
    private readonly Dictionary<string, OracleMesh> _meshes = [];
    private readonly Dictionary<string, GraphFile> _files = [];
    private readonly bool _hasSums = file.Declarations.Any(HasSum) || HasSum(file.Result);
    private int _vectors;
    private int _names;

    /// <summary>The meshes that the file names.</summary>
    public IEnumerable<OracleMesh> Meshes => _meshes.Values;

    /// <summary>The other files that the file names.</summary>
    public IEnumerable<GraphFile> Files => _files.Values;

    public string Write()
    {
        foreach (var declaration in file.Declarations)
        {
            // Maps are declared on the way, and stand before what uses them.
            var line = declaration switch
            {
                GraphDeclaration.Alias alias => $"{alias.Name}.{Blank()}{Format(alias.Body)}",
                GraphDeclaration.Group group => Format(group),
                GraphDeclaration.Seed(var value, var isByLevel) => $"seed {value}{(isByLevel ? " by level" : "")}",
                _ => throw new InvalidOperationException("a declaration of another kind"),
            };
            AddLine(line);
        }

        AddLine($"<$>.{Blank()}{Format(file.Result)}");
        return _text.ToString();
    }

    private static bool HasSum(GraphDeclaration declaration) => declaration switch
    {
        GraphDeclaration.Alias alias => HasSum(alias.Body),
        GraphDeclaration.Group group => group.Recursives.Length > 1 || HasSum(group.Recursives[0].Body),
        _ => false,
    };

    private static bool HasSum(ObjectTerm term) => term switch
    {
        ObjectTerm.Sum or ObjectTerm.File or ObjectTerm.Choice => true,
        ObjectTerm.Mapped(_, var inner) => HasSum(inner),
        _ => false,
    };

    private string Format(GraphDeclaration.Group group)
    {
        var heads = group.Recursives.Select(recursive => $"{recursive.Name}<{recursive.Base}>");
        var bodies = group.Recursives.Select(recursive => Format(recursive.Body)).ToArray();
        return $"{string.Join("," + Blank(), heads)}.{Blank()}{string.Join("," + Blank(), bodies)}";
    }

    private string Format(ObjectTerm term, bool isOperand = false)
    {
        switch (term)
        {
            case ObjectTerm.Mesh(var mesh):
                _meshes[mesh.Path] = mesh;
                return Parenthesise(Quote(mesh.Path));
            case ObjectTerm.File(var other):
                _files[other.Path] = other;
                return Parenthesise(Quote(other.Path));
            case ObjectTerm.Named(var name):
                return Parenthesise(name);
            case ObjectTerm.AtDepth(var name, null):
                return name;
            case ObjectTerm.AtDepth(var name, { } depth):
                return Choose($"{name} {depth}", $"{name} {depth}", $"{name} ({depth})", $"{name}({depth + 1}{Blank()}-{Blank()}1)");
            case ObjectTerm.Until(var name, var size):
                // Without parentheses a sum behind it would be one of numbers.
                var until = $"{name} until {Number(size)}";
                return isOperand ? $"({until})" : until;
            case ObjectTerm.Choice(var alternatives):
                var forms = alternatives.Select(one => $"{Number(one.Weight)}:{Blank()}{FormatAlternative(one.Term)}");
                var choice = string.Join($"{Blank()}|{Blank()}", forms);
                return isOperand ? $"({Blank("")}{choice}{Blank("")})" : choice;
            case ObjectTerm.Mapped(var set, var inner):
                return $"[{Blank("")}{Format(set)}{Blank("")}]{Blank()}{Format(inner, isOperand: true)}";
            case ObjectTerm.Sum(var terms):
                var sum = string.Join($"{Blank()}+{Blank()}", terms.Select(part => Format(part, isOperand: true)));
                return isOperand ? $"({Blank("")}{sum}{Blank("")})" : Parenthesise(sum);
            default:
                throw new InvalidOperationException("a term of another kind");
        }
    }

    // A choice in a choice is one in parentheses.
    private string FormatAlternative(ObjectTerm term) => Format(term, isOperand: term is ObjectTerm.Choice);

    // What had no sums could not have parentheses either.
    private string Parenthesise(string text) => _hasSums && Happens(6) ? $"({Blank("")}{text})" : text;

    private string Format(ImmutableArray<MapProduct> set)
    {
        var separator = Choose(", ", ",", " ", "  ,");
        return string.Join(separator, set.Select(product => string.Join(
            Choose(" * ", "*"), product.Factors.Select(power => Call(power.Leaf) + FormatExponent(power)))));
    }

    private string FormatExponent(MapPower power) => power switch
    {
        (_, 1, 1) => "",
        var (_, low, high) when low == high => $"^{Integer(low)}",
        var (_, low, high) => $"^{Integer(low)}..{Integer(high)}",
    };

    private string Integer(int number)
    {
        var digits = number.ToString(CultureInfo.InvariantCulture);
        return Choose(digits, digits, $"({digits})");
    }

    private string Call(MapLeaf leaf)
    {
        if (leaf is MapLeaf.Identity)
        {
            return "#";
        }

        if (!_calls.TryGetValue(leaf, out var call))
        {
            call = leaf switch
            {
                MapLeaf.Columns(var x, var y, var z, var origin) => DeclareMatrix([x, y, z, origin]),
                MapLeaf.Placement placement => Happens(50) ? CallFunction(placement) : DeclareMap(placement),
                _ => throw new InvalidOperationException("a map of another kind"),
            };
            // At times the same map is declared again.
            if (!Happens(10))
            {
                _calls[leaf] = call;
            }
        }

        return call;
    }

    private string DeclareMatrix(Vector[] columns)
    {
        var separator = Choose(" ", ", ", ",");
        var vectors = columns.Select(column => Happens(20) ? DeclareVector(column) : Inline(column)).ToArray();
        var name = NewName("q");
        AddLine($"{name}.matrix {string.Join(separator, vectors)}");
        return name + ".";
    }

    private string DeclareMap(MapLeaf.Placement placement)
    {
        var outputs = Outputs(placement).Select(v => v is { } vector ? Refer(vector) : "#").ToArray();
        var name = NewName("t");
        AddLine($"{name}.{Blank()}({string.Join(Choose(", ", ",", "  "), outputs)})");
        return name + ".";
    }

    /// <summary>Calls a function of the file whose parameters are the parts that are no identities.</summary>
    private string CallFunction(MapLeaf.Placement placement)
    {
        var outputs = Outputs(placement);
        var parameters = outputs.Select((v, i) => v is null ? null : "abc"[i..(i + 1)]).ToArray();
        var given = string.Concat(parameters.Where(static parameter => parameter is not null).Select(static parameter => parameter + "."));
        if (!_functions.TryGetValue(given, out var name))
        {
            name = NewName("f");
            _functions[given] = name;
            AddLine($"{name}.{given} ({string.Join(", ", parameters.Select(static parameter => parameter ?? "#"))})");
        }

        var arguments = outputs.Where(static v => v is not null).Select(v => "." + Refer(v!.Value)).ToArray();
        return arguments.Length == 0 ? name + "." : name + string.Concat(arguments) + Choose("", ".");
    }

    private static Vector?[] Outputs(MapLeaf.Placement placement) => [placement.Position, placement.Rotation, placement.Scale];

    /// <summary>Names a vector by its number or its name, or writes it out.</summary>
    private string Refer(Vector v) => random is null ? Inline(v) : random.Next(3) switch
    {
        0 => Inline(v),
        1 => DeclareVector(v),
        _ => DeclareNumbered(v),
    };

    private string DeclareVector(Vector v)
    {
        var value = $"({Number(v.X)},{Blank()}{Number(v.Y)},{Blank()}{Number(v.Z)})";
        var name = NewName("w");
        AddLine($"{name} = {value}");
        return name;
    }

    private string DeclareNumbered(Vector v)
    {
        var separator = Choose(" ", ", ", "  ");
        AddLine($"v {string.Join(separator, new[] { v.X, v.Y, v.Z }.Select(Digits))}");
        _vectors++;
        return _vectors.ToString(CultureInfo.InvariantCulture);
    }

    private string Inline(Vector v) => v.X == v.Y && v.Y == v.Z && Happens(70)
        ? $"({Number(v.X)})"
        : $"({Number(v.X)}, {Number(v.Y)}, {Number(v.Z)})";

    private string Number(double number)
    {
        if (Happens(4))
        {
            var name = NewName("k");
            AddLine($"{name} = {Digits(number)}{Choose("", $" from {Digits(number - 1)} to {Digits(number + 2)}")}");
            return name;
        }

        // Of eighths the quotient is exact.
        var eighths = 8 * number;
        return Happens(20) && eighths == Math.Round(eighths) && Math.Abs(eighths) < 1e6
            ? string.Create(CultureInfo.InvariantCulture, $"{eighths:R}/8")
            : Digits(number);
    }

    private static string Digits(double number) => number.ToString("R", CultureInfo.InvariantCulture);

    private string Quote(string path)
    {
        var folder = Path.GetDirectoryName(file.Path)!;
        return $"\"{Path.GetRelativePath("/" + folder, "/" + path).Replace('\\', '/')}\"";
    }

    private string NewName(string prefix)
    {
        _names++;
        return string.Create(CultureInfo.InvariantCulture, $"{prefix}{_names}");
    }

    private void AddLine(string line)
    {
        if (Happens(4))
        {
            _text.Append(Choose("\n", "# A line of words: x. [t.] y + z\n", "#\n", "// Likewise.\n"));
        }

        _text.Append(line).Append(Happens(6) ? Choose(" // b + c", "  ", "//") : "").Append('\n');
    }

    private string Blank(string plain = " ") => Happens(15) ? Choose("", " ", "   ", "\t") : plain;

    private bool Happens(int percent) => random is not null && random.Happens(percent);

    private string Choose(params ReadOnlySpan<string> forms) => random is null ? forms[0] : forms[random.Next(forms.Length)];
}
