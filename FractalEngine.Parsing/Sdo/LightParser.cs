using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Parses the lights of scene files, the sun among them.</summary>
/// <param name="source">Text that is parsed.</param>
public abstract class LightParser(SourceText source) : SceneSettingParser(source)
{
    // Smallest size of a light by its range, and the largest range by its size.
    private const double MinSize = 1e-6;

    /// <summary>All lights that were declared so far.</summary>
    private protected List<Light> Lights { get; } = [];

    /// <summary>Parses a light behind the word that declares it.</summary>
    private protected bool ParseLight(Cursor cursor, out Cursor rest)
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

        if (ParseKeyword(cursor, "ball", out rest))
        {
            return ParseVectorAndSeparator(rest, out var position, out var sizes) && ParseSize(sizes, "radius", out var radius, out rest)
                && ParseColourIntensityAndRange(rest, out var colour, out var intensity, out var range, out rest)
                && AddSizedLight(new BallLight(position, radius, colour, intensity, range), sizes, radius, radius);
        }

        if (ParseKeyword(cursor, "quad", out rest))
        {
            return ParseVectorAndSeparator(rest, out var position, out rest)
                && ParseDirection(rest, out var direction, out var sizes) && ParseSize(sizes, "width", out var width, out rest)
                && ParseSize(rest, "height", out var height, out rest)
                && ParseColourIntensityAndRange(rest, out var colour, out var intensity, out var range, out rest)
                && ParseTurn(ref rest, out var turn)
                && AddSizedLight(new QuadLight(position, direction, width, height, colour, intensity, range, turn), sizes, width, height);
        }

        return false;
    }

    /// <summary>Parses the sun behind its word.</summary>
    private protected bool ParseSun(Cursor cursor, out Cursor rest)
    {
        const string fault = "the diameter of the sun must be at least 0 and less than 90 degrees";
        var diameter = SunLight.DefaultDiameter;
        return ParseDirection(cursor, out var direction, out rest) && ParseColour(rest, out var colour, out rest)
            && ParseOptionalSeparator(rest, out rest) && ParseIntensity(rest, out var intensity, out rest)
            && ParseOptionalSeparator(rest, out var diameterStart)
            && (EndsAt(diameterStart)
                || ParseNumber(diameterStart, static number => number is >= 0 and < 90, fault, out diameter, out rest))
            && AddLight(new SunLight(direction, colour, intensity, diameter));
    }

    private bool AddLight(Light light)
    {
        Lights.Add(light);
        return true;
    }

    /// <summary>Adds a light whose size makes its radiance a number of moderate size.</summary>
    private bool AddSizedLight(PointLight light, Cursor sizes, double size1, double size2)
    {
        Require(
            Math.Min(size1, size2) >= MinSize * light.Range && Math.Max(size1, size2) <= light.Range / MinSize, sizes,
            "the size of a light must lie between 1e-6 and 1e6 of its range");
        return AddLight(light);
    }

    private bool ParseSize(Cursor cursor, string name, out double size, out Cursor rest) =>
        ParseNumber(cursor, static number => number > 0, $"the {name} of a light must be positive", out size, out rest)
        && ParseOptionalSeparator(rest, out rest);

    /// <summary>Parses the optional turn of a rectangle.</summary>
    private bool ParseTurn(ref Cursor rest, out double turn)
    {
        turn = 0;
        return ParseOptionalSeparator(rest, out var start) && (EndsAt(start) || ParseNumber(start, out turn, out rest));
    }

    private bool ParseDirection(Cursor cursor, out Vector direction, out Cursor rest)
    {
        var success = ParseVectorAndSeparator(cursor, out direction, out rest);
        Require(!success || direction != Vector.Zero, cursor, "a direction must not be (0, 0, 0)");
        return success;
    }

    private bool ParseAngle(Cursor cursor, out double angle, out Cursor rest)
    {
        const string fault = "the angle of the cone must lie between 0 and 180 degrees";
        return ParseNumber(cursor, static number => number is > 0 and < 180, fault, out angle, out rest)
            && ParseOptionalSeparator(rest, out rest);
    }

    /// <summary>Parses a colour and an optional intensity, 1 by default.</summary>
    private bool ParseColourAndIntensity(Cursor cursor, out Colour colour, out double intensity, out Cursor rest)
    {
        intensity = 1;
        return ParseColour(cursor, out colour, out rest) && ParseOptionalSeparator(rest, out var intensityStart)
            && (EndsAt(intensityStart) || ParseIntensity(intensityStart, out intensity, out rest));
    }

    private bool ParseColourIntensityAndRange(Cursor cursor, out Colour colour, out double intensity, out double range, out Cursor rest)
    {
        intensity = 0;
        range = 0;
        return ParseColour(cursor, out colour, out rest) && ParseOptionalSeparator(rest, out rest)
            && ParseIntensity(rest, out intensity, out rest) && ParseSeparator(rest, out rest)
            && ParseNumber(rest, static number => number > 0, "the range of a light must be positive", out range, out rest);
    }

    private bool ParseIntensity(Cursor cursor, out double intensity, out Cursor rest)
    {
        var success = ParseNonNegative(cursor, "the intensity of a light", out intensity, out rest);
        Require(!success || intensity <= MaxFactor, cursor, "the intensity of a light must not exceed 1e9");
        return success;
    }
}
