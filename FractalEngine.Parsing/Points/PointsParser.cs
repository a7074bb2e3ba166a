using System.Collections.Immutable;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Points;

/// <summary>Reads lists of points: three numbers per line, separated by blanks or commas. <c>#</c> starts a comment.</summary>
public sealed class PointsParser : Parser
{
    private PointsParser(SourceText source)
        : base(source)
    {
    }

    /// <summary>Parses a whole file of points.</summary>
    /// <returns>Points in the order of the file; there may be none.</returns>
    /// <exception cref="SourceException">A line holds something else, or a number out of the range of a double.</exception>
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
            var start = rest;
            if (!ParseComponents(rest, out var point, out rest))
            {
                return false;
            }

            if (point.MaxAbsComponent() > Collider.MaxCoordinate)
            {
                throw Error(start, $"a coordinate is beyond the limit of {Collider.MaxCoordinate:R} for distances", isLimitExceeded: true);
            }

            points.Add(point);
        }

        return ParseCommentAndEndOfLine(rest, out rest);
    }
}
