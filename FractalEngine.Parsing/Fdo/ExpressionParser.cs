using System.Collections.Immutable;
using FractalEngine.Core;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Fdo;

/// <summary>
/// Parses the named numbers and vectors of fractal files, and computes expressions while it reads them. A function is read again for each
/// call, with the values of its parameters.
/// </summary>
public abstract class ExpressionParser : Parser
{
    // Each pair of parentheses takes some frames of the stack.
    private const int MaxNesting = 100;

    private readonly Dictionary<string, (FractalValue Value, int Offset)> _values = [];
    private int _nesting;
    private long _termCount;

    private protected ExpressionParser(SourceText source, FractalNumberList? numbers)
        : base(source) => Numbers = numbers;

    /// <summary>Receives the numbers of the file; null where nobody asks for them.</summary>
    private protected FractalNumberList? Numbers { get; }

    /// <summary>Numbers that take the place of those that the file gives to its names.</summary>
    private protected IReadOnlyDictionary<string, double>? Overrides { get; init; }

    /// <summary>Names of the numbers that the file declares.</summary>
    private protected ImmutableArray<string> NumberNames => _values.Count == 0 ? []
        : [.. _values.Where(static declared => declared.Value.Value.IsNumber).Select(static declared => declared.Key)];

    /// <summary>The parameters of the function that is read.</summary>
    private protected FractalParameters Parameters { get; set; } = FractalParameters.None;

    /// <summary>The arguments of the call whose function is read; null in the declaration of the function.</summary>
    private protected FractalValue[]? Arguments { get; set; }

    /// <summary>Place of the call whose function is read again, for messages.</summary>
    private protected int CallOffset { get; set; }

    /// <inheritdoc/>
    /// <remarks>A comment that begins with <c>//</c> is blank too.</remarks>
    protected override bool ParseBlanks(Cursor cursor, out Cursor rest)
    {
        // Where there is neither, which is often, nothing is called.
        rest = cursor;
        return cursor.Current is not (' ' or '\t' or '/') || (base.ParseBlanks(cursor, out rest) && ParseComments(ref rest));
    }

    private static bool ParseComments(ref Cursor rest)
    {
        if (rest.Current == '/' && rest.Peek(1) == '/')
        {
            rest = rest.Advance(rest.RestOfLine.Length);
        }

        return true;
    }

    /// <summary>
    /// Parses <c>name = expression</c>, perhaps with <c>from expression to expression</c> behind it, or <c>name = (x, y, z)</c>.
    /// </summary>
    private protected bool ParseValueDeclaration(Cursor cursor, out Cursor rest)
    {
        if (!ParseName(cursor, "a declaration", out var name, out var behind) || !ParseBlanks(behind, out rest) || rest.Current != '=')
        {
            rest = cursor;
            return Fail(behind, "'='");
        }

        ParseBlanks(rest.Advance(1), out var start);
        if (!ParseValue(start, name, out var value, out rest))
        {
            return false;
        }

        var end = rest;
        (double From, double To)? range = null;
        ParseBlanks(rest, out var word);
        if (value.IsNumber && ParseWord(word, "from", out var from))
        {
            if (!ParseRange(from, out var ends, out rest))
            {
                return false;
            }

            range = ends;
        }

        if (value.IsNumber)
        {
            Numbers?.AddNamed(name, start, end, value.Number, range);
            value = Overrides?.TryGetValue(name, out var number) == true ? FractalValue.Of(number) : value;
        }

        RequireLimit(_values.Count + 1, ParsingLimits.Names.Value, "the file", "names", cursor);
        if (!_values.TryAdd(name, (value, cursor.Offset)))
        {
            throw Error(cursor, $"the value '{name}' is declared twice, first in line {Source.LineOf(_values[name].Offset)}");
        }

        return true;
    }

