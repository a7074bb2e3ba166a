using System.CommandLine;
using System.Globalization;
using FractalEngine.App.Jobs;
using FractalEngine.App.Shell;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Options;

/// <summary>The options of the commands that draw, and the settings that follow from them.</summary>
internal sealed class DrawOptions
{
    public const int MaxInstances = 100_000_000;

    /// <summary>Largest size of a proxy, in pixels.</summary>
    public const double MaxDetail = 1000;

    /// <summary>Largest number of samples of each pixel against jagged edges.</summary>
    public const int MaxSamples = 32;

    /// <summary>Number of frames that a resting window gathers, unless stated otherwise.</summary>
    public const int WindowGatheredFrames = 16;

    /// <summary>Largest number of frames whose mean an image is.</summary>
    public const int MaxGatheredFrames = 1024;

    private static readonly RenderSettings DefaultSettings = new();
    private static readonly CullingSettings DefaultCulling = new();

    private readonly Option<bool> _wireframe = new("--wireframe") { Description = "Draw only the edges of the triangles." };
    private readonly Option<bool> _grid = new("--grid") { Description = "Draw a grid on the ground, and the axes." };

    private readonly Option<int?> _maxInstances = NumberOption.Integer(
        "--instances", "N", 1, MaxInstances,
        $"Maximum number of instances in a frame (default: {DefaultCulling.InstanceBudget}); "
        + $"with --detail 0, of each fractal (default: {FractalLimits.DrawnInstances.Value}).");

    private readonly Option<int?> _sampleCount = NumberOption.Integer(
        "--samples", "N", 0, MaxSamples, $"Samples per pixel for antialiasing, 0 for none (default: {DefaultSettings.Samples}).");

    private readonly Option<int?> _gatheredFrames = NumberOption.Integer(
        "--gather", "FRAMES", 1, MaxGatheredFrames,
        "Frames whose mean is shown where nothing moves, each moved by a part of a pixel "
        + $"(default: {DefaultSettings.GatheredFrames}; in a window {WindowGatheredFrames}).");

    private readonly Option<double?> _minProjectedSize = NumberOption.Decimal(
        "--detail", "PIXELS", 0, MaxDetail,
        "Draw each sub-fractal that appears smaller as a proxy, a single instance of its base mesh "
        + string.Create(CultureInfo.InvariantCulture, $"(default: {DefaultCulling.MinProjectedSize}); 0 draws every instance."));

    private readonly Option<Shading?> _shading = WordOption.Single(
        "--shading", "Compute the lighting at each vertex or at each pixel (default: pixel).",
        ("vertex", Shading.PerVertex), ("pixel", Shading.PerPixel));

    private readonly Option<bool> _plain = SharedOptions.Flag(
        "--plain", "Show a mesh or fractal that is opened alone in one colour before a plain background, without sky and sun.");

    private readonly Option<bool> _noShadows = new("--no-shadows") { Description = "Draw no shadows." };

    private readonly Option<string?> _section = SharedOptions.TextOption(
        "--section", "NX,NY,NZ,D",
        "Cut away what lies beyond the plane x*NX + y*NY + z*NZ = D, and show solids filled where it cuts them.");

    private readonly Option<bool> _noAmbientOcclusion = SharedOptions.Flag(
        "--no-ambient-occlusion", "Light the holes of fractals as if they were open to the sky.");

    private readonly Option<Projection?> _projection = SharedOptions.ProjectionOption();
    private readonly Option<(int Width, int Height)?> _resolution = SharedOptions.ResolutionOption();

    public void AddTo(Command command) => SharedOptions.AddAll(
        command, _resolution, _projection, _plain, _shading, _noShadows, _noAmbientOcclusion, _wireframe, _grid, _section,
        _minProjectedSize, _maxInstances, _sampleCount, _gatheredFrames);

    /// <summary>Returns load options for what is drawn: on a stage, unless the command line asks for the plain look.</summary>
    public LoadOptions Staged(ParseResult result, LoadOptions load) => load with { IsStaged = !result.GetValue(_plain) };

    /// <summary>Returns width and height of the frame in pixels.</summary>
    public (int Width, int Height) Resolution(ParseResult result) => result.GetValue(_resolution) ?? SharedOptions.DefaultResolution;

