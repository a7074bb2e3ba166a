using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Sdo;

/// <content>Parses the sky, the sun, and how light is shown.</content>
public sealed partial class SceneParser
{
    private bool ParseSky(Cursor cursor, out Cursor rest)
    {
        return ParseColour(cursor, out var zenith, out rest) && ParseOptionalSeparator(rest, out rest)
            && ParseColour(rest, out var horizon, out rest) && ParseOptionalColour(rest, out var ground, out rest)
            && UpdateScene(_scene with { Sky = new(zenith, horizon, ground) });
    }

    private bool ParseSun(Cursor cursor, out Cursor rest)
    {
        if (!ParseDirection(cursor, out var direction, out rest) || !ParseColour(rest, out var colour, out rest)
            || !ParseOptionalSeparator(rest, out rest) || !ParseIntensity(rest, out var intensity, out rest))
        {
            return false;
        }

        var diameter = SunLight.DefaultDiameter;
        ParseOptionalSeparator(rest, out var diameterStart);
        if (!IsAtEndOfLine(diameterStart) && !Fail(diameterStart, SyntaxFailure.EndOfLine)
            && !ParseNumber(diameterStart, static number => number is >= 0 and < 90,
                "the diameter of the sun must be at least 0 and less than 90 degrees", out diameter, out rest))
        {
            return false;
        }

        return AddLight(new SunLight(direction, colour, intensity, diameter));
    }

    private bool ParseExposure(Cursor cursor, out Cursor rest)
    {
        if (!ParseNumber(cursor, static number => number > 0, "the exposure must be positive", out var exposure, out rest))
        {
            return false;
        }

        Require(exposure is >= 1e-9 and <= MaxFactor, cursor, "the exposure must lie between 1e-9 and 1e9");
        return UpdateScene(_scene with { Exposure = exposure });
    }

    private bool ParseTone(Cursor cursor, out Cursor rest)
    {
        return (ParseWord(cursor, "none", out rest) && UpdateScene(_scene with { Tone = Tone.None }))
            || (ParseWord(cursor, "filmic", out rest) && UpdateScene(_scene with { Tone = Tone.Filmic }));
    }

    private bool ParseFog(Cursor cursor, out Cursor rest)
    {
        return ParseNonNegative(cursor, "the density of fog", out var density, out rest)
            && ParseOptionalColour(rest, out var colour, out rest) && UpdateScene(_scene with { Fog = new(density, colour) });
    }

    /// <summary>Parses a colour at the end of a line, if there is one.</summary>
    private bool ParseOptionalColour(Cursor cursor, out Colour? colour, out Cursor rest)
    {
        colour = null;
        rest = cursor;
        ParseOptionalSeparator(cursor, out var start);
        if (IsAtEndOfLine(start) || Fail(start, SyntaxFailure.EndOfLine))
        {
            return true;
        }

        var success = ParseColour(start, out var parsed, out rest);
        colour = parsed;
        return success;
    }
}
