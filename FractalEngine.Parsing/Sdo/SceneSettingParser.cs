using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Parses what a scene has at most once: camera, frame, sky, how light is shown, gravity, and the player.</summary>
public abstract class SceneSettingParser : GradientParser
{
    /// <summary>The word before the point that a camera looks at.</summary>
    internal const string LookAtKeyword = "look-at";

    // Largest exposure, and intensity of a light: their product, and its square, stay within what the shaders compute with.
    private protected const double MaxFactor = 1e9;

    // Products of these and of the sides of a frame stay well within a float.
    private const double MinClip = 1e-30;
    private const double MaxClip = 1e30;

    private readonly Option<Camera>[] _cameraOptions;
    private readonly Option<Player>[] _playerOptions;
    private readonly Option<ImageSky>[] _skyOptions;
    private readonly Option<Fog>[] _fogOptions;
    private (Vector Point, Vector Up)? _cameraTarget;

    private protected SceneSettingParser(SourceText source)
        : base(source)
    {
        _cameraOptions =
        [
            Option<Camera>.Of(
                "aperture", Number(static diameter => diameter is >= 0 and <= MaxClip, "the aperture must lie between 0 and 1e30"),
                static (camera, diameter) => camera with { Aperture = diameter }),
            Option<Camera>.Of(
                "focus", Number(static depth => depth is >= MinClip and <= MaxClip, "the focus must lie between 1e-30 and 1e30"),
                static (camera, depth) => camera with { FocusDepth = depth }),
        ];
        _playerOptions =
        [
            Option<Player>.Of("speed", NonNegative("the player's speed"), (player, speed) => player with { WalkingSpeedOverride = speed }),
            Option<Player>.Of("jump", NonNegative("the speed of a jump"), (player, jump) => player with { JumpSpeedOverride = jump }),
            Option<Player>.Of<double>("slope", ParseSlope, (player, slope) => player with { MaxSlopeAngle = slope }),
            new("step", ParseStep),
        ];
        _skyOptions =
        [
            Option<ImageSky>.Of<double>("turn", ParseNumber, (sky, angle) => sky with { Turn = angle }),
            Option<ImageSky>.Of(
                "scale", Number(static factor => factor is > 0 and <= MaxFactor, "the scale of a sky must be positive and at most 1e9"),
                (sky, factor) => sky with { Scale = factor }),
        ];
        var albedo = Number(static share => share is >= 0 and <= 1, "the share that fog scatters must lie between 0 and 1");
        var anisotropy = Number(
            static cosine => Math.Abs(cosine) <= Fog.MaxAnisotropy, "the anisotropy of fog must lie between -0.95 and 0.95");
        _fogOptions =
        [
            Option<Fog>.Of("scatter", albedo, static (fog, share) => fog with { Albedo = share }),
            Option<Fog>.Of("forward", anisotropy, static (fog, cosine) => fog with { Anisotropy = cosine }),
        ];
    }

    /// <summary>What was declared so far, without lights and objects.</summary>
    private protected Scene Scene { get; private set; } = new();

    /// <summary>Offset of the last name of a file; 0 for a sky of colours.</summary>
    private protected int FileNameOffset { get; set; }

    private protected bool ParseCamera(Cursor cursor, out Cursor rest) =>
        ParseCamera(cursor, out var camera, out _cameraTarget, out rest) && UpdateScene(Scene with { Camera = camera });

    /// <summary>Parses a camera, of which a target takes the place of the angles.</summary>
    private protected bool ParseCamera(Cursor cursor, out Camera camera, out (Vector Point, Vector Up)? target, out Cursor rest)
    {
        (camera, target) = (Camera.Default, null);
        return ParseVectorOrDefault(cursor, Vector.Zero, out var position, out rest) && ParseOptionalSeparator(rest, out rest)
            && ParseOrientation(rest, position, out var rotation, out target, out rest) && ParseOptionalSeparator(rest, out rest)
            && ParseNumber(rest, static number => number is > 0 and < 180, "the angle of view must lie between 0 and 180 degrees",
                out var fieldOfView, out rest)
            && Set(ref camera, ParseOptions(rest, new Camera(position, rotation, fieldOfView), _cameraOptions, out rest));
    }