    private bool ParseRange(Cursor cursor, out (double From, double To) range, out Cursor rest)
    {
        range = default;
        if (!ParseBlanks(cursor, out rest) || !ParseExpression(rest, out var from, out rest) || !ParseBlanks(rest, out var word)
            || !ParseWord(word, "to", out rest) || !ParseBlanks(rest, out rest) || !ParseExpression(rest, out var to, out rest))
        {
            return false;
        }

        range = (from, to);
        return from < to ? true : throw Error(word, "a slider begins at the smaller number, as in 'from 0 to 90'");
    }

    /// <summary>Parses a number, or a vector of three; what is in parentheses alone is a number.</summary>
    private bool ParseValue(Cursor cursor, string name, out FractalValue value, out Cursor rest)
    {
        value = default;
        if (cursor.Current == '(' && ParseBlanks(cursor.Advance(1), out rest) && ParseExpression(rest, out _, out rest)
            && ParseBlanks(rest, out rest) && rest.Current == ',')
        {
            return ParseVectorValue(cursor, name, null, out var vector, out rest) && Set(ref value, FractalValue.Of(vector));
        }

        return ParseExpression(cursor, out var number, out rest) && Set(ref value, FractalValue.Of(number));
    }

    /// <summary>Finds a declared number or vector.</summary>
    private protected bool TryFindValue(string name, out FractalValue value)
    {
        var isFound = _values.TryGetValue(name, out var declared);
        value = declared.Value;
        return isFound;
    }

    /// <summary>Returns <c>: did you mean …?</c> for a name that no value has, or nothing.</summary>
    private protected string AskAboutValue(string name, bool isNumber) => NameSuggestion.Ask(
        name, _values.Where(declared => declared.Value.Value.IsNumber == isNumber).Select(static declared => declared.Key));

    /// <summary>Returns the vector that a name stands for.</summary>
    /// <exception cref="SourceException">The name is that of a number.</exception>
    private protected Vector RequireVector(Cursor cursor, string name, FractalValue value) => !value.IsNumber ? value.Vector
        : throw Error(cursor, $"'{name}' is a number, and here stands a vector: '({name})' has it three times");

    /// <summary>Parses <c>(x, y, z)</c>, or <c>(s)</c> for three equal components, with expressions.</summary>
    /// <param name="cursor">Position of the parenthesis.</param>
    /// <param name="name">Name under which components that are plain numbers are listed; null to list none.</param>
    /// <param name="role">What the components mean; null where it is not known yet.</param>
    /// <param name="vector">Receives the vector.</param>
    /// <param name="rest">Receives the position behind it.</param>
    private protected bool ParseVectorValue(Cursor cursor, string? name, FractalNumberRole? role, out Vector vector, out Cursor rest)
    {
        vector = default;
        if (!ParseChar(cursor, '(', out rest) || !ParseBlanks(rest, out var start) || !ParseExpression(start, out var x, out rest))
        {
            return false;
        }

        var end = rest;
        var (y, z) = (x, x);
        ParseBlanks(rest, out rest);
        var isEven = rest.Current != ',';
        AddComponent(name, role, 0, start, end, x, isEven);
        if (isEven)
        {
            Fail(rest, "','");
        }
        else
        {
            if (!ParseComponent(rest, name, role, 1, out y, out rest) || !ParseComponent(rest, name, role, 2, out z, out rest))
            {
                return false;
            }
        }

        vector = new(x, y, z);
        return ParseChar(rest, ')', out rest);
    }

    private bool ParseComponent(Cursor cursor, string? name, FractalNumberRole? role, int index, out double value, out Cursor rest)
    {
        value = 0;
        if (!ParseChar(cursor, ',', out rest) || !ParseBlanks(rest, out var start) || !ParseExpression(start, out value, out rest))
        {
            return false;
        }

        AddComponent(name, role, index, start, rest, value);
        return ParseBlanks(rest, out rest);
    }

