using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.State;

/// <summary>Plays the film of a scene in a window.</summary>
internal sealed class FilmPlayer
{
    private const int LinesBetweenKeys = 32;

    // Of the way to the key before or behind.
    private const double MarkSize = 0.05;
    private static readonly Colour PathColour = new(0.95, 0.75, 0.2);
    private static readonly Colour MarkColour = new(1, 1, 1);

    private readonly Film _film;
    private readonly CameraPath? _path;
    private List<LineSegment>? _lines;

    // Times whose numbers are wanted, and were asked for last; null for those of the files.
    private double? _wantedTime;
    private double? _loadedTime;

    /// <summary>Creates a player that has not begun, or goes on where that of the same scene was.</summary>
    /// <param name="film">The film.</param>
    /// <param name="handedness">That of the scene.</param>
    /// <param name="previous">The player before the scene was loaded again; null for none.</param>
    public FilmPlayer(Film film, Handedness handedness, FilmPlayer? previous)
    {
        _film = film;
        _path = film.Cameras.Any() ? new(film.Cameras, handedness) : null;
        if (previous is not null)
        {
            Time = Math.Min(previous.Time, film.Duration);
            (IsPlaying, ShowsPath) = (previous.IsPlaying, previous.ShowsPath);
            (_wantedTime, _loadedTime) = (previous._wantedTime, previous._loadedTime);
        }
    }

    /// <summary>Seconds from the beginning to the end.</summary>
    public double Duration => _film.Duration;

    /// <summary>Seconds since the beginning.</summary>
    public double Time { get; private set; }

    public bool IsPlaying { get; private set; }

    /// <summary>Whether the way of the camera is shown as a line while the film stands still.</summary>
    public bool ShowsPath { get; set; }

    /// <summary>The camera at the present time; null where the film has none.</summary>
    public Camera? Camera => _path?.At(Time);

    /// <summary>Whether the scene was loaded with other numbers than the present time has.</summary>
    public bool NeedsLoad => _film.HasNumbers && !Nullable.Equals(_wantedTime, _loadedTime)
        && !(_wantedTime is { } wanted && _loadedTime is { } loaded && _film.HasSameValuesAt(loaded, wanted));

    /// <summary>The way of the camera with a mark at each key, world space; none unless it is shown.</summary>
    public IReadOnlyList<LineSegment> Lines => ShowsPath && !IsPlaying && _path is not null ? _lines ??= CreateLines(_path) : [];

    /// <summary>Takes over that the numbers of the present time are loaded from now on.</summary>
    /// <returns>The time of the film whose numbers count; null for those of the files.</returns>
    public double? BeginLoad() => _loadedTime = _wantedTime;

    /// <summary>Plays on from the present time, from the beginning again after the end, or pauses.</summary>
    public void Toggle()
    {
        IsPlaying = !IsPlaying;
        Seek(IsPlaying && Time >= Duration ? 0 : Time);
    }

    /// <summary>Goes to a time of the film, whose numbers are wanted from then on.</summary>
    public void Seek(double time) => _wantedTime = Time = Math.Clamp(time, 0, Duration);

    /// <summary>Returns to the beginning, and to the numbers of the files.</summary>
    public void Stop()
    {
        IsPlaying = false;
        Time = 0;
        _wantedTime = null;
    }

    /// <summary>Plays for a time, to the end at most.</summary>
    public void Advance(double seconds)
    {
        Seek(Time + seconds);
        IsPlaying = Time < Duration;
    }

    private List<LineSegment> CreateLines(CameraPath path)
    {
        var lines = new List<LineSegment>();
        CameraKey[] keys = [.. _film.Cameras];
        foreach (var (index, key) in keys.Index())
        {
            var next = keys[Math.Min(index + 1, keys.Length - 1)];
            var position = path.At(key.Time).Position;
            for (var i = 0; i < LinesBetweenKeys && next.Time > key.Time && next.Ease != Ease.Hold; i++)
            {
                var end = path.At(key.Time + ((next.Time - key.Time) * (i + 1) / LinesBetweenKeys)).Position;
                lines.Add(new(position, end, PathColour));
                position = end;
            }

            AddMark(lines, path.At(key.Time), (key == next ? keys[Math.Max(index - 1, 0)] : next).Camera.Position);
        }

        return lines;
    }

    /// <summary>Adds the axes of a camera, of which the one forward is longer.</summary>
    private static void AddMark(List<LineSegment> lines, Camera camera, Vector neighbour)
    {
        var (distance, axes) = ((neighbour - camera.Position).Length(), camera.LocalAxes);
        var size = MarkSize * (distance > 0 ? distance : 1);
        foreach (var axis in (Vector[])[axes.V1, axes.V2, -axes.V1, -axes.V2, 4 * axes.V3])
        {
            lines.Add(new(camera.Position, camera.Position + (size * axis), MarkColour));
        }
    }
}
