using System.Diagnostics;
using System.Reflection;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Starts the program as its users do, or that of the benchmarks: in a process, with arguments, streams and an exit code.
/// </summary>
internal static class AppProcess
{
    /// <summary>Runs the program to its end.</summary>
    /// <param name="folder">Working directory of the process.</param>
    /// <param name="arguments">Arguments as on the command line.</param>
    public static AppResult Run(string folder, params string[] arguments) => Run(folder, [], arguments);

    /// <summary>Runs the program to its end with some environment variables changed. Null removes a variable.</summary>
    public static AppResult Run(string folder, Dictionary<string, string?> environment, params string[] arguments) =>
        WaitForResult(Start(folder, environment, arguments), arguments);

    /// <summary>Runs the benchmarks' program to its end.</summary>
    public static AppResult RunBenchmarks(string folder, params string[] arguments) =>
        WaitForResult(Start("FractalEngine.Benchmarks", folder, [], arguments), arguments);

    /// <summary>Starts the program. The caller waits for its end.</summary>
    public static Process Start(string folder, Dictionary<string, string?> environment, params string[] arguments) =>
        Start("FractalEngine.App", folder, environment, arguments);

    private static AppResult WaitForResult(Process process, string[] arguments)
    {
        using var ended = process;
        var output = process.StandardOutput.ReadToEndAsync();
        var error = process.StandardError.ReadToEndAsync();
        if (!process.WaitForExit(Polling.Deadline))
        {
            process.Kill(entireProcessTree: true);
            throw new TimeoutException($"{string.Join(' ', arguments)} did not end within {Polling.Deadline}");
        }

        return new(process.ExitCode, output.GetAwaiter().GetResult(), error.GetAwaiter().GetResult());
    }

    private static Process Start(string assembly, string folder, Dictionary<string, string?> environment, string[] arguments)
    {
        var start = new ProcessStartInfo("dotnet", ["exec", Path.ChangeExtension(Assembly.Load(assembly).Location, ".dll"), .. arguments])
        {
            WorkingDirectory = folder,
            RedirectStandardOutput = true,
            RedirectStandardError = true,
        };
        foreach (var (name, value) in environment)
        {
            start.Environment[name] = value;
        }

        return Process.Start(start)!;
    }
}
