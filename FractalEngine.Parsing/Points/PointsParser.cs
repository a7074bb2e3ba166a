using System.Collections.Immutable;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

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
    public static ImmutableArray<Vector> Parse(SourceText source)
    {
        var parser = new PointsParser(source);
        return parser.ParseLines<Vector>(parser.ParsePoint);
    }

    private bool ParsePoint(Cursor start, out Vector point, out Cursor rest)
    {
        if (!ParseComponents(start, out point, out rest))
        {
            return false;
        }

        return point.MaxAbsComponent() <= Collider.MaxCoordinate
            ? true
            : throw Error(start, $"a coordinate is beyond the limit of {Collider.MaxCoordinate:R} for distances", isLimitExceeded: true);
    }
}
