using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Mistakes;

namespace FractalEngine.Parsing.Scenes;

/// <content>Parses the declarations of lights.</content>
public sealed partial class SceneParser
{
    // Largest exposure, and intensity of a light: their product, and its square, stay within what the shaders compute with.
    private const double MaxFactor = 1e9;

    private bool ParseLight(Cursor cursor, out Cursor rest)
    {
        if (ParseKeyword(cursor, "ambient", out rest))
        {
            return ParseColourAndIntensity(rest, out var colour, out var intensity, out rest)
                && AddLight(new AmbientLight(colour, intensity));
        }

        if (ParseKeyword(cursor, "directional", out rest))
        {
            return ParseDirection(rest, out var direction, out rest)
                && ParseColourAndIntensity(rest, out var colour, out var intensity, out rest)
                && AddLight(new DirectionalLight(direction, colour, intensity));
        }

        if (ParseKeyword(cursor, "point", out rest))
        {
            return ParseVectorAndSeparator(rest, out var position, out rest)
                && ParseColourIntensityAndRange(rest, out var colour, out var intensity, out var range, out rest)
                && AddLight(new PointLight(position, colour, intensity, range));
        }

        if (ParseKeyword(cursor, "spot", out rest))
        {
            return ParseVectorAndSeparator(rest, out var position, out rest)
                && ParseDirection(rest, out var direction, out rest) && ParseAngle(rest, out var angle, out rest)
                && ParseColourIntensityAndRange(rest, out var colour, out var intensity, out var range, out rest)
                && AddLight(new SpotLight(position, direction, angle, colour, intensity, range));
        }

        return false;
    }

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

    /// <summary>Parses a colour and an optional intensity, 1 by default.</summary>
    private bool ParseColourAndIntensity(Cursor cursor, out Colour colour, out double intensity, out Cursor rest)
    {
        intensity = 1;
        if (!ParseColour(cursor, out colour, out rest))
        {
            return false;
        }

        ParseOptionalSeparator(rest, out var intensityStart);
        return IsAtEndOfLine(intensityStart) || Fail(intensityStart, SyntaxFailure.EndOfLine)
            || ParseIntensity(intensityStart, out intensity, out rest);
    }

    private bool ParseColourIntensityAndRange(Cursor cursor, out Colour colour, out double intensity, out double range, out Cursor rest)
    {
        intensity = 0;
        range = 0;
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
        Require(intensity <= MaxFactor, cursor, "the intensity of a light must not exceed 1e9");
        return true;
    }
}
