using System.Collections.Immutable;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Points;

/// <summary>
/// Reads lists of rays: origin and direction, six numbers per line, separated by blanks or commas. <c>#</c> starts a comment.
/// </summary>
public sealed class RaysParser : Parser
{
    private RaysParser(SourceText source)
        : base(source)
    {
    }

    /// <summary>Parses a whole file of rays.</summary>
    /// <returns>Rays in the order of the file; there may be none. Directions have any length but 0.</returns>
    /// <exception cref="SourceException">A line holds something else, a direction of length 0, or a number out of range.</exception>
    public static ImmutableArray<Ray> Parse(SourceText source)
    {
        var parser = new RaysParser(source);
        return parser.ParseLines<Ray>(parser.ParseRay);
    }

    private bool ParseRay(Cursor start, out Ray ray, out Cursor rest)
    {
        ray = default;
        if (!ParseComponents(start, out var origin, out rest))
        {
            return false;
        }

        ParseBlanks(rest, out var directionStart);
        if (!ParseNextNumber(rest, out var x, out rest) || !ParseNextNumber(rest, out var y, out rest)
            || !ParseNextNumber(rest, out var z, out rest))
        {
            return false;
        }

        var direction = new Vector(x, y, z);
        if (origin.MaxAbsComponent() > RayCaster.MaxCoordinate)
        {
            throw Error(start, $"a coordinate is beyond the limit of {RayCaster.MaxCoordinate:R} for rays", isLimitExceeded: true);
        }

        if (direction.MaxAbsComponent() > Collider.MaxCoordinate)
        {
            throw Error(
                directionStart, $"a direction is beyond the limit of {Collider.MaxCoordinate:R} for lengths", isLimitExceeded: true);
        }

        ThrowIf(direction == Vector.Zero, directionStart, "a direction of length 0");
        ray = new(origin, direction);
        return true;
    }
}