    /// <summary>Returns the projection that overrides the scene's, or null.</summary>
    public Projection? Projection(ParseResult result) => result.GetValue(_projection);

    /// <summary>Returns the plane that cuts the scene open; null for none.</summary>
    /// <exception cref="UsageException">The value of the option is no plane.</exception>
    public SectionPlane? Section(ParseResult result) => result.GetValue(_section) is { } text ? SectionText.Parse("--section", text) : null;

    /// <summary>Refuses options that change nothing.</summary>
    /// <param name="result">The command line.</param>
    /// <param name="traced">How the image is traced; null where it is drawn.</param>
    /// <param name="hasWindow">Whether frames are shown in a window, whose keys switch shadows and the like.</param>
    /// <exception cref="UsageException">Such an option was given.</exception>
    public void RequireEffect(ParseResult result, TracedImage? traced = null, bool hasWindow = false)
    {
        if (traced is not null && FindDrawnOnly(result) is { } option)
        {
            throw new UsageException($"{option} draws triangles, and has no effect with --trace");
        }

        foreach (var (isGiven, words, obstacle) in FindObstacles(result, hasWindow))
        {
            UsageException.ThrowIf(isGiven && obstacle is not null, $"{words} has no effect {obstacle}");
        }
    }

    /// <summary>Lists whether options are given, with what would take away their effect.</summary>
    private IEnumerable<(bool IsGiven, string Words, string? Obstacle)> FindObstacles(ParseResult result, bool hasWindow)
    {
        var settings = Settings(result);
        var wireframe = !hasWindow && settings.Wireframe ? "with --wireframe" : null;
        var plainLight = wireframe ?? (!hasWindow && settings.Shading == Shading.PerVertex ? "with --shading vertex" : null);
        return
        [
            (settings.Shading == Shading.PerVertex, "--shading vertex", wireframe),
            (!settings.Shadows, "--no-shadows", plainLight),
            (!settings.AmbientOcclusion, "--no-ambient-occlusion", settings.Culling is null ? "with --detail 0" : plainLight),
        ];
    }

    private string? FindDrawnOnly(ParseResult result) =>
        result.GetValue(_wireframe) ? "--wireframe"
        : result.GetValue(_grid) ? "--grid"
        : result.GetValue(_noShadows) ? "--no-shadows"
        : result.GetValue(_noAmbientOcclusion) ? "--no-ambient-occlusion"
        : result.GetValue(_shading) == Shading.PerVertex ? "--shading vertex"
        : result.GetValue(_sampleCount) is not null ? "--samples"
        : result.GetValue(_gatheredFrames) is not null ? "--gather"
        : result.GetValue(_minProjectedSize) is not null ? "--detail"
        : result.GetValue(_maxInstances) is not null ? "--instances"
        : null;

    /// <summary>Returns the render settings that the command line asks for.</summary>
    /// <param name="result">The command line.</param>
    /// <param name="gatheredFrames">Number of frames that are gathered where it does not say.</param>
    public RenderSettings Settings(ParseResult result, int gatheredFrames = 1)
    {
        var maxInstances = result.GetValue(_maxInstances);
        var minProjectedSize = result.GetValue(_minProjectedSize) ?? DefaultCulling.MinProjectedSize;
        var culling = DefaultCulling with
        {
            MinProjectedSize = minProjectedSize,
            InstanceBudget = maxInstances ?? DefaultCulling.InstanceBudget,
        };
        return DefaultSettings with
        {
            Wireframe = result.GetValue(_wireframe),
            Grid = result.GetValue(_grid),
            Axes = result.GetValue(_grid),
            Culling = minProjectedSize > 0 ? culling : null,
            InstanceBudget = maxInstances ?? DefaultSettings.InstanceBudget,
            Samples = result.GetValue(_sampleCount) ?? DefaultSettings.Samples,
            GatheredFrames = result.GetValue(_gatheredFrames) ?? gatheredFrames,
            Shading = result.GetValue(_shading) ?? DefaultSettings.Shading,
            Shadows = !result.GetValue(_noShadows),
            AmbientOcclusion = !result.GetValue(_noAmbientOcclusion),
        };
    }
}
