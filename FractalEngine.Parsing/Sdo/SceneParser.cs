using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Reads scene files (paper §4.1.5). Their grammar is in docs/manual.md.</summary>
public sealed partial class SceneParser : SceneValueParser
{
    /// <summary>The word before the point that a camera looks at.</summary>
    internal const string LookAtKeyword = "look-at";

    // Products of these and of the sides of a frame stay well within a float.
    private const double MinClip = 1e-30;
    private const double MaxClip = 1e30;

    // Faulty lines that are told together, see Parse.
    private const int MaxFaults = 100;

    private readonly Dictionary<SceneDeclarationKind, int> _declarationOffsets = [];
    private readonly List<Light> _lights = [];
    private readonly List<SceneObject> _objects = [];

    // One string for each name, however many objects have it.
    private readonly Dictionary<string, string> _fileNames = [];
    private Scene _scene = new();
    private (Vector Target, Vector Up)? _cameraTarget;
    private int _fileNameOffset;

    private protected override string? Explain(SyntaxFailure failure) => SceneMistakes.Explain(failure);

    private SceneParser(SourceText source)
        : base(source)
    {
    }

    private delegate bool DeclarationParser(Cursor cursor, out Cursor rest);

    /// <summary>Parses a whole scene file. The files that it names are not read.</summary>
    /// <exception cref="SourceException">The text is not a scene, or has no valid meaning.</exception>
    public static ParsedScene Parse(SourceText source) => new SceneParser(source).ParseFile(null);

    /// <summary>Parses a whole scene file without its faulty lines, to find the faults of them all.</summary>
    /// <param name="source">Text of the file.</param>
    /// <param name="faults">Receives the faults, a hundred at most: finding its line takes a search for each.</param>
    /// <exception cref="SourceException">The file has more lines than the limit.</exception>
    internal static ParsedScene Parse(SourceText source, ICollection<Diagnostic> faults) => new SceneParser(source).ParseFile(faults);

    private ParsedScene ParseFile(ICollection<Diagnostic>? faults)
    {
        // Arrays that grow would be several times as large.
        _objects.EnsureCapacity(Math.Min(ParsingLimits.MaxSceneLines, Source.Text.AsSpan().Count('\n') + 1));
        var lines = ImmutableArray.CreateBuilder<SceneLine>(_objects.Capacity);
        for (var cursor = Source.Start; !cursor.IsAtEnd;)
        {
            if (lines.Count >= ParsingLimits.MaxSceneLines)
            {
                throw Error(cursor, $"the scene has more than the limit of {ParsingLimits.MaxSceneLines} lines", isLimitExceeded: true);
            }

            if (!TryParseLine(cursor, faults, out var kind, out var rest))
            {
                if (faults is { Count: >= MaxFaults })
                {
                    break;
                }

                cursor = SkipLine(cursor);
                continue;
            }

            var text = Source.Text.AsMemory(cursor.Offset, rest.Offset - cursor.Offset);
            var index = kind is { } declared ? IndexOfLast(declared) : 0;
            lines.Add(new(text, kind, index, kind is SceneDeclarationKind.SceneObject ? _fileNameOffset : 0));
            cursor = rest;
        }

        if (lines.All(line => line.Kind is null) && faults is null or { Count: 0 })
        {
            throw Error(Source.Start, "the scene declares nothing: it has no camera, object or light");
        }

        var scene = _scene with { Camera = TurnToTarget(_scene.Camera), Lights = [.. _lights], Objects = [.. _objects] };
        return new(Source, scene, lines.DrainToImmutable()) { Warnings = Hints };
    }

    /// <summary>Parses a line. A fault is thrown, or added to a list that takes it; then nothing of the line is declared.</summary>
    private bool TryParseLine(Cursor cursor, ICollection<Diagnostic>? faults, out SceneDeclarationKind? kind, out Cursor rest)
    {
        var (objectCount, lightCount) = (_objects.Count, _lights.Count);
        try
        {
            return ParseLine(cursor, out kind, out rest) ? true : throw SyntaxError();
        }
        catch (SourceException exception) when (faults is not null)
        {
            var isLast = faults.Count + 1 >= MaxFaults;
            faults.Add(exception.Diagnostic with
            {
                Message = exception.Diagnostic.Message + (isLast ? $" (after {MaxFaults} faulty lines the rest is not read)" : ""),
            });
            _objects.RemoveRange(objectCount, _objects.Count - objectCount);
            _lights.RemoveRange(lightCount, _lights.Count - lightCount);
            (kind, rest) = (null, cursor);
            return false;
        }
    }

