using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Parses the vectors and transformation functions of fractal files, and the sets that call these.</summary>
public abstract class TransformationParser : Parser
{
    private const int MaxParameters = 3;

    private readonly List<Vector> _vectors = [];

    // The arguments of the call that is read.
    private readonly Vector[] _arguments = new Vector[MaxParameters];
    private long _mapCount;

    private protected TransformationParser(SourceText source, FractalNumberList? numbers)
        : base(source)
    {
        Numbers = numbers;
        Names = new(source);
    }

    /// <summary>The names that were declared so far.</summary>
    private protected DeclaredNames Names { get; }

    /// <summary>Receives the numbers of the file; null where nobody asks for them.</summary>
    private protected FractalNumberList? Numbers { get; }

    /// <summary>Parses a vector: <c>v x y z</c>.</summary>
    private protected bool ParseVectorDeclaration(Cursor cursor, out Cursor rest)
    {
        if (!ParseWord(cursor, "v", out rest) || !ParseBlanks(rest, out var numbers) || numbers.Offset == rest.Offset
            || !ParseComponents(numbers, out var vector, out rest))
        {
            return false;
        }

        _vectors.Add(vector);
        Numbers?.AddVector(_vectors.Count, numbers, rest);
        return true;
    }

    /// <summary>Parses <c>t.a.b. (out, out, out)</c>; each output is a parameter, the number of a vector, or '#'.</summary>
    private protected bool ParseFunction(Cursor cursor, out Cursor rest)
    {
        if (!ParseName(cursor, "a declaration", out var name, out rest) || !ParseChar(rest, '.', out rest)
            || !ParseParameters(rest, out var parameters, out rest)
            || !ParseBlanks(rest, out rest) || !ParseChar(rest, '(', out rest)
            || !ParseBlanks(rest, out rest) || !ParseOutput(rest, parameters, FractalNumberRole.Position, out var position, out rest)
            || !ParseSeparator(rest, out rest) || !ParseOutput(rest, parameters, FractalNumberRole.Rotation, out var rotation, out rest)
            || !ParseSeparator(rest, out rest) || !ParseOutput(rest, parameters, FractalNumberRole.Scale, out var scale, out rest)
            || !ParseBlanks(rest, out rest) || !ParseChar(rest, ')', out rest))
        {
            return false;
        }

        Names.Add(cursor, name, new TransformationFunction(parameters.Count, position, rotation, scale));
        return true;
    }

    private bool ParseParameters(Cursor cursor, out List<string> parameters, out Cursor rest)
    {
        parameters = [];
        for (rest = cursor; char.IsLetter(rest.Current) || rest.Current == '_';)
        {
            var parameterStart = rest;
            if (!ParseName(rest, "a parameter", out var parameter, out rest) || !ParseChar(rest, '.', out rest))
            {
                return false;
            }

            if (parameters.Contains(parameter))
            {
                throw Error(parameterStart, $"the parameter '{parameter}' is named twice");
            }

            if (parameters.Count == MaxParameters)
            {
                throw Error(parameterStart, $"a transformation has at most {MaxParameters} parameters");
            }

            parameters.Add(parameter);
        }

        return true;
    }

    private bool ParseOutput(
        Cursor cursor, List<string> parameters, FractalNumberRole role, out FunctionOutput output, out Cursor rest)
    {
        output = new(null, null, role == FractalNumberRole.Scale ? Vector.One : Vector.Zero, cursor);
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
            Numbers?.AddRole(number, role);
            return true;
        }

        if (char.IsLetter(cursor.Current) && ParseName(cursor, "a parameter", out var name, out var afterName)
            && parameters.IndexOf(name) is >= 0 and var index)
        {
            output = output with { Parameter = index };
            rest = afterName;
            return true;
        }

        if (cursor.Current == '#')
        {
            rest = cursor.Advance(1);
            return true;
        }

