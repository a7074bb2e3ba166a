using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Sdo;

/// <summary>
/// Parses the values in scene files: vectors, matrices and colours, with '#' for "no transformation"; and options that may follow them.
/// </summary>
/// <param name="source">Text that is parsed.</param>
public abstract class SceneValueParser(SourceText source) : Parser(source)
{
    /// <summary>Parses what follows the keyword of an option, and changes the declaration by it.</summary>
    private protected delegate bool OptionParser<T>(Cursor cursor, ref T declared, out Cursor rest);

    /// <summary>Parses <c>(position, rotation, scale)</c>, each a vector or '#', or a single '#' for the identity.</summary>
    protected bool ParseMatrix(Cursor cursor, out Transformation placement, out Cursor rest)
    {
        placement = Transformation.Identity;
        if (cursor.Current == '#')
        {
            rest = cursor.Advance(1);
            return true;
        }

        if (cursor.Current != '(')
        {
            rest = cursor;
            Fail(cursor, "'('");
            return Fail(cursor, "'#'");
        }

        ParseBlanks(cursor.Advance(1), out rest);
        if (!ParseVectorOrDefault(rest, Vector.Zero, out var position, out rest) || !ParseSeparator(rest, out var rotationStart)
            || !ParseVectorOrDefault(rotationStart, Vector.Zero, out var rotation, out rest) || !ParseSeparator(rest, out var scaleStart)
            || !ParseVectorOrDefault(scaleStart, Vector.One, out var scale, out rest)
            || !ParseBlanks(rest, out rest) || !ParseChar(rest, ')', out rest))
        {
            return false;
        }

        placement = new(position, rotation, scale);
        Hint(rotationStart, RotationUnits.DescribeRadians(rotation));
        Require(ScaleCheck.IsInvertible(scale), scaleStart, ScaleCheck.SingularScaleMessage(scale));
        return true;
    }

    /// <summary>Parses a vector, or '#' for the given default.</summary>
    protected bool ParseVectorOrDefault(Cursor cursor, Vector defaultValue, out Vector vector, out Cursor rest)
    {
        vector = defaultValue;
        if (cursor.Current == '#')
        {
            rest = cursor.Advance(1);
            return true;
        }

        Fail(cursor, "'#'");
        return ParseVector(cursor, out vector, out rest);
    }

    /// <summary>Parses a given word and the blanks behind it.</summary>
    protected bool ParseKeyword(Cursor cursor, string word, out Cursor rest) =>
        ParseWord(cursor, word, out rest) && ParseBlanks(rest, out rest);

    /// <summary>Parses an sRGB colour: three components from 0 to 1.</summary>
    protected bool ParseColour(Cursor cursor, out Colour colour, out Cursor rest)
    {
        if (cursor.Current != '(')
        {
            colour = default;
            rest = cursor;
            return Fail(cursor, "a colour (r, g, b)");
        }

        var success = ParseVector(cursor, out var vector, out rest);
        colour = new(vector.X, vector.Y, vector.Z);
        Require(
            !success || (Vector.Min(vector, Vector.Zero) == Vector.Zero && Vector.Max(vector, Vector.One) == Vector.One),
            cursor, "the components of a colour must lie between 0 and 1");
        return success;
    }

    /// <summary>Parses a vector and an optional separator behind it.</summary>
    protected bool ParseVectorAndSeparator(Cursor cursor, out Vector vector, out Cursor rest) =>
        ParseVector(cursor, out vector, out rest) && ParseOptionalSeparator(rest, out rest);

    /// <summary>Parses an optional separator, for use between values of which one has parentheses. Always returns true.</summary>
    protected bool ParseOptionalSeparator(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        return rest.Current != ',' || ParseBlanks(rest.Advance(1), out rest);
    }

    /// <summary>Parses a number that must meet a condition.</summary>
    /// <exception cref="SourceException">The number does not meet it: <paramref name="fault"/> is the message.</exception>
    private protected bool ParseNumber(Cursor cursor, Func<double, bool> isValid, string fault, out double number, out Cursor rest)
    {
        var success = ParseNumber(cursor, out number, out rest);
        Require(!success || isValid(number), cursor, fault);
        return success;
    }

    /// <summary>Throws an exception for a value that has no valid meaning, unless the condition holds.</summary>
    protected void Require(bool condition, Cursor cursor, string message) => ThrowIf(!condition, cursor, message);