    private int IndexOfLast(SceneDeclarationKind kind) => kind switch
    {
        SceneDeclarationKind.Light => _lights.Count - 1,
        SceneDeclarationKind.SceneObject => _objects.Count - 1,
        _ => 0,
    };

    private bool ParseLine(Cursor cursor, out SceneDeclarationKind? kind, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        kind = null;
        return ParseComment(start, out rest)
            || ((IsAtEndOfLine(start) || ParseDeclaration(start, out kind, out rest)) && ParseEndOfLine(rest, out rest));
    }

    private bool ParseDeclaration(Cursor cursor, out SceneDeclarationKind? kind, out Cursor rest) =>
        ParseDeclaration(cursor, "c", SceneDeclarationKind.Camera, ParseCamera, out kind, out rest)
        || ParseDeclaration(cursor, "o", SceneDeclarationKind.SceneObject, ParseObject, out kind, out rest)
        || ParseDeclaration(cursor, "p", SceneDeclarationKind.SceneObject, ParsePhysicsObject, out kind, out rest)
        || ParseDeclaration(cursor, "handed", SceneDeclarationKind.Handedness, ParseHandedness, out kind, out rest)
        || ParseDeclaration(cursor, "projection", SceneDeclarationKind.Projection, ParseProjection, out kind, out rest)
        || ParseDeclaration(cursor, "aspect", SceneDeclarationKind.Aspect, ParseAspect, out kind, out rest)
        || ParseDeclaration(cursor, "clip", SceneDeclarationKind.Clip, ParseClip, out kind, out rest)
        || ParseDeclaration(cursor, "background", SceneDeclarationKind.Background, ParseBackground, out kind, out rest)
        || ParseDeclaration(cursor, "light", SceneDeclarationKind.Light, ParseLight, out kind, out rest)
        || ParseDeclaration(cursor, "sun", SceneDeclarationKind.Light, ParseSun, out kind, out rest)
        || ParseDeclaration(cursor, "sky", SceneDeclarationKind.Sky, ParseSky, out kind, out rest)
        || ParseDeclaration(cursor, "exposure", SceneDeclarationKind.Exposure, ParseExposure, out kind, out rest)
        || ParseDeclaration(cursor, "tone", SceneDeclarationKind.Tone, ParseTone, out kind, out rest)
        || ParseDeclaration(cursor, "fog", SceneDeclarationKind.Fog, ParseFog, out kind, out rest)
        || ParseDeclaration(cursor, "gravity", SceneDeclarationKind.Gravity, ParseGravity, out kind, out rest)
        || ParseDeclaration(cursor, "player", SceneDeclarationKind.Player, ParsePlayer, out kind, out rest);

    /// <summary>Parses a keyword and its values. All kinds but lights and objects may be declared only once.</summary>
    private bool ParseDeclaration(
        Cursor cursor, string keyword, SceneDeclarationKind declared, DeclarationParser parse,
        out SceneDeclarationKind? kind, out Cursor rest)
    {
        kind = null;
        if (!ParseWord(cursor, keyword, out rest))
        {
            return false;
        }

        if (declared is not (SceneDeclarationKind.Light or SceneDeclarationKind.SceneObject)
            && !_declarationOffsets.TryAdd(declared, cursor.Offset))
        {
            throw Error(cursor, $"'{keyword}' is declared twice, first in line {Source.LineOf(_declarationOffsets[declared])}");
        }

        ParseBlanks(rest, out rest);
        kind = declared;
        return parse(rest, out rest);
    }