    private void AddComponent(
        string? name, FractalNumberRole? role, int component, Cursor start, Cursor end, double value, bool isEven = false)
    {
        if (name is not null && NumberReader.TryRead(start.Rest, out _, out var length) && length == end.Offset - start.Offset)
        {
            Numbers?.AddComponent(name, component, start, end, value, role, isEven);
        }
    }

    /// <summary>Parses and computes an expression.</summary>
    /// <returns>False where the text is none.</returns>
    /// <exception cref="SourceException">It has no finite value, or a name is unknown.</exception>
    private protected bool ParseExpression(Cursor cursor, out double value, out Cursor rest)
    {
        if (!ParseProduct(cursor, out value, out rest))
        {
            return false;
        }

        while (ParseBlanks(rest, out var sign) && sign.Current is '+' or '-')
        {
            if (!ParseBlanks(sign.Advance(1), out rest) || !ParseProduct(rest, out var term, out rest))
            {
                return false;
            }

            value = Require(sign, sign.Current == '+' ? value + term : value - term, value, term);
        }

        return true;
    }

    /// <summary>Parses and computes a product or a single number, which ends before plus signs.</summary>
    private protected bool ParseProduct(Cursor cursor, out double value, out Cursor rest)
    {
        if (!ParseSigned(cursor, out value, out rest))
        {
            return false;
        }

        while (ParseBlanks(rest, out var sign) && sign.Current is '*' or '/')
        {
            if (!ParseBlanks(sign.Advance(1), out rest) || !ParseSigned(rest, out var factor, out rest))
            {
                return false;
            }

            value = sign.Current == '*' ? Require(sign, value * factor, value, factor)
                : factor != 0 ? Require(sign, value / factor, value, factor)
                : throw ValueError(sign, "division by zero");
        }

        return true;
    }

    private protected bool ParseSigned(Cursor cursor, out double value, out Cursor rest)
    {
        var sign = 1;
        for (rest = cursor; rest.Current is '-' or '+'; ParseBlanks(rest.Advance(1), out rest))
        {
            sign = rest.Current == '-' ? -sign : sign;
        }

        if (!ParsePower(rest, out value, out rest))
        {
            return false;
        }

        value *= sign;
        return true;
    }

    /// <summary>Parses a primary expression, and the power that it is raised to: from the right, before signs.</summary>
    private bool ParsePower(Cursor cursor, out double value, out Cursor rest)
    {
        Nest(cursor);
        var isParsed = ParsePrimary(cursor, out value, out rest) && ParseExponent(rest, ref value, out rest);
        Unnest();
        return isParsed;
    }

    /// <summary>Counts what is read within something of its kind, which takes stack.</summary>
    private protected void Nest(Cursor cursor)
    {
        if (++_nesting > MaxNesting)
        {
            throw Error(cursor, $"the expression is nested deeper than the limit of {MaxNesting}", isLimitExceeded: true);
        }
    }

    private protected void Unnest() => _nesting--;

    private bool ParseExponent(Cursor cursor, ref double value, out Cursor rest)
    {
        ParseBlanks(cursor, out var power);
        rest = cursor;
        if (power.Current != '^')
        {
            return true;
        }

        if (!ParseBlanks(power.Advance(1), out rest) || !ParseSigned(rest, out var exponent, out rest))
        {
            return false;
        }

        value = value == 0 && exponent < 0 ? throw ValueError(power, "division by zero: 0 has no negative powers")
            : Require(power, Math.Pow(value, exponent), value, exponent);
        return true;
    }

    private bool ParsePrimary(Cursor cursor, out double value, out Cursor rest)
    {
        value = 0;
        RequireLimit(++_termCount, ParsingLimits.ExpressionTerms.Value, "the file", "terms of expressions in all calls", cursor);
        if (cursor.Current == '(')
        {
            return ParseBlanks(cursor.Advance(1), out rest) && ParseExpression(rest, out value, out rest) && ParseBlanks(rest, out rest)
                && ParseChar(rest, ')', out rest);
        }

        Fail(cursor, "'('");
        if (BeginsName(cursor))
        {
            return ParseName(cursor, "a name", out var name, out rest) && ParseNamed(cursor, name, ref rest, out value);
        }

        Fail(cursor, "the name of a number");
        return ParseNumber(cursor, out value, out rest);
    }

