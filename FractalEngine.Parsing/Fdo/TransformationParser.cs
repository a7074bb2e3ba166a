using System.Diagnostics.CodeAnalysis;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Parses the vectors and transformation functions of fractal files.</summary>
public abstract class TransformationParser : ExpressionParser
{
    /// <summary>Largest number of parameters of a function.</summary>
    private protected const int MaxParameters = 3;

    private (int Offset, string Name)? _unknownOutput;

    private protected TransformationParser(SourceText source, FractalNumberList? numbers, bool keepsSums)
        : base(source, numbers)
    {
        Bases = new(keepsSums);
        Names = new(source, Bases);
    }

    /// <summary>The vectors that were declared so far, in the order of their numbers.</summary>
    private protected List<Vector> Vectors { get; } = [];

    /// <summary>The parts of all objects, and what they begin with.</summary>
    private protected DeclaredBases Bases { get; }

    /// <summary>The names of objects and transformations that were declared so far.</summary>
    private protected DeclaredNames Names { get; }

    /// <summary>Parses a vector: <c>v x y z</c>.</summary>
    private protected bool ParseVectorDeclaration(Cursor cursor, out Cursor rest)
    {
        rest = cursor;
        if (!ParseWordAndBlank(cursor, "v", out var numbers) || !ParseComponents(numbers, out var vector, out rest))
        {
            return false;
        }

        Vectors.Add(vector);
        Numbers?.AddVector(Vectors.Count, numbers, rest);
        return true;
    }

    /// <summary>Parses <c>m.matrix (x axis) (y axis) (z axis) (translation)</c>: a map by what it makes of the axes.</summary>
    private protected bool ParseMatrix(Cursor cursor, out Cursor rest)
    {
        if (!ParseName(cursor, "a declaration", out var name, out rest) || !ParseChar(rest, '.', out rest)
            || !ParseWord(rest, "matrix", out rest) || !ParseBlanks(rest, out var start) || !ParseVectorTerm(start, out var x, out rest)
            || !ParseNextVector(rest, out var y, out rest) || !ParseNextVector(rest, out var z, out rest)
            || !ParseNextVector(rest, out var translation, out rest))
        {
            return false;
        }

        var map = new AffineMap(new(x, y, z), translation);
        RequireInvertible(start, map);
        Names.Add(cursor, name, new TransformationFunction(FractalParameters.None, default, default, default) { Matrix = [map] });
        return true;
    }

    private bool ParseNextVector(Cursor cursor, out Vector vector, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        ParseBlanks(rest.Current == ',' ? rest.Advance(1) : rest, out rest);
        return ParseVectorTerm(rest, out vector, out rest);
    }

    /// <summary>Parses a vector in parentheses, or the name of one.</summary>
    private bool ParseVectorTerm(Cursor cursor, out Vector vector, out Cursor rest)
    {
        vector = default;
        if (cursor.Current == '(')
        {
            return ParseVectorValue(cursor, null, null, out vector, out rest);
        }

        Fail(cursor, "'('");
        return ParseName(cursor, "the name of a vector", out var name, out rest) && Set(ref vector, FindVector(cursor, name));
    }

    private Vector FindVector(Cursor cursor, string name) => TryFindValue(name, out var value) ? RequireVector(cursor, name, value)
        : throw Error(cursor, $"the vector '{name}' is not declared above{AskAboutValue(name, isNumber: false)}");

    /// <summary>Parses <c>t.a.b. (out, out, out)</c>; each output is a parameter, a vector or its number or name, or '#'.</summary>
    private protected bool ParseFunction(Cursor cursor, out Cursor rest)
    {
        if (!ParseName(cursor, "a declaration", out var name, out rest) || !ParseChar(rest, '.', out rest)
            || !ParseParameters(rest, out var parameters, out rest) || !ParseBlanks(rest, out rest)
            || !ParseChar(rest, '(', out var outputs)
            || (parameters.Count == 0 && Parentheses.HoldObject(rest.Rest)))
        {
            return false;
        }

        Parameters = parameters.Count == 0 ? FractalParameters.None : new(parameters);
        var isParsed = ParseOutputs(outputs, name, out var function, out rest);
        Parameters = FractalParameters.None;
        if (isParsed)
        {
            Names.Add(cursor, name, function!);
        }

        return isParsed;
    }