    /// <summary>Parses angles in radians, or <c>look-at point [up direction]</c>.</summary>
    private bool ParseOrientation(
        Cursor cursor, Vector position, out Vector rotation, out (Vector Point, Vector Up)? target, out Cursor rest)
    {
        (rotation, target) = (Vector.Zero, null);
        if (!ParseKeyword(cursor, LookAtKeyword, out var targetStart))
        {
            var success = ParseVectorOrDefault(cursor, Vector.Zero, out rotation, out rest);
            Hint(cursor, RotationUnits.DescribeDegrees(rotation));
            return success;
        }

        if (!ParseVector(targetStart, out var point, out rest))
        {
            return false;
        }

        Require(point != position, targetStart, "a camera can't look at its own position");
        var up = Vector.J;
        if (ParseOptionalSeparator(rest, out var next) && ParseKeyword(next, "up", out var upStart)
            && !(ParseVector(upStart, out up, out rest) && ParseOptionalSeparator(rest, out rest)))
        {
            return false;
        }

        Require(up != Vector.Zero, next, "the direction up must not be (0, 0, 0)");
        target = (point, up);
        return true;
    }

    /// <summary>Turns the camera to its target. The handedness, on which the angles depend, may be declared below the camera.</summary>
    private protected Camera? TurnToTarget(Camera? camera) => camera is not null && _cameraTarget is var (point, up)
        ? camera with
        {
            Rotation = CameraFraming.LookAt(camera.Position, point, up, camera.FieldOfView, Scene.Handedness).Rotation,
            Handedness = Scene.Handedness,
        }
        : camera;

    private protected bool ParseHandedness(Cursor cursor, out Cursor rest) =>
        ParseChoice(cursor, [(Handedness.Left, "left"), (Handedness.Right, "right")], out var handedness, out rest)
        && UpdateScene(Scene with { Handedness = handedness });

    private protected bool ParseProjection(Cursor cursor, out Cursor rest)
    {
        if (ParseWord(cursor, "perspective", out rest))
        {
            return UpdateScene(Scene with { Projection = Projection.Perspective });
        }

        if (!ParseWord(cursor, "orthographic", out rest))
        {
            return false;
        }

        ParseBlanks(rest, out var heightStart);
        var height = 0.0;
        var hasHeight = !EndsAt(heightStart);
        return (!hasHeight
                || ParseNumber(heightStart, static height => height > 0, "the visible height must be positive", out height, out rest))
            && UpdateScene(Scene with { Projection = Projection.Orthographic, OrthographicHeight = hasHeight ? height : null });
    }

    private protected bool ParseAspect(Cursor cursor, out Cursor rest)
    {
        if (!ParseNumber(cursor, out var width, out rest))
        {
            return false;
        }

        var height = 1.0;
        if (ParseBlanks(rest, out var colon) && colon.Current == ':'
            && !(ParseBlanks(colon.Advance(1), out rest) && ParseNumber(rest, out height, out rest)))
        {
            return false;
        }

        Require(width > 0 && height > 0 && width / height is >= 0.01 and <= 100, cursor,
            "the aspect ratio must lie between 1:100 and 100:1");
        return UpdateScene(Scene with { Aspect = width / height });
    }

    private protected bool ParseClip(Cursor cursor, out Cursor rest)
    {
        if (!ParseNumber(cursor, out var near, out rest) || !ParseNextNumber(rest, out var far, out rest))
        {
            return false;
        }

        Require(near > 0 && far > near, cursor, "the clip planes must satisfy 0 < near < far");
        Require(near >= MinClip && far <= MaxClip, cursor, FormattableString.Invariant(
            $"clip planes lie between {MinClip} and {MaxClip}, since depths are drawn as floats"));
        return UpdateScene(Scene with { Clip = (near, far) });
    }

    private protected bool ParseBackground(Cursor cursor, out Cursor rest) =>
        ParseColour(cursor, out var colour, out rest) && UpdateScene(Scene with { Background = colour });

