using FractalEngine.Core.Scenes.Films;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Parses the film of a scene: its duration, and its keys.</summary>
public abstract class FilmParser : SceneObjectParser
{
    // Longer words before those that they begin with.
    private static readonly (Ease Value, string Word)[] EaseWords =
        [(Ease.Linear, "linear"), (Ease.InOut, "in-out"), (Ease.In, "in"), (Ease.Out, "out"), (Ease.Hold, "hold")];

    private readonly Option<FilmKey>[] _keyOptions;

    private protected FilmParser(SourceText source)
        : base(source) =>
        _keyOptions = [Option<FilmKey>.Of<Ease>("ease", ParseEase, static (key, ease) => key with { Ease = ease })];

    /// <summary>All keys that were declared so far.</summary>
    private protected List<FilmKey> Keys { get; } = [];

    /// <summary>Returns the word by which scenes name an ease.</summary>
    internal static string WordOf(Ease ease) => EaseWords.First(row => row.Value == ease).Word;

    /// <summary>Parses a duration behind <c>film</c>.</summary>
    private protected bool ParseFilm(Cursor cursor, out Cursor rest) =>
        ParseNumber(
            cursor, static number => number is > 0 and <= Film.MaxDuration,
            $"a film lasts more than 0 and at most {Film.MaxDuration} seconds", out var duration, out rest)
        && UpdateScene(Scene with { Film = new(duration) });

    /// <summary>Parses a time, and what the film shows then, behind <c>at</c>.</summary>
    private protected bool ParseKey(Cursor cursor, out Cursor rest)
    {
        if (!ParseNonNegative(cursor, "the time of a key", out var time, out rest) || !ParseSeparator(rest, out rest)
            || !(ParseCameraKey(rest, time, out var key, out var end) || ParseNumberKey(rest, time, out key, out end)))
        {
            return false;
        }

        Require(Scene.Film is not null, cursor, "a key needs a line 'film SECONDS' above it");
        Require(time <= Scene.Film!.Duration, cursor, FormattableString.Invariant(
            $"the time of a key must lie within the film, which lasts {Scene.Film.Duration} seconds"));
        var before = Keys.FindLast(key.IsOfSame);
        Require(before is null || before.Time < time, cursor, FormattableString.Invariant(
            $"keys of one thing stand in the order of their times, and the one before is at {before?.Time} seconds"));
        Keys.Add(ParseOptions(end, key, _keyOptions, out rest));
        return true;
    }

    private bool ParseCameraKey(Cursor cursor, double time, out FilmKey key, out Cursor rest)
    {
        key = default!;
        // Where this fails, a number may have the name of the camera.
        if (!ParseKeyword(cursor, "c", out rest) || !ParseCamera(rest, out var camera, out var target, out rest))
        {
            return false;
        }

        var extent = Math.Max(camera.Position.MaxAbsComponent(), target?.Point.MaxAbsComponent() ?? 0);
        Require(extent <= CameraKey.MaxCoordinate, cursor, "the camera of a key is beyond the limit of 1e150");
        key = new CameraKey(time, camera) { Target = target };
        return true;
    }

    private bool ParseNumberKey(Cursor cursor, double time, out FilmKey key, out Cursor rest)
    {
        key = default!;
        if (!ParseName(cursor, "the name of a number", out var name, out rest) || !ParseBlanks(rest, out rest)
            || !ParseChar(rest, '=', out rest) || !ParseBlanks(rest, out rest) || !ParseNumber(rest, out var value, out rest))
        {
            return false;
        }

        key = new NumberKey(time, name, value);
        return true;
    }

    private bool ParseEase(Cursor cursor, out Ease ease, out Cursor rest) => ParseChoice(cursor, EaseWords, out ease, out rest);
}