    /// <summary>Parses the three outputs of a function, or of a map without a name, behind the parenthesis.</summary>
    private protected bool ParseOutputs(
        Cursor cursor, string? name, [NotNullWhen(true)] out TransformationFunction? function, out Cursor rest)
    {
        function = null;
        if (!ParseBlanks(cursor, out rest) || !ParseOutput(rest, name, FractalNumberRole.Position, out var position, out rest)
            || !ParseSeparator(rest, out rest) || !ParseOutput(rest, name, FractalNumberRole.Rotation, out var rotation, out rest)
            || !ParseSeparator(rest, out rest) || !ParseOutput(rest, name, FractalNumberRole.Scale, out var scale, out rest)
            || !ParseBlanks(rest, out rest) || !ParseChar(rest, ')', out rest))
        {
            return false;
        }

        function = new(Parameters, position, rotation, scale);
        if (ParseBlanks(rest, out var word) && ParseWord(word, "colour", out var behind) && behind.Current != '.'
            && ParseBlanks(behind, out var colour))
        {
            function = function with { Colour = colour };
            return ParseMapColour(colour, out _, out rest);
        }

        return true;
    }

    /// <summary>Parses a colour and its amount, <c>(0.9, 0.8, 0.2) 0.05</c>: what a map mixes into all that it makes.</summary>
    private protected bool ParseMapColour(Cursor cursor, out MapColour colour, out Cursor rest)
    {
        colour = default;
        if (!ParseColourVector(cursor, out var vector, out rest) || !ParseBlanks(rest, out var start)
            || !ParseSigned(start, out var amount, out rest))
        {
            return false;
        }

        // What has parameters is no number in the declaration.
        if (vector.IsFinite() && !(Vector.Min(vector, Vector.One) == vector && Vector.Max(vector, Vector.Zero) == vector))
        {
            throw Error(cursor, $"the components of a colour are from 0 to 1, not {vector}");
        }

        ThrowIf(amount is < 0 or > 1, start, FormattableString.Invariant($"the amount of a colour is from 0 to 1, not {amount:R}"));
        var (red, green, blue) = vector;
        colour = new(new(red, green, blue), amount);
        return true;
    }

    private bool ParseColourVector(Cursor cursor, out Vector vector, out Cursor rest)
    {
        if (BeginsName(cursor) && ParseName(cursor, "a parameter", out var name, out rest)
            && Parameters.IndexOf(name) is >= 0 and var index)
        {
            RequireUse(cursor, index, asNumber: false);
            vector = Arguments is null ? double.NaN * Vector.One : Arguments[index].Vector;
            return true;
        }

        return ParseVectorTerm(cursor, out vector, out rest);
    }

    private bool ParseParameters(Cursor cursor, out List<string> parameters, out Cursor rest)
    {
        parameters = [];
        for (rest = cursor; BeginsName(rest);)
        {
            var parameterStart = rest;
            if (!ParseName(rest, "a parameter", out var parameter, out rest) || !ParseChar(rest, '.', out rest))
            {
                return false;
            }

            ThrowIf(parameters.Contains(parameter), parameterStart, $"the parameter '{parameter}' is named twice");
            ThrowIf(parameters.Count == MaxParameters, parameterStart, $"a transformation has at most {MaxParameters} parameters");
            parameters.Add(parameter);
        }

        return true;
    }

