using System.Diagnostics;
using System.Reflection;

namespace FractalEngine.Tests.Support;

/// <summary>The program as its users start it: another process, with arguments, streams and an exit code.</summary>
internal static class AppProcess
{
    // Long enough for a loaded machine; a hang is a failure.
    private static readonly TimeSpan Patience = TimeSpan.FromSeconds(60);

    private static readonly string Program =
        Path.ChangeExtension(Assembly.Load("FractalEngine.App").Location, ".dll");

    /// <summary>Runs the program to its end.</summary>
    /// <param name="folder">The working directory.</param>
    /// <param name="arguments">As on the command line.</param>
    public static AppResult Run(string folder, params string[] arguments) => Run(folder, [], arguments);

    /// <summary>Runs the program to its end with some variables of the environment changed; null removes one.</summary>
    public static AppResult Run(string folder, Dictionary<string, string?> environment, params string[] arguments)
    {
        using var process = Start(folder, environment, arguments);
        var output = process.StandardOutput.ReadToEndAsync();
        var error = process.StandardError.ReadToEndAsync();
        if (!process.WaitForExit(Patience))
        {
            process.Kill(entireProcessTree: true);
            throw new TimeoutException($"{string.Join(' ', arguments)} did not end within {Patience}");
        }

        return new(process.ExitCode, output.GetAwaiter().GetResult(), error.GetAwaiter().GetResult());
    }

    /// <summary>Starts the program; whoever calls waits for its end.</summary>
    public static Process Start(string folder, Dictionary<string, string?> environment, params string[] arguments)
    {
        var start = new ProcessStartInfo("dotnet", ["exec", Program, .. arguments])
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
