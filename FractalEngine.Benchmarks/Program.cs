using BenchmarkDotNet.Running;
using FractalEngine.Benchmarks.Approximation;
using FractalEngine.Benchmarks.Colliders;
using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Growth;
using FractalEngine.Benchmarks.Light;
using FractalEngine.Benchmarks.Loading;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Benchmarks.Paper;
using FractalEngine.Benchmarks.Physics;
using FractalEngine.Benchmarks.Precision;
using FractalEngine.Benchmarks.Rays;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Windowing;

// Commands are for what BenchmarkDotNet can't measure: rows that take turns, and frames. Everything else is a class of it.
var commands = new Dictionary<string, Func<string[], int>>
{
    ["front"] = arguments => ParetoFrontCommand.Run(arguments),
    ["growth"] = arguments => GrowthCommand.Run(arguments),
    ["loading"] = arguments => LoadingCommand.Run(arguments),
    ["frames"] = arguments => FramesCommand.Run(arguments),
    ["skips"] = arguments => OptimisationsCommand.Run(arguments),
    ["window"] = arguments => WindowCommand.Run(arguments),
    ["compare"] = arguments => CompareCommand.Run(arguments),
    ["rays"] = arguments => RaysCommand.Run(arguments),
    ["trace"] = arguments => TraceCommand.Run(arguments),
    ["light"] = arguments => LightCommand.Run(arguments),
    ["physics"] = arguments => PhysicsCommand.Run(arguments),
    ["precision"] = arguments => PrecisionCommand.Run(arguments),
    ["paper"] = arguments => PaperCommand.Run(arguments),
    ["approximate"] = arguments => ApproximationCommand.Run(arguments),
    ["merge"] = arguments => MergeCommand.Run(arguments),
};

if (args is not [[not '-', ..] name, .. var rest])
{
    var outputIndex = Array.IndexOf(args, "--output");
    var folder = outputIndex >= 0 && outputIndex + 1 < args.Length ? args[outputIndex + 1] : null;
    string[] benchmarkDotNetArguments = folder is null ? args : [.. args[..outputIndex], .. args[(outputIndex + 2)..]];
    var summaries = BenchmarkSwitcher.FromAssembly(typeof(CommandLineParser).Assembly)
        .Run(benchmarkDotNetArguments, ReportConfig.Create(folder));
    return summaries.Any(summary => summary.HasCriticalValidationErrors || summary.Reports.Any(report => !report.Success)) ? 1 : 0;
}

if (!commands.TryGetValue(name, out var run))
{
    Console.Error.WriteLine(
        $"error: unknown command '{name}': expected one of {string.Join(' ', commands.Keys)}, or an option of BenchmarkDotNet");
    return 2;
}

try
{
    return run(rest);
}
catch (GraphicsUnavailableException exception)
{
    Console.Error.WriteLine($"error: {exception.Message}");
    return 3;
}
catch (SourceException exception)
{
    Console.Error.WriteLine(exception.Diagnostic);
    return 1;
}
catch (Exception exception) when (exception is FractalLimitException or InvalidDataException or IOException or UnauthorizedAccessException)
{
    Console.Error.WriteLine($"error: {exception.Message}");
    return 1;
}
