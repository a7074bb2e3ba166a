using System.CommandLine;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;

namespace FractalEngine.App.Commands;

/// <summary>The options of the commands that draw.</summary>
internal sealed class DrawOptions
{
    private static readonly (string Word, Optimisation Value)[] OptimisationWords =
    [
        ("backs", Optimisation.BackFaceCulling), ("outside", Optimisation.FrustumCulling), ("hidden", Optimisation.OcclusionCulling),
        ("empty-faces", Optimisation.DegenerateRemoval), ("state", Optimisation.StateFiltering),
        ("buffers", Optimisation.BufferReuse), ("sharing", Optimisation.MeshSharing), ("sight", Optimisation.LazyLoading),
        ("still", Optimisation.Idle),
    ];

    private readonly Option<bool> _wireframe = new("--wireframe") { Description = "Draw only the edges of the triangles." };
    private readonly Option<bool> _grid = new("--grid") { Description = "Draw a grid on the ground, and the axes." };

    private readonly Option<long?> _maxInstances = new("--instances")
    {
        Description =
        $"The most instances to draw; {new CullingSettings().InstanceBudget} unless stated ({FractalLimits.MaxDrawnInstances} of one fractal with --detail 0).",
        HelpName = "N",
        CustomParser = SharedOptions.ParseInteger(1, 100_000_000),
    };

    private readonly Option<long?> _sampleCount = new("--samples")
    {
        Description = "Samples a pixel against jagged edges; 4 unless stated.",
        HelpName = "N",
        CustomParser = SharedOptions.ParseInteger(0, 32),
    };

    private readonly Option<double?> _minProjectedSize = new("--detail")
    {
        Description =
        "Sub-fractals that appear smaller are drawn as one copy of their base mesh: pixels, 1.5 unless stated; 0 draws every instance of every fractal.",
        HelpName = "PIXELS",
        CustomParser = SharedOptions.ParseNumber(0, 1000),
    };

    private readonly Option<Shading?> _shading = new("--shading")
    {
        Description = "Where the lights act: at the vertices, or at every pixel; vertex unless stated.",
        HelpName = "vertex|pixel",
        CustomParser = result => SharedOptions.ParseWord(result, ("vertex", Shading.PerVertex), ("pixel", Shading.PerPixel)),
    };

    private readonly Option<Optimisation[]> _disabled = new("--without")
    {
        Description =
        $"Do something that is left out since nothing is seen of it, for comparison: {string.Join(", ", OptimisationWords.Select(item => item.Word))}. May be given several times.",
        HelpName = "SKIP",
        CustomParser = result => SharedOptions.ParseWords(result, OptimisationWords),
    };

    private readonly Option<Projection?> _projection = SharedOptions.ProjectionOption();
    private readonly Option<(int Width, int Height)?> _resolution = SharedOptions.ResolutionOption();

    public void AddTo(Command command)
    {
        foreach (var option in (Option[])[_resolution, _projection, _shading, _wireframe, _grid, _minProjectedSize, _maxInstances,
            _sampleCount, _disabled])
        {
            command.Add(option);
        }
    }

    public (int Width, int Height) Resolution(ParseResult result) => result.GetValue(_resolution) ?? (1280, 720);

    public Projection? Projection(ParseResult result) => result.GetValue(_projection);

    /// <summary>True unless <c>--without</c> names it.</summary>
    public bool IsEnabled(ParseResult result, Optimisation optimisation) => !(result.GetValue(_disabled) ?? []).Contains(optimisation);

    /// <summary>How to load the file, given how any command would.</summary>
    public LoadOptions WithLoadOptions(ParseResult result, LoadOptions options) =>
        options with { ShareModels = IsEnabled(result, Optimisation.MeshSharing) };

    public RenderSettings Settings(ParseResult result)
    {
        var settings = new RenderSettings
        {
            Wireframe = result.GetValue(_wireframe),
            Grid = result.GetValue(_grid),
            Axes = result.GetValue(_grid),
        };
        var culling = settings.Culling! with
        {
            MinProjectedSize = result.GetValue(_minProjectedSize) ?? settings.Culling.MinProjectedSize,
            InstanceBudget = (int)(result.GetValue(_maxInstances) ?? settings.Culling.InstanceBudget),
            FrustumCulling = IsEnabled(result, Optimisation.FrustumCulling),
            OcclusionCulling = IsEnabled(result, Optimisation.OcclusionCulling),
        };
        return settings with
        {
            Culling = culling.MinProjectedSize > 0 ? culling : null,
            InstanceBudget = (int)(result.GetValue(_maxInstances) ?? settings.InstanceBudget),
            Samples = (int)(result.GetValue(_sampleCount) ?? settings.Samples),
            Shading = result.GetValue(_shading) ?? settings.Shading,
            BackFaceCulling = IsEnabled(result, Optimisation.BackFaceCulling),
            RemoveDegenerateTriangles = IsEnabled(result, Optimisation.DegenerateRemoval),
            FilterRedundantState = IsEnabled(result, Optimisation.StateFiltering),
            ReuseBuffers = IsEnabled(result, Optimisation.BufferReuse),
            ShareTextures = IsEnabled(result, Optimisation.MeshSharing),
            LazyLoading = IsEnabled(result, Optimisation.LazyLoading),
        };
    }
}
