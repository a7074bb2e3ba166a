using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Points;

/// <summary>Reads lists of points: three numbers a line, blanks or commas between them; <c>#</c> starts a comment.</summary>
public sealed class PointsParser : Parser
{
    private PointsParser(SourceText source)
        : base(source)
    {
    }

    /// <summary>Parses a whole file.</summary>
    /// <returns>The points in order; there may be none.</returns>
    /// <exception cref="SourceException">A line holds something else, or a number that is not finite.</exception>
    public static ImmutableArray<Vector> Parse(SourceText source) => new PointsParser(source).ParseFile();

    private ImmutableArray<Vector> ParseFile()
    {
        var points = ImmutableArray.CreateBuilder<Vector>();
        for (var cursor = Source.Start; !cursor.IsAtEnd;)
        {
            if (!ParseLine(cursor, points, out cursor))
            {
                throw SyntaxError();
            }
        }

        return points.ToImmutable();
    }

    private bool ParseLine(Cursor cursor, ImmutableArray<Vector>.Builder points, out Cursor rest)
    {
        ParseBlanks(cursor, out rest);
        if (!IsAtEndOfLine(rest) && rest.Current != '#')
        {
            if (!ParseComponents(rest, out var point, out rest))
            {
                return false;
            }

            points.Add(point);
            ParseBlanks(rest, out rest);
        }

        if (rest.Current == '#')
        {
            rest = SkipLine(rest);
            return true;
        }

        return ParseEndOfLine(rest, out rest);
    }
}
