using System.CommandLine;
using FractalEngine.Core.Detail;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;

namespace FractalEngine.App.Commands;

/// <summary>The options of the commands that draw.</summary>
internal sealed class DrawOptions
{
    private static readonly (string Word, Skip Value)[] SkipWords =
    [
        ("backs", Skip.Backs), ("outside", Skip.Outside), ("hidden", Skip.Hidden), ("empty-faces", Skip.EmptyFaces), ("state", Skip.State),
        ("buffers", Skip.Buffers), ("sharing", Skip.Sharing), ("sight", Skip.Sight), ("still", Skip.Still),
    ];

    private readonly Option<bool> _wireframe = new("--wireframe") { Description = "Draw only the edges of the triangles." };
    private readonly Option<bool> _grid = new("--grid") { Description = "Draw a grid on the ground, and the axes." };

    private readonly Option<long?> _instances = new("--instances")
    {
        Description = $"The most instances to draw; {new DetailSettings().InstanceBudget} unless stated ({FractalLimits.DrawnInstances} of one fractal with --detail 0).",
        HelpName = "N",
        CustomParser = SharedOptions.ParseInteger(1, 100_000_000),
    };

    private readonly Option<long?> _samples = new("--samples")
    {
        Description = "Samples a pixel against jagged edges; 4 unless stated.",
        HelpName = "N",
        CustomParser = SharedOptions.ParseInteger(0, 32),
    };

    private readonly Option<double?> _detail = new("--detail")
    {
        Description = "Sub-fractals that appear smaller are drawn as one copy of their base mesh: pixels, 1.5 unless stated; 0 draws every instance of every fractal.",
        HelpName = "PIXELS",
        CustomParser = SharedOptions.ParseNumber(0, 1000),
    };

    private readonly Option<Shading?> _shading = new("--shading")
    {
        Description = "Where the lights act: at the vertices, or at every pixel; vertex unless stated.",
        HelpName = "vertex|pixel",
        CustomParser = result => SharedOptions.ParseWord(result, ("vertex", Shading.PerVertex), ("pixel", Shading.PerPixel)),
    };

    private readonly Option<Skip[]> _without = new("--without")
    {
        Description = $"Do something that is left out since nothing is seen of it, for comparison: {string.Join(", ", SkipWords.Select(item => item.Word))}. May be given several times.",
        HelpName = "SKIP",
        CustomParser = result => SharedOptions.ParseWords(result, SkipWords),
    };

    private readonly Option<Projection?> _projection = SharedOptions.Projection();
    private readonly Option<(int Width, int Height)?> _resolution = SharedOptions.Resolution();

    public void AddTo(Command command)
    {
        foreach (var option in (Option[])[_resolution, _projection, _shading, _wireframe, _grid, _detail, _instances, _samples, _without])
        {
            command.Add(option);
        }
    }

    public (int Width, int Height) Resolution(ParseResult result) => result.GetValue(_resolution) ?? (1280, 720);

    public Projection? Projection(ParseResult result) => result.GetValue(_projection);

    /// <summary>True unless <c>--without</c> names it.</summary>
    public bool Does(ParseResult result, Skip skip) => !(result.GetValue(_without) ?? []).Contains(skip);

    /// <summary>How to load the file, given how any command would.</summary>
    public LoadOptions Loading(ParseResult result, LoadOptions options) => options with { SharesFiles = Does(result, Skip.Sharing) };

    public RenderSettings Settings(ParseResult result)
    {
        var settings = new RenderSettings
        {
            Wireframe = result.GetValue(_wireframe),
            Grid = result.GetValue(_grid),
            Axes = result.GetValue(_grid),
        };
        var detail = settings.Detail! with
        {
            PixelSize = result.GetValue(_detail) ?? settings.Detail.PixelSize,
            InstanceBudget = (int)(result.GetValue(_instances) ?? settings.Detail.InstanceBudget),
            SkipsOutside = Does(result, Skip.Outside),
            SkipsHidden = Does(result, Skip.Hidden),
        };
        return settings with
        {
            Detail = detail.PixelSize > 0 ? detail : null,
            InstanceBudget = (int)(result.GetValue(_instances) ?? settings.InstanceBudget),
            Samples = (int)(result.GetValue(_samples) ?? settings.Samples),
            Shading = result.GetValue(_shading) ?? settings.Shading,
            SkipsBacks = Does(result, Skip.Backs),
            SkipsEmptyFaces = Does(result, Skip.EmptyFaces),
            SkipsSameState = Does(result, Skip.State),
            KeepsBuffers = Does(result, Skip.Buffers),
            SharesTextures = Does(result, Skip.Sharing),
            PreparesOnSight = Does(result, Skip.Sight),
        };
    }
}
