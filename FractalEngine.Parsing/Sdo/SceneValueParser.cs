using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Parses the values in scene files: vectors, matrices and colours, with '#' for "no transformation".</summary>
/// <param name="source">Text that is parsed.</param>
public abstract class SceneValueParser(SourceText source) : Parser(source)
{
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
    protected void Require(bool condition, Cursor cursor, string message)
    {
        if (!condition)
        {
            throw Error(cursor, message);
        }
    }
}
