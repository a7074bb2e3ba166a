using System.Diagnostics;

namespace FractalEngine.Tests.Support;

/// <summary>Runs the `dotnet` command as a user does.</summary>
internal static class Dotnet
{
    // Builds take seconds, on a busy machine minutes.
    private static readonly TimeSpan Patience = TimeSpan.FromMinutes(4);

    /// <summary>Runs a command to its end; fails the test if it does not end.</summary>
    /// <param name="folder">Working directory.</param>
    /// <param name="environment">Variables to add to the environment, or null.</param>
    /// <param name="arguments">What follows `dotnet`.</param>
    public static (int ExitCode, string Output, string Error) Run(
        string folder, IReadOnlyDictionary<string, string>? environment, params string[] arguments)
    {
        var start = new ProcessStartInfo("dotnet", arguments)
        {
            WorkingDirectory = folder,
            RedirectStandardOutput = true,
            RedirectStandardError = true,
        };
        foreach (var (name, value) in environment ?? new Dictionary<string, string>())
        {
            start.Environment[name] = value;
        }

        using var process = Process.Start(start)!;
        var output = process.StandardOutput.ReadToEndAsync();
        var error = process.StandardError.ReadToEndAsync();
        if (!process.WaitForExit(Patience))
        {
            process.Kill(entireProcessTree: true);
            Assert.Fail($"dotnet {string.Join(' ', arguments)} did not end within {Patience}");
        }

        return (process.ExitCode, output.GetAwaiter().GetResult(), error.GetAwaiter().GetResult());
    }
}