    /// <summary>Finds the value of a name: a parameter, a number of the file, or a function with its arguments.</summary>
    private bool ParseNamed(Cursor cursor, string name, ref Cursor rest, out double value)
    {
        if (Parameters.IndexOf(name) is >= 0 and var parameter)
        {
            RequireUse(cursor, parameter, asNumber: true);
            value = Arguments is { } arguments ? arguments[parameter].Number : double.NaN;
            return true;
        }

        // A function that is read again for a call knows what it knew where it stands.
        if (_values.TryGetValue(name, out var declared) && declared.Offset < cursor.Offset)
        {
            value = declared.Value.Number;
            return declared.Value.IsNumber ? true : throw Error(cursor, $"'{name}' is a vector, and here stands a number");
        }

        return FractalFunctions.TryFind(name, out var argumentCount, out var compute)
            ? ParseFunctionArguments(cursor, argumentCount, compute, ref rest, out value)
            : throw Error(cursor, rest.Current == '('
                ? $"there is no function '{name}': functions are {string.Join(", ", FractalFunctions.Names)}"
                : $"the number '{name}' is not declared above{AskAboutNumber(name)}");
    }

    private string AskAboutNumber(string name)
    {
        var parts = name.Split('-', 2);
        return parts.Length == 2 && TryFindValue(parts[0], out _)
            ? $": '{name}' is one name, and a difference has blanks, as in '{parts[0]} - {parts[1]}'"
            : NameSuggestion.Ask(name, [.. NumberNames, "pi"]);
    }

    private bool ParseFunctionArguments(
        Cursor cursor, int count, Func<double, double, double> compute, ref Cursor rest, out double value)
    {
        value = compute(0, 0);
        if (count == 0)
        {
            return true;
        }

        var second = 0.0;
        if (!ParseChar(rest, '(', out rest) || !ParseBlanks(rest, out rest) || !ParseExpression(rest, out var first, out rest)
            || !ParseBlanks(rest, out rest))
        {
            return false;
        }

        if (count == 2 && (!ParseChar(rest, ',', out rest) || !ParseBlanks(rest, out rest) || !ParseExpression(rest, out second, out rest)
            || !ParseBlanks(rest, out rest)))
        {
            return false;
        }

        value = Require(cursor, compute(first, second), first, second);
        return ParseChar(rest, ')', out rest);
    }

    /// <summary>Requires a parameter to be used as a number everywhere, or as a vector.</summary>
    private protected void RequireUse(Cursor cursor, int parameter, bool asNumber)
    {
        if (!Parameters.TryUse(parameter, asNumber))
        {
            throw Error(cursor, $"the parameter '{Parameters.NameOf(parameter)}' is used as a vector and as a number");
        }
    }

    /// <summary>Requires a result to be finite, unless it is that of a parameter which is not known yet.</summary>
    private double Require(Cursor cursor, double value, double operand1, double operand2) =>
        double.IsFinite(value) || double.IsNaN(operand1) || double.IsNaN(operand2) ? value
            : throw ValueError(cursor, double.IsNaN(value) ? "the result is no real number" : "the result is beyond the range of a double");

    /// <summary>Creates the error of an expression that has no value, perhaps for the arguments of a call only.</summary>
    private SourceException ValueError(Cursor cursor, string message) =>
        Error(cursor, Arguments is null ? message : $"{message}, in the call in line {Source.LineOf(CallOffset)}");

    private protected void RequireLimit(double? count, long limit, string owner, string things, Cursor cursor)
    {
        if (count > limit)
        {
            throw Error(cursor, $"{owner} has more than the limit of {limit} {things}", isLimitExceeded: true);
        }
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
}
