using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Parses the calls of transformation functions in fractal files, and maps that stand in place of a call.</summary>
public abstract class CallParser : TransformationParser
{
    // The arguments of the call that is read.
    private readonly FractalValue[] _arguments = new FractalValue[MaxParameters];

    private protected CallParser(SourceText source, FractalNumberList? numbers, bool keepsSums)
        : base(source, numbers, keepsSums)
    {
    }

    /// <summary>
    /// Parses <c>#</c>, a function with its arguments, <c>t.4</c> or <c>u.up.(2, 0, k)</c>, or what one would return, <c>(up, #, (2))</c>.
    /// </summary>
    /// <param name="cursor">Position of the name.</param>
    /// <param name="index">Number of maps before it in the set.</param>
    /// <param name="map">Receives what the function makes of the arguments.</param>
    /// <param name="rest">Receives the position behind it.</param>
    private protected bool ParseCall(Cursor cursor, int index, out MapFactor map, out Cursor rest)
    {
        map = new(Transformation.Identity);
        if (cursor.Current == '#')
        {
            rest = cursor.Advance(1);
            return true;
        }

        if (cursor.Current == '(')
        {
            return ParseOutputs(cursor.Advance(1), null, out var unnamed, out rest) && Call(cursor, unnamed, out map);
        }

        if (!BeginsName(cursor))
        {
            Fail(cursor, "'#'");
            Fail(cursor, "'('");
        }

        if (!ParseName(cursor, FractalMistakes.TransformationName, out var name, out rest))
        {
            return false;
        }

        if (!Names.TryFindFunction(name, out var function))
        {
            throw TryFindValue(name, out var value)
                ? Error(cursor, $"'{name}' is a {(value.IsNumber ? "number" : "vector")}, and a set has calls of transformations")
                : Names.UnknownFunction(cursor, name);
        }

        if (!ParseChar(rest, '.', out rest) || !ParseArguments(name, function, index, out var argumentCount, ref rest))
        {
            return false;
        }

        if (argumentCount != function.Parameters.Count)
        {
            var hint = char.IsAsciiDigit(rest.Advance(1).Current) && rest.Current is ' ' or '\t' ? ": no blank stands within a call"
                : rest.Current is '-' or '+' ? $": a number stands in parentheses, as in '{name}.(-1)'" : "";
            throw Error(cursor, $"'{name}' takes {ArgumentCountText(function.Parameters.Count)}, not {argumentCount}{hint}");
        }

        return Call(cursor, function, out map);
    }

    /// <summary>Parses the arguments of a call, with dots between them and perhaps one behind.</summary>
    private bool ParseArguments(string name, TransformationFunction function, int index, out int count, ref Cursor rest)
    {
        var isFirst = true;
        for (count = 0; char.IsAsciiDigit(rest.Current) || rest.Current == '(' || BeginsName(rest); count++)
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
                Numbers?.AddArgument(name, start, rest, number, count, function, index, isFirst);
                isFirst = false;
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

    /// <summary>Computes the map of a call, whose arguments have been read.</summary>
    private bool Call(Cursor cursor, TransformationFunction function, out MapFactor map)
    {
        if (function.Matrix is { } matrix)
        {
            map = new(matrix);
            return true;
        }

        if (function.LastVectorNumber > Vectors.Count)
        {
            throw VectorError(function.Last.Start, $" above the call in line {Source.LineOf(cursor.Offset)}");
        }

        (Parameters, Arguments, CallOffset) = (function.Parameters, _arguments, cursor.Offset);
        var transformation = new Transformation(Resolve(function.Position), Resolve(function.Rotation), Resolve(function.Scale));
        var colour = default(MapColour);
        if (function.Colour is { } start)
        {
            ParseMapColour(start, out colour, out _);
        }

        map = new(transformation, colour);
        (Parameters, Arguments) = (FractalParameters.None, null);
        Hint(cursor, RotationUnits.DescribeRadians(transformation.Rotation));
        return ScaleCheck.IsInvertible(transformation.Scale)
            ? true
            : throw Error(cursor, ScaleCheck.SingularScaleMessage(transformation.Scale));
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
