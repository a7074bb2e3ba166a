using System.CommandLine;
using FractalEngine.App.Jobs;
using FractalEngine.App.Shell;

namespace FractalEngine.App.Options;

/// <summary>The options of the commands that draw images: the file, and how each image shows it.</summary>
/// <param name="canKeepPartial">Whether the command can write a traced image that is interrupted.</param>
internal sealed class ImageOptions(bool canKeepPartial)
{
    private readonly SharedOptions _shared = new();
    private readonly DrawOptions _draw = new();
    private readonly TraceOptions _trace = new(canKeepPartial);
    private readonly Option<double?> _time = SharedOptions.TimeOption();
    private readonly Option<string?> _background = SharedOptions.BackgroundOption();

    public CameraOptions Camera { get; } = new();

    public void AddTo(Command command)
    {
        _shared.AddTo(command);
        _draw.AddTo(command);
        Camera.AddTo(command);
        command.Add(_background);
        command.Add(_time);
        _trace.AddTo(command);
    }

    /// <summary>Returns what the command line asks for.</summary>
    /// <returns>What each image shows, and how it is traced; null where it is drawn.</returns>
    /// <exception cref="UsageException">An option has a faulty value, or no effect.</exception>
    public (RenderJob Job, TracedImage? Trace) Read(ParseResult result)
    {
        var job = new RenderJob(
            result.GetRequiredValue(_shared.File), _shared.LoadOptions(result) with { FilmTime = result.GetValue(_time) },
            _draw.Resolution(result),
            _draw.Projection(result), _draw.Settings(result))
        {
            Time = result.GetValue(_time) ?? 0,
            Background = BackgroundChoice.Parse(result.GetValue(_background)),
            CreateView = (scene, aspect) =>
                Camera.View(result, scene, _draw.Projection(result) is not null, aspect) with { Section = _draw.Section(result) },
            ZoomLevels = Camera.Zoom(result),
        };
        var trace = _trace.Choice(result);
        _draw.RequireEffect(result, trace);
        return (job, trace);
    }
}