        Fail(cursor, FractalMistakes.VectorNumber);
        Fail(cursor, "a parameter");
        return Fail(cursor, "'#'");
    }

    /// <summary>Tells whether a number with a point and decimals begins here, such as 0.5.</summary>
    private static bool IsDecimal(Cursor cursor) =>
        NumberReader.TryRead(cursor.Rest, out _, out var length) && cursor.Rest[..length].Contains('.');

    /// <summary>Parses the number of a vector that is declared above.</summary>
    private bool ParseVectorNumber(Cursor cursor, out int number, out Vector vector, out Cursor rest)
    {
        vector = default;
        if (!ParseInteger(cursor, FractalMistakes.VectorNumber, out number, out rest))
        {
            return false;
        }

        if (number < 1 || number > _vectors.Count)
        {
            throw VectorError(cursor, " above");
        }

        vector = _vectors[number - 1];
        return true;
    }

    /// <summary>Creates the error of a number that is that of no vector.</summary>
    private SourceException VectorError(Cursor start, string place)
    {
        ParseInteger(start, FractalMistakes.VectorNumber, out var number, out var end);
        var fault = number == 0 ? "vectors are numbered from 1"
            : $"it is not declared{place}, and values stand in vectors of their own";
        return Error(start, $"vector {TextBetween(start, end)} of {_vectors.Count}: {fault}");
    }

    /// <summary>Parses a set of calls: <c>[#, t.1, u.6.10]</c>.</summary>
    private protected bool ParseSet(Cursor cursor, out TransformationSet set, out Cursor rest)
    {
        set = new([]);
        if (!ParseChar(cursor, '[', out rest) || !ParseBlanks(rest, out rest))
        {
            return false;
        }

        var transformations = ImmutableArray.CreateBuilder<Transformation>((int)Math.Min(CountCalls(rest), ParsingLimits.Maps.Value));

        for (var first = true; rest.Current != ']'; first = false)
        {
            if ((!first && !ParseSeparator(rest, out rest)) || !ParseCall(rest, transformations.Count, out var transformation, out rest))
            {
                return false;
            }

            RequireLimit(++_mapCount, ParsingLimits.Maps.Value, "the file", "transformations in all sets", rest);
            transformations.Add(transformation);
            if (ParseBlanks(rest, out var next) && next.Current == ']')
            {
                rest = next;
            }
        }

        Numbers?.EndSet(transformations.Count);
        set = new(transformations.DrainToImmutable());
        return ParseChar(rest, ']', out rest);
    }

    /// <summary>Counts what may be the calls of a set, so that wide sets are collected without copies.</summary>
    private static int CountCalls(Cursor cursor)
    {
        var end = cursor.Rest.IndexOfAny(']', '\n', '\r');
        var text = end < 0 ? cursor.Rest : cursor.Rest[..end];
        var count = 0;
        var isBetween = true;
        foreach (var character in text)
        {
            var isSeparator = character is ',' or ' ' or '\t';
            count += isBetween && !isSeparator ? 1 : 0;
            isBetween = isSeparator;
        }

        return count;
    }

    /// <summary>Parses <c>#</c>, or a function with the numbers of its arguments: <c>t.4</c>, <c>u.6.10</c>, <c>r.</c></summary>
    private bool ParseCall(Cursor cursor, int index, out Transformation transformation, out Cursor rest)
    {
        transformation = Transformation.Identity;
        if (cursor.Current == '#')
        {
            rest = cursor.Advance(1);
            return true;
        }

        Fail(cursor, "'#'");
        if (!ParseName(cursor, FractalMistakes.TransformationName, out var name, out rest))
        {
            return false;
        }

        var function = Names.FindFunction(cursor, name);
        var argumentCount = 0;
        if (!ParseChar(rest, '.', out rest))
        {
            return false;
        }

        while (char.IsAsciiDigit(rest.Current))
        {
            var start = rest;
            if (!ParseVectorNumber(rest, out var number, out var argument, out rest))
            {
                return false;
            }

            Numbers?.AddArgument(name, start, rest, number, argumentCount, function, index);
            if (argumentCount < MaxParameters)
            {
                _arguments[argumentCount] = argument;
            }

            argumentCount++;
            if (rest.Current != '.')
            {
                break;
            }

            rest = rest.Advance(1);
        }

        if (argumentCount != function.ParameterCount)
        {
            var hint = char.IsAsciiDigit(rest.Advance(1).Current) && rest.Current is ' ' or '\t' ? ": no blank stands within a call" : "";
            throw Error(cursor, $"'{name}' takes {ArgumentCountText(function.ParameterCount)}, not {argumentCount}{hint}");
        }

        if (function.Last.VectorNumber > _vectors.Count)
        {
            throw VectorError(function.Last.Start, $" above the call in line {Source.LineOf(cursor.Offset)}");
        }

        transformation = function.Apply(_arguments, _vectors);
        Hint(cursor, RotationUnits.DescribeRadians(transformation.Rotation));
        return ScaleCheck.IsInvertible(transformation.Scale)
            ? true
            : throw Error(cursor, ScaleCheck.SingularScaleMessage(transformation.Scale));
    }

    private static string ArgumentCountText(int count) => count == 1 ? "1 argument" : $"{count} arguments";

    /// <summary>Requires all vectors to be declared that functions without a call use.</summary>
    private protected void RequireVectors()
    {
        if (Names.Functions.FirstOrDefault(function => function.Last.VectorNumber > _vectors.Count) is { } uncalled)
        {
            throw VectorError(uncalled.Last.Start, "");
        }
    }

    private protected void RequireLimit(double? count, long limit, string owner, string things, Cursor cursor)
    {
        if (count > limit)
        {
            throw Error(cursor, $"{owner} has more than the limit of {limit} {things}", isLimitExceeded: true);
        }
    }
}