    /// <summary>Returns a parser of a number that must meet a condition, with the message for one that does not.</summary>
    private protected ItemParser<double> Number(Func<double, bool> isValid, string fault) =>
        (cursor, out number, out rest) => ParseNumber(cursor, isValid, fault, out number, out rest);

    /// <summary>Returns a parser of a number that must not be negative.</summary>
    private protected ItemParser<double> NonNegative(string quantity) =>
        (cursor, out number, out rest) => ParseNonNegative(cursor, quantity, out number, out rest);

    /// <summary>Parses a number that must not be negative.</summary>
    /// <exception cref="SourceException">It is, which the message tells of the quantity.</exception>
    private protected bool ParseNonNegative(Cursor cursor, string quantity, out double number, out Cursor rest) =>
        ParseNumber(cursor, static number => number >= 0, $"{quantity} must not be negative", out number, out rest);

    /// <summary>Parses a colour at the end of a line, if there is one.</summary>
    private protected bool ParseOptionalColour(Cursor cursor, out Colour? colour, out Cursor rest)
    {
        colour = null;
        rest = cursor;
        ParseOptionalSeparator(cursor, out var start);
        if (EndsAt(start))
        {
            return true;
        }

        var success = ParseColour(start, out var parsed, out rest);
        colour = parsed;
        return success;
    }

    /// <summary>Returns whether the declaration ends here. Where it does not, its end counts as expected.</summary>
    private protected bool EndsAt(Cursor cursor) => IsAtEndOfLine(cursor) || Fail(cursor, SyntaxFailure.EndOfLine);

    /// <summary>Parses all options that follow a declaration; there may be none.</summary>
    /// <param name="cursor">Position behind the declaration.</param>
    /// <param name="declared">The declaration without options.</param>
    /// <param name="options">Options that it may have, and those of others.</param>
    /// <param name="rest">Position behind the last option.</param>
    /// <returns>The declaration with its options.</returns>
    /// <exception cref="SourceException">An option has a faulty value.</exception>
    private protected T ParseOptions<T>(Cursor cursor, T declared, Option<T>[] options, out Cursor rest)
    {
        rest = cursor;
        while (ParseBlankOrEndOfLine(rest, out var start) && FindOption(start, options, out var valueStart) is { } option)
        {
            if (!option.Parse(valueStart, ref declared, out rest))
            {
                throw SyntaxError();
            }
        }

        return declared;
    }

    /// <summary>Returns the option whose keyword stands here, and the position of its value; null if there is none.</summary>
    private Option<T>? FindOption<T>(Cursor cursor, Option<T>[] options, out Cursor rest)
    {
        foreach (var option in options)
        {
            if (option.Owners is null && ParseKeyword(cursor, option.Keyword, out rest))
            {
                return option;
            }

            // The message is made at a fault only: scenes have a hundred thousand objects.
            if (option.Owners is not null && cursor.Rest.StartsWith(option.Keyword, StringComparison.Ordinal)
                && cursor.Peek(option.Keyword.Length) == ' ')
            {
                throw Error(cursor, $"unexpected '{option.Keyword}': it is an option of {option.Owners}");
            }
        }

        rest = cursor;
        return null;
    }

    /// <summary>Parses the blank before an option, which may be missing at the end of the line.</summary>
    private bool ParseBlankOrEndOfLine(Cursor cursor, out Cursor rest) =>
        ParseBlanks(cursor, out rest) && (rest.Offset > cursor.Offset || IsAtEndOfLine(rest) || Fail(rest, "a blank"));

    /// <summary>An option that may follow a declaration on its line.</summary>
    /// <param name="Keyword">The word that the option begins with.</param>
    /// <param name="Parse">Parses what follows.</param>
    /// <param name="Owners">Other declarations, which alone have the option; null where it may follow.</param>
    private protected sealed record Option<T>(string Keyword, OptionParser<T> Parse, string? Owners = null)
    {
        /// <summary>Creates an option of one value.</summary>
        /// <param name="keyword">The word that the option begins with.</param>
        /// <param name="parse">Parses the value.</param>
        /// <param name="with">Returns the declaration with the value.</param>
        public static Option<T> Of<TValue>(string keyword, ItemParser<TValue> parse, Func<T, TValue, T> with) => new(
            keyword, (cursor, ref declared, out rest) =>
                parse(cursor, out var value, out rest) && Set(ref declared, with(declared, value)));
    }
}
