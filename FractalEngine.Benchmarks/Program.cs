using BenchmarkDotNet.Running;
using FractalEngine.Benchmarks.Colliders;
using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Growth;
using FractalEngine.Benchmarks.Loading;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Benchmarks.Paper;
using FractalEngine.Benchmarks.Physics;
using FractalEngine.Benchmarks.Precision;
using FractalEngine.Core.Fractals;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Windowing;

// Measurements that BenchmarkDotNet can't make, since their rows have to take turns, or since they draw; everything else is a class of it.
var commands = new Dictionary<string, Func<string[], int>>
{
    ["front"] = words => ParetoFrontCommand.Run(words),
    ["table"] = words => ColliderComparisonCommand.Run(words),
    ["growth"] = words => GrowthCommand.Run(words),
    ["loading"] = words => LoadingCommand.Run(words),
    ["frames"] = words => FramesCommand.Run(words),
    ["skips"] = words => OptimisationsCommand.Run(words),
    ["window"] = words => WindowCommand.Run(words),
    ["physics"] = words => PhysicsCommand.Run(words),
    ["precision"] = words => PrecisionCommand.Run(words),
    ["paper"] = words => PaperCommand.Run(words),
};

if (args is not [[not '-', ..] name, .. var rest])
{
    var at = Array.IndexOf(args, "--output");
    var output = at >= 0 && at + 1 < args.Length ? args[at + 1] : null;
    string[] others = output is null ? args : [.. args[..at], .. args[(at + 2)..]];
    var summaries = BenchmarkSwitcher.FromAssembly(typeof(CommandLineParser).Assembly).Run(others, ReportConfig.Create(output));
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
