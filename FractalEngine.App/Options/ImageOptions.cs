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

    private readonly Option<int?> _bits = WordOption.Single(
        "--bits", "Bits of each number: 8 or 16 of a .png (default: 8), 16 or 32 of an .exr (default: 16).",
        ("8", 8), ("16", 16), ("32", 32));

    private readonly Option<string?> _layers = SharedOptions.TextOption(
        "--layers", "NAME,NAME", $"What an .exr tells of each pixel (default: colour): {LightFormat.LayerNames}.");

    public CameraOptions Camera { get; } = new();

    public void AddTo(Command command)
    {
        _shared.AddTo(command);
        _draw.AddTo(command);
        Camera.AddTo(command);
        command.Add(_background);
        command.Add(_time);
        SharedOptions.AddAll(command, _bits, _layers);
        _trace.AddTo(command);
    }

    /// <summary>The file that the command line names.</summary>
    public string File(ParseResult result) => result.GetRequiredValue(_shared.File);

    /// <summary>Returns what the command line asks for.</summary>
    /// <param name="result">The parsed command line.</param>
    /// <param name="output">Name of the output.</param>
    /// <returns>What each image shows, and how it is traced; null where it is drawn.</returns>
    /// <exception cref="UsageException">An option has a faulty value, or no effect.</exception>
    /// <exception cref="Core.FractalEngineException">The image has more pixels than its format may.</exception>
    public (RenderJob Job, TracedImage? Trace) Read(ParseResult result, string output)
    {
        var trace = _trace.Choice(result);
        var format = LightFormat.Parse(output, result.GetValue(_bits), result.GetValue(_layers), trace is not null);
        format?.CheckSize(_draw.Resolution(result));
        var job = new RenderJob(
            result.GetRequiredValue(_shared.File),
            _draw.Staged(result, _shared.LoadOptions(result)) with { FilmTime = result.GetValue(_time) }, _draw.Resolution(result),
            _draw.Projection(result), _draw.Settings(result) with { KeepsLight = format is not null })
        {
            Format = format,
            Time = result.GetValue(_time) ?? 0,
            Background = BackgroundChoice.Parse(result.GetValue(_background)),
            CreateView = (scene, aspect) =>
                Camera.View(result, scene, _draw.Projection(result) is not null, aspect) with { Section = _draw.Section(result) },
            ZoomLevels = Camera.Zoom(result),
        };
        UsageException.ThrowIf(
            job.Background.IsTransparent && format is { Ending: ".hdr" }, "an .hdr has no transparent background: expected .exr or .png");
        _draw.RequireEffect(result, trace);
        return (job, trace);
    }
}
