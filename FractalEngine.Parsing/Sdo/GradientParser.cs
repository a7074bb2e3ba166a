using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Parses gradients, which objects of scenes have, and fractals.</summary>
/// <param name="source">Text that is parsed.</param>
public abstract class GradientParser(SourceText source) : SceneValueParser(source)
{
    private static readonly (GradientKind Kind, string Word)[] GradientKinds =
    [
        .. Enum.GetValues<GradientKind>().Except([GradientKind.None]).Select(static kind => (kind, SceneFormatter.WordOf(kind))),
    ];

    // Nothing glows brighter than the brightest light of a scene.
    private static readonly (string Word, double Maximum, string Fault, Func<Gradient, GradientRange, Gradient> With)[] SurfaceRanges =
    [
        ("roughness", 1, "the roughness must lie between 0 and 1", static (gradient, range) => gradient with { Roughness = range }),
        ("metal", 1, "the share of metal must lie between 0 and 1", static (gradient, range) => gradient with { Metalness = range }),
        ("glow", 1e9, "the glow must lie between 0 and 1e9", static (gradient, range) => gradient with { Glow = range }),
    ];

    /// <summary>Parses a gradient in the text of a fractal.</summary>
    /// <param name="source">The text.</param>
    /// <param name="cursor">Behind the keyword and its blanks.</param>
    /// <param name="rest">Receives the position behind the gradient.</param>
    /// <exception cref="SourceException">There is no gradient.</exception>
    internal static Gradient ParseIn(SourceText source, Cursor cursor, out Cursor rest)
    {
        var parser = new FractalGradientParser(source);
        return parser.ParseGradedSurface(cursor, out var gradient, out rest) ? gradient : throw parser.SyntaxError();
    }

    /// <summary>Parses a gradient, and what it makes of surfaces besides their colour.</summary>
    private protected bool ParseGradedSurface(Cursor cursor, out Gradient gradient, out Cursor rest)
    {
        var isFound = ParseGradient(cursor, out gradient, out rest);
        if (!isFound)
        {
            return false;
        }

        while (isFound)
        {
            isFound = false;
            foreach (var (word, maximum, fault, with) in SurfaceRanges)
            {
                if (ParseNextKeyword(rest, word, true, out var start))
                {
                    if (!ParseRange(start, maximum, fault, out var range, out rest))
                    {
                        return false;
                    }

                    gradient = with(gradient, range);
                    isFound = true;
                }
            }
        }

        return true;
    }

    private bool ParseRange(Cursor cursor, double maximum, string fault, out GradientRange range, out Cursor rest)
    {
        var last = 0.0;
        var success = ParseNumber(cursor, number => number >= 0 && number <= maximum, fault, out var first, out rest)
            && ParseSeparator(rest, out rest)
            && ParseNumber(rest, number => number >= 0 && number <= maximum, fault, out last, out rest);
        range = new(first, last);
        return success;
    }

    private bool ParseGradient(Cursor cursor, out Gradient gradient, out Cursor rest)
    {
        gradient = new(GradientKind.None, Colour.White);
        if (!ParseChoice(cursor, GradientKinds, out var kind, out rest) || !ParseBlanks(rest, out rest))
        {
            return false;
        }

        var start = rest;
        if (ParseString(start, "the name of a palette in quotes", out var name, out rest))
        {
            var named = NamedPalettes.Find(name);
            Require(
                named is not null, start,
                $"there is no palette '{name}'; there are: {string.Join(", ", NamedPalettes.All.Select(static known => known.Name))}");
            gradient = Gradient.Of(kind, named!);
            return true;
        }

        if (BeginsNumber(start))
        {
            return ParseStops(start, out var stops, out rest) && Set(ref gradient, Gradient.Of(kind, new([.. stops])));
        }

        var colours = new List<Colour>();
        do
        {
            if (!ParseColour(start, out var colour, out rest))
            {
                return colours.Count == 0 && Fail(start, SyntaxFailure.Number);
            }

            colours.Add(colour);
            ParseOptionalSeparator(rest, out start);
        }
        while (start.Current == '(');
        gradient = colours.Count == 1 ? new(kind, colours[0]) : Gradient.Of(kind, Palette.OfEven(colours));
        return true;
    }

    private static bool BeginsNumber(Cursor cursor) => char.IsAsciiDigit(cursor.Current) || cursor.Current is '.' or '-' or '+';

    /// <summary>Parses the stops of a palette, each with its position.</summary>
    private bool ParseStops(Cursor cursor, out List<PaletteStop> stops, out Cursor rest)
    {
        stops = [];
        rest = cursor;
        for (var start = cursor; BeginsNumber(start); ParseOptionalSeparator(rest, out start))
        {
            var last = stops.Count == 0 ? 0 : stops[^1].Position;
            if (!ParseNumber(
                    start, number => number >= last && number <= 1, "the positions of a palette must ascend from 0 to 1",
                    out var position, out rest)
                || !ParseOptionalSeparator(rest, out rest) || !ParseColour(rest, out var colour, out rest))
            {
                return false;
            }

            stops.Add(new(position, colour));
        }

        Require(stops.Count > 1, cursor, "a palette has two stops or more");
        return true;
    }

    /// <summary>Parses a keyword that may follow a value; without it nothing is read.</summary>
    private protected bool ParseNextKeyword(Cursor cursor, string word, bool followsValue, out Cursor rest)
    {
        rest = cursor;
        return (!followsValue || (ParseBlanks(cursor, out rest) && rest.Offset > cursor.Offset)) && ParseKeyword(rest, word, out rest);
    }

    private sealed class FractalGradientParser(SourceText source) : GradientParser(source);
}
