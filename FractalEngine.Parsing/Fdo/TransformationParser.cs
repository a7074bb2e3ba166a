using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Parses the vectors and transformation functions of fractal files, and the sets that call these.</summary>
public abstract class TransformationParser : ExpressionParser
{
    private const int MaxParameters = 3;

    private readonly List<Vector> _vectors = [];

    // The arguments of the call that is read.
    private readonly FractalValue[] _arguments = new FractalValue[MaxParameters];
    private (int Offset, string Name)? _unknownOutput;
    private long _mapCount;

    private protected TransformationParser(SourceText source, FractalNumberList? numbers)
        : base(source, numbers) => Names = new(source);

    /// <summary>The names of objects and transformations that were declared so far.</summary>
    private protected DeclaredNames Names { get; }

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
        Names.Add(cursor, name, new TransformationFunction(FractalParameters.None, default, default, default) { Matrix = map });
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
            || !ParseParameters(rest, out var parameters, out rest) || !ParseBlanks(rest, out rest) || !ParseChar(rest, '(', out rest))
        {
            return false;
        }

        Parameters = new(parameters);
        var isParsed = ParseOutputs(rest, name, out var function, out rest);
        Parameters = FractalParameters.None;
        if (isParsed)
        {
            Names.Add(cursor, name, function);
        }

        return isParsed;
    }

    private bool ParseOutputs(Cursor cursor, string name, out TransformationFunction function, out Cursor rest)
    {
        function = new(Parameters, default, default, default);
        if (!ParseBlanks(cursor, out rest) || !ParseOutput(rest, name, FractalNumberRole.Position, out var position, out rest)
            || !ParseSeparator(rest, out rest) || !ParseOutput(rest, name, FractalNumberRole.Rotation, out var rotation, out rest)
            || !ParseSeparator(rest, out rest) || !ParseOutput(rest, name, FractalNumberRole.Scale, out var scale, out rest)
            || !ParseBlanks(rest, out rest) || !ParseChar(rest, ')', out rest))
        {
            return false;
        }

        function = new(Parameters, position, rotation, scale);
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

    private bool ParseOutput(Cursor cursor, string function, FractalNumberRole role, out FunctionOutput output, out Cursor rest)
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

        if (char.IsLetter(cursor.Current) && ParseName(cursor, "a parameter", out var name, out var afterName))
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
            : $"it is not declared{place}, and numbers stand in parentheses";
        return Error(start, $"vector {TextBetween(start, end)} of {_vectors.Count}: {fault}");
    }

    /// <summary>Parses a set of maps: <c>[#, t.1, u.up.(2), s.^0..3 * r.]</c>.</summary>
    private protected bool ParseSet(Cursor cursor, out TransformationSet set, out Cursor rest)
    {
        set = new(ImmutableArray<Transformation>.Empty);
        if (!ParseChar(cursor, '[', out rest) || !ParseBlanks(rest, out rest))
        {
            return false;
        }

        var maps = new MapCollector((int)Math.Min(CountCalls(rest), ParsingLimits.Maps.Value));
        for (var first = true; rest.Current != ']'; first = false)
        {
            if ((!first && !ParseSeparator(rest, out rest)) || !ParseMaps(rest, maps, out rest))
            {
                return false;
            }

            if (ParseBlanks(rest, out var next) && next.Current == ']')
            {
                rest = next;
            }
        }

        Numbers?.EndSet(maps.Count);
        set = maps.ToSet();
        return ParseChar(rest, ']', out rest);
    }

    /// <summary>Parses one entry of a set, and adds its maps: a call, which most entries are, or a product.</summary>
    private bool ParseMaps(Cursor cursor, MapCollector maps, out Cursor rest)
    {
        if (!ParseCall(cursor, maps.Count, out var transformation, out var matrix, out rest))
        {
            return false;
        }

        if (matrix is null && rest.Current is ',' or ']')
        {
            RequireMapCount(1, rest);
            _mapCount++;
            maps.Add(in transformation);
            return true;
        }

        if (!ParseProduct(rest, FactorOf(in transformation, matrix), maps.Count, out var product, out rest))
        {
            return false;
        }

        RequireMapCount(product.Count, rest);
        _mapCount += product.Count;
        maps.Add(in product);
        return true;
    }

    private static MapFactor FactorOf(in Transformation transformation, TransformationFunction? matrix) =>
        matrix?.Matrix is { } map ? new([map]) : new(transformation);

    /// <summary>Parses what follows a call: powers, and maps that are applied before it, as in <c>m^2 * r.^2</c>.</summary>
    private bool ParseProduct(Cursor cursor, MapFactor first, int index, out MapFactor product, out Cursor rest)
    {
        product = first;
        if (!ParsePower(cursor, ref product, out rest))
        {
            return false;
        }

        while (ParseBlanks(rest, out var sign) && sign.Current == '*')
        {
            if (!ParseBlanks(sign.Advance(1), out rest) || !ParseCall(rest, index, out var transformation, out var matrix, out rest))
            {
                return false;
            }

            var factor = FactorOf(in transformation, matrix);
            if (!ParsePower(rest, ref factor, out rest))
            {
                return false;
            }

            RequireMapCount((long)product.Count * factor.Count, sign);
            product = product.Times(in factor);
            RequireInvertible(sign, product.Maps);
        }

        return true;
    }

    /// <summary>Parses the power of a map, or the range of its powers, if there is one: <c>^-2..2</c>.</summary>
    private bool ParsePower(Cursor cursor, ref MapFactor power, out Cursor rest)
    {
        rest = cursor;
        if (cursor.Current != '^')
        {
            return true;
        }

        if (!ParseExponent(cursor.Advance(1), out var from, out rest))
        {
            return false;
        }

        var to = from;
        if (rest.Current == '.' && rest.Peek(1) == '.' && !ParseExponent(rest.Advance(2), out to, out rest))
        {
            return false;
        }

        if (to < from)
        {
            throw Error(cursor, "a range of powers begins at the smaller one, as in '^-2..2'");
        }

        RequireMapCount((long)to - from + 1, cursor);
        power = power.ToPowers(from, to);
        RequireInvertible(cursor, power.Maps);
        return true;
    }

    private void RequireMapCount(long count, Cursor cursor) =>
        RequireLimit(_mapCount + count, ParsingLimits.Maps.Value, "the file", "transformations in all sets", cursor);

    /// <summary>Parses the exponent of a map: an integer, or an expression in parentheses.</summary>
    private bool ParseExponent(Cursor cursor, out int exponent, out Cursor rest)
    {
        exponent = 0;
        double value;
        if (cursor.Current == '(')
        {
            if (!ParseParenthesized(cursor, out value, out rest))
            {
                return false;
            }
        }
        else
        {
            var isNegative = cursor.Current == '-';
            var digits = isNegative ? cursor.Advance(1) : cursor;
            if (!ParseInteger(digits, "a whole number or an expression in parentheses", out var size, out rest))
            {
                return false;
            }

            value = isNegative ? -(double)size : size;
        }

        if (Math.Floor(value) != value)
        {
            throw Error(cursor, FormattableString.Invariant($"the power of a map is a whole number, not {value:R}"));
        }

        if (Math.Abs(value) > FractalLimits.Depth.Value)
        {
            throw Error(cursor, $"the power is more than the limit of {FractalLimits.Depth.Value}", isLimitExceeded: true);
        }

        exponent = (int)value;
        return true;
    }

    private void RequireInvertible(Cursor cursor, params ReadOnlySpan<AffineMap> maps)
    {
        for (var i = 0; i < maps.Length; i++)
        {
            if (ScaleCheck.FindFault(in maps[i]) is { } fault)
            {
                throw Error(cursor, $"{(maps.Length == 1 ? "the map" : $"map {i + 1} of these {maps.Length}")} {fault}");
            }
        }
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

    /// <summary>Parses <c>#</c>, or a function with its arguments: <c>t.4</c>, <c>u.up.(2, 0, k)</c>, <c>r.</c></summary>
    /// <param name="cursor">Position of the name.</param>
    /// <param name="index">Number of maps before it in the set.</param>
    /// <param name="transformation">Receives what the function makes of the arguments.</param>
    /// <param name="matrix">Receives the function where it is a matrix; null for others.</param>
    /// <param name="rest">Receives the position behind it.</param>
    private bool ParseCall(
        Cursor cursor, int index, out Transformation transformation, out TransformationFunction? matrix, out Cursor rest)
    {
        transformation = Transformation.Identity;
        matrix = null;
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
        if (!ParseChar(rest, '.', out rest) || !ParseArguments(name, function, index, out var argumentCount, ref rest))
        {
            return false;
        }

        if (argumentCount != function.Parameters.Count)
        {
            var hint = char.IsAsciiDigit(rest.Advance(1).Current) && rest.Current is ' ' or '\t' ? ": no blank stands within a call" : "";
            throw Error(cursor, $"'{name}' takes {ArgumentCountText(function.Parameters.Count)}, not {argumentCount}{hint}");
        }

        if (function.Last.VectorNumber > _vectors.Count)
        {
            throw VectorError(function.Last.Start, $" above the call in line {Source.LineOf(cursor.Offset)}");
        }

        if (function.Matrix is not null)
        {
            matrix = function;
            return true;
        }

        Apply(function, cursor.Offset, out transformation);
        Hint(cursor, RotationUnits.DescribeRadians(transformation.Rotation));
        return ScaleCheck.IsInvertible(transformation.Scale)
            ? true
            : throw Error(cursor, ScaleCheck.SingularScaleMessage(transformation.Scale));
    }

    /// <summary>Parses the arguments of a call, with dots between them and perhaps one behind.</summary>
    private bool ParseArguments(string name, TransformationFunction function, int index, out int count, ref Cursor rest)
    {
        for (count = 0; char.IsAsciiDigit(rest.Current) || rest.Current is '(' or '_' || char.IsLetter(rest.Current); count++)
        {
            var start = rest;
            var isNumber = count < function.Parameters.Count ? function.Parameters.IsNumber(count) : null;
            FractalValue argument;
            if (char.IsAsciiDigit(start.Current))
            {
                if (!ParseVectorNumber(start, out var number, out var vector, out rest))
                {
                    return false;
                }

                if (isNumber == true)
                {
                    throw Error(
                        start, $"the parameter '{function.Parameters.NameOf(count)}' of '{name}' is a number, as in '{name}.({number})'");
                }

                argument = new(vector, IsNumber: false);
                Numbers?.AddArgument(name, start, rest, number, count, function, index);
            }
            else if (!ParseArgument(start, name, function, count, isNumber, out argument, out rest))
            {
                return false;
            }

            if (count < MaxParameters)
            {
                _arguments[count] = argument;
            }

            if (rest.Current != '.')
            {
                count++;
                return true;
            }

            rest = rest.Advance(1);
        }

        return true;
    }

    private bool ParseArgument(
        Cursor cursor, string name, TransformationFunction function, int index, bool? isNumber, out FractalValue value, out Cursor rest)
    {
        value = default;
        if (cursor.Current == '(' && isNumber == true)
        {
            return ParseParenthesized(cursor, out var result, out rest) && Set(ref value, FractalValue.Of(result));
        }

        if (cursor.Current == '(')
        {
            return ParseVectorValue(cursor, null, null, out var vector, out rest) && Set(ref value, FractalValue.Of(vector));
        }

        if (!ParseName(cursor, "the name of a number or vector", out var valueName, out rest))
        {
            return false;
        }

        if (!TryFindValue(valueName, out value))
        {
            throw Error(cursor, $"the value '{valueName}' is not declared above{AskAboutValue(valueName, isNumber == true)}");
        }

        if (isNumber == true && !value.IsNumber)
        {
            throw Error(cursor, $"'{valueName}' is a vector, and '{function.Parameters.NameOf(index)}' of '{name}' is a number");
        }

        if (isNumber == false)
        {
            _ = RequireVector(cursor, valueName, value);
            Numbers?.AddRoles(valueName, index, function);
        }

        return true;
    }

    /// <summary>Parses a number in parentheses.</summary>
    private protected bool ParseParenthesized(Cursor cursor, out double value, out Cursor rest)
    {
        value = 0;
        if (!ParseChar(cursor, '(', out rest) || !ParseBlanks(rest, out rest) || !ParseExpression(rest, out value, out rest)
            || !ParseBlanks(rest, out rest))
        {
            return false;
        }

        return rest.Current != ',' ? ParseChar(rest, ')', out rest) : throw Error(cursor, "here stands a number, and this is a vector");
    }

    /// <summary>Computes the transformation of a call, whose arguments have been read.</summary>
    private void Apply(TransformationFunction function, int callOffset, out Transformation transformation)
    {
        (Parameters, Arguments, CallOffset) = (function.Parameters, _arguments, callOffset);
        transformation = new(Resolve(function.Position), Resolve(function.Rotation), Resolve(function.Scale));
        (Parameters, Arguments) = (FractalParameters.None, null);
    }

    private Vector Resolve(in FunctionOutput output)
    {
        if (output.Parameter is { } index)
        {
            return _arguments[index].Vector;
        }

        return output.VectorNumber is { } number ? _vectors[number - 1]
            : output.HasParameters && ParseVectorValue(output.Start, null, null, out var computed, out _) ? computed
            : output.Value;
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
}
