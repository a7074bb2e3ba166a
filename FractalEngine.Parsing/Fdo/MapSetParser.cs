using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Parses the sets of fractal files: calls of transformation functions, and their powers and products.</summary>
public abstract class MapSetParser : TransformationParser
{
    // The arguments of the call that is read.
    private readonly FractalValue[] _arguments = new FractalValue[MaxParameters];
    private long _mapCount;

    private protected MapSetParser(SourceText source, FractalNumberList? numbers)
        : base(source, numbers)
    {
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

        if (!Names.HasFunction(name) && TryFindValue(name, out var value))
        {
            throw Error(cursor, $"'{name}' is a {(value.IsNumber ? "number" : "vector")}, and a set has calls of transformations");
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

        if (function.Last.VectorNumber > Vectors.Count)
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

        return output.VectorNumber is { } number ? Vectors[number - 1]
            : output.HasParameters && ParseVectorValue(output.Start, null, null, out var computed, out _) ? computed
            : output.Value;
    }

    private static string ArgumentCountText(int count) => count == 1 ? "1 argument" : $"{count} arguments";
}