    private protected bool ParseSky(Cursor cursor, out Cursor rest)
    {
        FileNameOffset = 0;
        if (ParseString(cursor, "a file name in quotes", out var file, out rest))
        {
            FileNameOffset = cursor.Offset;
            Require(file.EndsWith(".hdr", StringComparison.OrdinalIgnoreCase), cursor, "expected the name of an image (.hdr)");
            return UpdateScene(Scene with { Sky = ParseOptions(rest, new ImageSky(file), _skyOptions, out rest) });
        }

        return ParseColour(cursor, out var zenith, out rest) && ParseOptionalSeparator(rest, out rest)
            && ParseColour(rest, out var horizon, out rest) && ParseOptionalColour(rest, out var ground, out rest)
            && UpdateScene(Scene with { Sky = new ColourSky(zenith, horizon, ground) });
    }

    private protected bool ParseProbe(Cursor cursor, out Cursor rest) =>
        ParseVector(cursor, out var position, out rest) && UpdateScene(Scene with { Probe = position });

    private protected bool ParseExposure(Cursor cursor, out Cursor rest)
    {
        var isAuto = ParseWord(cursor, "auto", out rest);
        var start = cursor;
        if (isAuto)
        {
            ParseBlanks(rest, out start);
        }

        var exposure = 1.0;
        if (!(isAuto && EndsAt(start))
            && !ParseNumber(start, static number => number > 0, "the exposure must be positive", out exposure, out rest))
        {
            return false;
        }

        Require(exposure is >= 1e-9 and <= MaxFactor, start, "the exposure must lie between 1e-9 and 1e9");
        return UpdateScene(Scene with { Exposure = exposure, HasAutoExposure = isAuto });
    }

    private protected bool ParseTone(Cursor cursor, out Cursor rest) =>
        ParseChoice(
            cursor, [(Tone.None, "none"), (Tone.Filmic, "filmic"), (Tone.Reinhard, "reinhard"), (Tone.Aces, "aces")],
            out var tone, out rest)
        && UpdateScene(Scene with { Tone = tone });

    private protected bool ParseFog(Cursor cursor, out Cursor rest)
    {
        if (!ParseNonNegative(cursor, "the density of fog", out var density, out rest))
        {
            return false;
        }

        ParseOptionalSeparator(rest, out var colourStart);
        var hasColour = ParseColour(colourStart, out var colour, out var colourEnd);
        var fog = new Fog(density, hasColour ? colour : null);
        return UpdateScene(Scene with { Fog = ParseOptions(hasColour ? colourEnd : rest, fog, _fogOptions, out rest) });
    }

    private protected bool ParseGravity(Cursor cursor, out Cursor rest) =>
        ParseVectorOrDefault(cursor, Vector.Zero, out var gravity, out rest) && UpdateScene(Scene with { Gravity = gravity });

    private protected bool ParsePlayer(Cursor cursor, out Cursor rest)
    {
        if (!ParseVector(cursor, out var position, out rest) || !ParseOptionalSeparator(rest, out var radiusStart)
            || !ParseNumber(radiusStart, out var radius, out rest) || !ParseNextNumber(rest, out var height, out rest))
        {
            return false;
        }

        Require(radius > 0 && height >= 2 * radius, radiusStart,
            "the player's radius must be positive, and the height at least twice as much");
        Require(height <= Player.MaxHeightPerRadius * radius, radiusStart,
            $"the player's height must be at most {Player.MaxHeightPerRadius} times the radius");
        var player = ParseOptions(rest, new Player(position, radius, height), _playerOptions, out rest);
        return UpdateScene(Scene with { Player = player });
    }

    private bool ParseSlope(Cursor cursor, out double angle, out Cursor rest) => ParseNumber(
        cursor, static angle => angle is >= 0 and <= Player.MaxSlopeAngleLimit, "the player's slope must lie between 0 and 89 degrees",
        out angle, out rest);

    private bool ParseStep(Cursor cursor, ref Player player, out Cursor rest)
    {
        var height = player.Height;
        const string fault = "the player's step must not be negative, and less than the height";
        return ParseNumber(cursor, number => number >= 0 && number < height, fault, out var step, out rest)
            && Set(ref player, player with { StepHeightOverride = step });
    }

    private protected bool UpdateScene(Scene scene)
    {
        Scene = scene;
        return true;
    }
}
