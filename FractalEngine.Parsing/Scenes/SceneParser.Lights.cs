using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Scenes;

/// <content>Lights.</content>
public sealed partial class SceneParser
{
    private bool ParseLight(Cursor cursor, out Cursor rest) =>
        (ParseLightKind(cursor, "ambient", out rest)
        && ParseColourAndIntensity(rest, out var ambientColour, out var ambientIntensity, out rest)
            && AddLight(new AmbientLight(ambientColour, ambientIntensity)))
        || (ParseLightKind(cursor, "directional", out rest) && ParseDirection(rest, out var direction, out rest)
            && ParseColourAndIntensity(rest, out var colour, out var intensity, out rest)
            && AddLight(new DirectionalLight(direction, colour, intensity)))
        || (ParseLightKind(cursor, "point", out rest) && ParseVectorAndSeparator(rest, out var position, out rest)
            && ParseColourIntensityAndRange(rest, out colour, out intensity, out var range, out rest)
            && AddLight(new PointLight(position, colour, intensity, range)))
        || (ParseLightKind(cursor, "spot", out rest) && ParseVectorAndSeparator(rest, out position, out rest)
            && ParseDirection(rest, out direction, out rest) && ParseAngle(rest, out var angle, out rest)
            && ParseColourIntensityAndRange(rest, out colour, out intensity, out range, out rest)
            && AddLight(new SpotLight(position, direction, angle, colour, intensity, range)));

    private bool ParseLightKind(Cursor cursor, string kind, out Cursor rest) => ParseKeyword(cursor, kind, out rest);

    private bool AddLight(Light light)
    {
        _lights.Add(light);
        return true;
    }

    private bool ParseDirection(Cursor cursor, out Vector direction, out Cursor rest)
    {
        if (!ParseVectorAndSeparator(cursor, out direction, out rest))
        {
            return false;
        }

        Require(direction != Vector.Zero, cursor, "a direction must not be (0, 0, 0)");
        return true;
    }

    private bool ParseAngle(Cursor cursor, out double angle, out Cursor rest)
    {
        if (!ParseNumber(cursor, out angle, out rest) || !ParseOptionalSeparator(rest, out rest))
        {
            return false;
        }

        Require(angle is > 0 and < 180, cursor, "the angle of the cone must lie between 0 and 180 degrees");
        return true;
    }

    /// <summary>A colour and an intensity, 1 where none is written.</summary>
    private bool ParseColourAndIntensity(Cursor cursor, out Colour colour, out double intensity, out Cursor rest)
    {
        intensity = 1;
        if (!ParseColour(cursor, out colour, out rest))
        {
            return false;
        }

        ParseOptionalSeparator(rest, out var intensityStart);
        return IsAtEndOfLine(intensityStart) || ParseIntensity(intensityStart, out intensity, out rest);
    }

    private bool ParseColourIntensityAndRange(Cursor cursor, out Colour colour, out double intensity, out double range, out Cursor rest)
    {
        (intensity, range) = (0, 0);
        if (!ParseColour(cursor, out colour, out rest) || !ParseOptionalSeparator(rest, out rest)
            || !ParseIntensity(rest, out intensity, out rest) || !ParseSeparator(rest, out var rangeStart)
            || !ParseNumber(rangeStart, out range, out rest))
        {
            return false;
        }

        Require(range > 0, rangeStart, "the range of a light must be positive");
        return true;
    }

    private bool ParseIntensity(Cursor cursor, out double intensity, out Cursor rest)
    {
        if (!ParseNumber(cursor, out intensity, out rest))
        {
            return false;
        }

        Require(intensity >= 0, cursor, "the intensity of a light must not be negative");
        return true;
    }
}
