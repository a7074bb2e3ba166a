using System.CommandLine;
using FractalEngine.App.Jobs;
using FractalEngine.App.Shell;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Exports;

namespace FractalEngine.App.Options;

/// <summary>The options of <c>export</c> on how much is written, and in which coordinates.</summary>
internal sealed class ExportOptions
{
    private readonly Option<bool> _noMaterials = SharedOptions.Flag(
        "--no-materials", "Write no material file (.mtl) beside the mesh.");

    private readonly Option<bool> _flat = SharedOptions.Flag("--flat", "Write each instance by itself to .3mf and .glb, too.");

    private readonly Option<bool> _weld = SharedOptions.Flag(
        "--weld", "Join vertices that coincide, and leave out walls between solids that stand side by side.");

    private readonly Option<long?> _instances = NumberOption.Integer(
        "--instances", "N", 1, (long)Array.MaxLength, "Maximum number of instances: the largest parts are divided first.");

    private readonly Option<Handedness?> _handed = WordOption.Single(
        "--handed", "Handedness of the coordinates (default: right for .ply, .stl, .3mf, .glb; else as they are).",
        ("right", Handedness.Right), ("left", Handedness.Left));

    private readonly Option<UpAxis?> _up = WordOption.Single(
        "--up", "The axis that points up (default: z for .stl and .3mf, else y).", ("y", UpAxis.Y), ("z", UpAxis.Z));

    private readonly Option<double?> _unit = NumberOption.Positive(
        "--unit", "Nmm", "Length of a scene unit in the file (default: 1mm).", unit: "mm");

    private readonly Option<double?> _height = NumberOption.Positive(
        "--height", "Nmm", "Height of the whole in the file, instead of --unit.", unit: "mm");

    public void AddTo(Command command) =>
        SharedOptions.AddAll(command, _noMaterials, _flat, _weld, _instances, _handed, _up, _unit, _height);

    /// <summary>Returns the export into a file.</summary>
    /// <exception cref="UsageException">An option has no effect on its format.</exception>
    public ExportJob JobOf(ParseResult result, string output)
    {
        RequireEffect(result, output);
        return new(output, !result.GetValue(_noMaterials), result.GetValue(_weld));
    }

    /// <summary>Requires no option that changes nothing in a format.</summary>
    /// <param name="result">What is given.</param>
    /// <param name="output">Name of the file, with its ending.</param>
    /// <exception cref="UsageException">An option has no effect.</exception>
    private void RequireEffect(ParseResult result, string output)
    {
        Option[] idle = Path.GetExtension(output).ToUpperInvariant() switch
        {
            ".HTML" => [_flat, _instances, _handed, _up, _unit, _height],
            ".CSV" => [_weld],
            _ => [],
        };
        if (idle.FirstOrDefault(option => result.GetResult(option) is { Implicit: false }) is { } given)
        {
            throw new UsageException(given == _weld
                ? "--weld makes one mesh, and so one row of .csv: choose another ending, or leave it out"
                : $"{given.Name} has no effect on .html, which keeps levels and coordinates as they are");
        }
    }

    /// <summary>Returns the settings of an export.</summary>
    /// <exception cref="UsageException">Two options contradict each other.</exception>
    public ExportSettings SettingsOf(ParseResult result) => result.GetValue(_unit) is not null && result.GetValue(_height) is not null
        ? throw new UsageException("--unit and --height both say how long a scene unit is: choose one of them")
        : new()
        {
            MaxFaces = FractalLimits.ExportedFaces.Value,
            IsFlat = result.GetValue(_flat),
            MaxInstances = result.GetValue(_instances),
            Handedness = result.GetValue(_handed),
            Up = result.GetValue(_up),
            UnitLength = result.GetValue(_unit),
            Height = result.GetValue(_height),
        };
}