    private bool ParseCamera(Cursor cursor, out Cursor rest)
    {
        return ParseVectorOrDefault(cursor, Vector.Zero, out var position, out rest) && ParseOptionalSeparator(rest, out rest)
            && ParseOrientation(rest, position, out var rotation, out rest) && ParseOptionalSeparator(rest, out rest)
            && ParseNumber(rest, static number => number is > 0 and < 180, "the angle of view must lie between 0 and 180 degrees",
                out var fieldOfView, out rest)
            && UpdateScene(_scene with { Camera = new(position, rotation, fieldOfView) });
    }

    /// <summary>Parses angles in radians, or <c>look-at point [up direction]</c>.</summary>
    private bool ParseOrientation(Cursor cursor, Vector position, out Vector rotation, out Cursor rest)
    {
        rotation = Vector.Zero;
        if (!ParseKeyword(cursor, LookAtKeyword, out var targetStart))
        {
            var success = ParseVectorOrDefault(cursor, Vector.Zero, out rotation, out rest);
            Hint(cursor, RotationUnits.DescribeDegrees(rotation));
            return success;
        }

        if (!ParseVector(targetStart, out var target, out rest))
        {
            return false;
        }

        Require(target != position, targetStart, "a camera can't look at its own position");
        var up = Vector.J;
        if (ParseOptionalSeparator(rest, out var next) && ParseKeyword(next, "up", out var upStart)
            && !(ParseVector(upStart, out up, out rest) && ParseOptionalSeparator(rest, out rest)))
        {
            return false;
        }

        Require(up != Vector.Zero, next, "the direction up must not be (0, 0, 0)");
        _cameraTarget = (target, up);
        return true;
    }

    /// <summary>Turns the camera to its target. The handedness, on which the angles depend, may be declared below the camera.</summary>
    private Camera? TurnToTarget(Camera? camera) => camera is not null && _cameraTarget is var (target, up)
        ? CameraFraming.LookAt(camera.Position, target, up, camera.FieldOfView, _scene.Handedness)
        : camera;

    private bool ParseHandedness(Cursor cursor, out Cursor rest)
    {
        return (ParseWord(cursor, "left", out rest) && UpdateScene(_scene with { Handedness = Handedness.Left }))
            || (ParseWord(cursor, "right", out rest) && UpdateScene(_scene with { Handedness = Handedness.Right }));
    }

    private bool ParseProjection(Cursor cursor, out Cursor rest)
    {
        if (ParseWord(cursor, "perspective", out rest))
        {
            return UpdateScene(_scene with { Projection = Projection.Perspective });
        }

        if (!ParseWord(cursor, "orthographic", out rest))
        {
            return false;
        }

        ParseBlanks(rest, out var heightStart);
        double? height = null;
        if (!IsAtEndOfLine(heightStart) && !Fail(heightStart, SyntaxFailure.EndOfLine))
        {
            if (!ParseNumber(heightStart, static height => height > 0, "the visible height must be positive", out var number, out rest))
            {
                return false;
            }

            height = number;
        }

        return UpdateScene(_scene with { Projection = Projection.Orthographic, OrthographicHeight = height });
    }

    private bool ParseAspect(Cursor cursor, out Cursor rest)
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
        return UpdateScene(_scene with { Aspect = width / height });
    }

    private bool ParseClip(Cursor cursor, out Cursor rest)
    {
        if (!ParseNumber(cursor, out var near, out rest) || !ParseNextNumber(rest, out var far, out rest))
        {
            return false;
        }

        Require(near > 0 && far > near, cursor, "the clip planes must satisfy 0 < near < far");
        Require(near >= MinClip && far <= MaxClip, cursor, FormattableString.Invariant(
            $"clip planes lie between {MinClip} and {MaxClip}, since depths are drawn as floats"));
        return UpdateScene(_scene with { Clip = (near, far) });
    }

    private bool ParseBackground(Cursor cursor, out Cursor rest) =>
        ParseColour(cursor, out var colour, out rest) && UpdateScene(_scene with { Background = colour });

    private bool ParseGravity(Cursor cursor, out Cursor rest) =>
        ParseVectorOrDefault(cursor, Vector.Zero, out var gravity, out rest) && UpdateScene(_scene with { Gravity = gravity });

    private bool UpdateScene(Scene scene)
    {
        _scene = scene;
        return true;
    }
}
