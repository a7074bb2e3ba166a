using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Parses the sets of fractal files: maps, their powers and products.</summary>
public abstract class MapSetParser : CallParser
{
    private long _mapCount;

    private protected MapSetParser(SourceText source, FractalNumberList? numbers, bool keepsSums)
        : base(source, numbers, keepsSums)
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
        if (!ParseMapProduct(cursor, maps.Count, out var product, out rest))
        {
            return false;
        }

        Count(product.Count, rest);
        maps.Add(in product);
        return true;
    }

    /// <summary>Parses maps of which the right one is applied first, as in <c>m^2 * r.^2</c>.</summary>
    private bool ParseMapProduct(Cursor cursor, int index, out MapFactor product, out Cursor rest)
    {
        if (!ParseFactor(cursor, index, out product, out rest))
        {
            return false;
        }

        while (rest.Current is not (',' or ']') && ParseBlanks(rest, out var sign) && sign.Current == '*')
        {
            if (!ParseBlanks(sign.Advance(1), out rest) || !ParseFactor(rest, index, out var factor, out rest))
            {
                return false;
            }

            // Each product of many factors is work, though few of the maps are kept.
            RequireMapCount((long)product.Count * factor.Count, sign);
            Count(product.Count, sign);
            product = product.Times(in factor);
            RequireInvertible(sign, product.Maps);
        }

        return true;
    }

    /// <summary>Parses a call or a product in parentheses, and its powers.</summary>
    private bool ParseFactor(Cursor cursor, int index, out MapFactor factor, out Cursor rest) =>
        (cursor.Current == '(' && Parentheses.HoldProduct(cursor.Rest) ? ParseGroup(cursor, index, out factor, out rest)
            : ParseCall(cursor, index, out factor, out rest))
        && ParseMapPower(rest, ref factor, out rest);

    private bool ParseGroup(Cursor cursor, int index, out MapFactor product, out Cursor rest)
    {
        Nest(cursor);
        ParseBlanks(cursor.Advance(1), out rest);
        var isParsed = ParseMapProduct(rest, index, out product, out rest) && ParseBlanks(rest, out rest) && ParseChar(rest, ')', out rest);
        Unnest();
        return isParsed;
    }

    /// <summary>Parses the power of a map, or the range of its powers, if there is one: <c>^-2..2</c>.</summary>
    private bool ParseMapPower(Cursor cursor, ref MapFactor power, out Cursor rest)
    {
        rest = cursor;
        if (cursor.Current != '^')
        {
            return true;
        }

        ThrowIf(power.Count > 1, cursor, $"a power is that of one map, not of {power.Count}: powers of each stand in the parentheses");
        if (!ParseMapExponent(cursor.Advance(1), out var from, out rest))
        {
            return false;
        }

        var to = from;
        if (rest.Current == '.' && rest.Peek(1) == '.' && !ParseMapExponent(rest.Advance(2), out to, out rest))
        {
            return false;
        }

        ThrowIf(to < from, cursor, "a range of powers begins at the smaller one, as in '^-2..2'");
        RequireMapCount((long)to - from + 1, cursor);
        ThrowIf(from < 0 && power.HasColours, cursor, "a map with a colour has no powers below 0: what is mixed in can't be taken out");
        power = power.ToPowers(from, to);
        RequireInvertible(cursor, power.Maps);
        return true;
    }

    private void Count(int count, Cursor cursor)
    {
        RequireMapCount(count, cursor);
        _mapCount += count;
    }

    private void RequireMapCount(long count, Cursor cursor) =>
        RequireLimit(_mapCount + count, ParsingLimits.Maps.Value, "the file", "transformations in all sets", cursor);

    /// <summary>Parses the exponent of a map: an integer, or an expression in parentheses.</summary>
    private bool ParseMapExponent(Cursor cursor, out int exponent, out Cursor rest)
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

        ThrowIf(Math.Floor(value) != value, cursor, FormattableString.Invariant($"the power of a map is a whole number, not {value:R}"));
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
}