    private bool ParseOutput(Cursor cursor, string? function, FractalNumberRole role, out FunctionOutput output, out Cursor rest)
    {
        output = new(role == FractalNumberRole.Scale ? Vector.One : Vector.Zero, cursor);
        rest = cursor;
        if (char.IsAsciiDigit(cursor.Current) && !IsDecimal(cursor))
        {
            if (!ParseInteger(cursor, FractalMistakes.VectorNumber, out var number, out rest))
            {
                return false;
            }

            if (number == 0)
            {
                throw VectorError(cursor, "");
            }

            output = output with { VectorNumber = number };
            Numbers?.AddRole(FractalNumberList.NameOf(number), role);
            return true;
        }

        if (cursor.Current == '(')
        {
            return ParseVectorValue(cursor, function, role, out var vector, out rest) && Set(ref output, output with { Value = vector });
        }

        if (BeginsName(cursor) && ParseName(cursor, "a parameter", out var name, out var afterName))
        {
            rest = afterName;
            return ParseNamedOutput(cursor, name, role, ref output);
        }

        if (cursor.Current == '#')
        {
            rest = cursor.Advance(1);
            return true;
        }

        return FailOutput(cursor);
    }

    private bool ParseNamedOutput(Cursor cursor, string name, FractalNumberRole role, ref FunctionOutput output)
    {
        if (Parameters.IndexOf(name) is >= 0 and var index)
        {
            RequireUse(cursor, index, asNumber: false);
            output = output with { Parameter = index };
            return true;
        }

        if (TryFindValue(name, out var value))
        {
            output = output with { Value = RequireVector(cursor, name, value) };
            Numbers?.AddRole(name, role);
            return true;
        }

        _unknownOutput = (cursor.Offset, name);
        return FailOutput(cursor);
    }

    private bool FailOutput(Cursor cursor)
    {
        Fail(cursor, FractalMistakes.VectorNumber);
        Fail(cursor, "a name");
        Fail(cursor, "'('");
        return Fail(cursor, "'#'");
    }

    /// <summary>Explains an output that is the name of nothing; null for other failures.</summary>
    private protected string? ExplainOutput(SyntaxFailure failure) =>
        _unknownOutput is { } unknown && unknown.Offset == failure.Position.Offset
            ? $"no parameter and no vector above has this name{AskAboutValue(unknown.Name, isNumber: false)}" : null;

    /// <summary>Tells whether a number with a point and decimals begins here, such as 0.5.</summary>
    private static bool IsDecimal(Cursor cursor) =>
        NumberReader.TryRead(cursor.Rest, out _, out var length) && cursor.Rest[..length].Contains('.');

    /// <summary>Parses the number of a vector that is declared above.</summary>
    private protected bool ParseVectorNumber(Cursor cursor, out int number, out Vector vector, out Cursor rest)
    {
        vector = default;
        if (!ParseInteger(cursor, FractalMistakes.VectorNumber, out number, out rest))
        {
            return false;
        }

        if (number < 1 || number > Vectors.Count)
        {
            throw VectorError(cursor, " above");
        }

        vector = Vectors[number - 1];
        return true;
    }

    /// <summary>Creates the error of a number that is that of no vector.</summary>
    private protected SourceException VectorError(Cursor start, string place)
    {
        ParseInteger(start, FractalMistakes.VectorNumber, out var number, out var end);
        var fault = number > 0 ? $"it is not declared{place}, and numbers stand in parentheses"
            : place.Length == 0 ? $"vectors are numbered from 1, and a map of numbers is written as {FractalMistakes.MapExample}"
            : "vectors are numbered from 1, and numbers stand in parentheses";
        return Error(start, $"vector {TextBetween(start, end)} of {Vectors.Count}: {fault}");
    }

    /// <summary>Requires queries to have a way back through maps.</summary>
    private protected void RequireInvertible(Cursor cursor, params ReadOnlySpan<AffineMap> maps)
    {
        for (var i = 0; i < maps.Length; i++)
        {
            if (ScaleCheck.FindFault(in maps[i]) is { } fault)
            {
                throw Error(cursor, $"{(maps.Length == 1 ? "the map" : $"map {i + 1} of these {maps.Length}")} {fault}");
            }
        }
    }

    /// <summary>Requires all vectors to be declared that functions without a call use.</summary>
    private protected void RequireVectors()
    {
        if (Names.Functions.FirstOrDefault(function => function.LastVectorNumber > Vectors.Count) is { } uncalled)
        {
            throw VectorError(uncalled.Last.Start, "");
        }
    }
}
