using System.CommandLine;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;

namespace FractalEngine.App.Commands;

/// <summary>The options of the commands that draw.</summary>
internal sealed class DrawOptions
{
    private readonly Option<bool> _wireframe = new("--wireframe") { Description = "Draw only the edges of the triangles." };
    private readonly Option<bool> _grid = new("--grid") { Description = "Draw a grid on the ground, and the axes." };

    private readonly Option<long?> _instances = new("--instances")
    {
        Description = $"The most instances of one fractal to draw; {FractalLimits.DrawnInstances} unless stated.",
        HelpName = "N",
        CustomParser = SharedOptions.ParseInteger(1, 100_000_000),
    };

    private readonly Option<long?> _samples = new("--samples")
    {
        Description = "Samples a pixel against jagged edges; 4 unless stated.",
        HelpName = "N",
        CustomParser = SharedOptions.ParseInteger(0, 32),
    };

    private readonly Option<Shading?> _shading = new("--shading")
    {
        Description = "Where the lights act: at the vertices, or at every pixel; vertex unless stated.",
        HelpName = "vertex|pixel",
        CustomParser = result => SharedOptions.ParseWord(result, ("vertex", Shading.PerVertex), ("pixel", Shading.PerPixel)),
    };

    private readonly Option<Projection?> _projection = SharedOptions.Projection();
    private readonly Option<(int Width, int Height)?> _resolution = SharedOptions.Resolution();

    public void AddTo(Command command)
    {
        foreach (var option in (Option[])[_resolution, _projection, _shading, _wireframe, _grid, _instances, _samples])
        {
            command.Add(option);
        }
    }

    public (int Width, int Height) Resolution(ParseResult result) => result.GetValue(_resolution) ?? (1280, 720);

    public Projection? Projection(ParseResult result) => result.GetValue(_projection);

    public RenderSettings Settings(ParseResult result)
    {
        var settings = new RenderSettings
        {
            Wireframe = result.GetValue(_wireframe),
            Grid = result.GetValue(_grid),
            Axes = result.GetValue(_grid),
        };
        return settings with
        {
            InstanceBudget = (int)(result.GetValue(_instances) ?? settings.InstanceBudget),
            Samples = (int)(result.GetValue(_samples) ?? settings.Samples),
            Shading = result.GetValue(_shading) ?? settings.Shading,
        };
    }
}
