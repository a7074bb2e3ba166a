using System.Diagnostics;

namespace FractalEngine.Tests.Support;

/// <summary>Runs commands on a terminal of their own, where programs tell more than into a pipe.</summary>
internal static class Terminal
{
    /// <summary>Runs a command to its end. Skips the test where no terminal can be made.</summary>
    /// <param name="folder">Working directory of the command.</param>
    /// <param name="command">A line for the shell.</param>
    /// <returns>All that the terminal got, with carriage returns.</returns>
    public static string Run(string folder, string command)
    {
        Skip.IfNot(File.Exists("/usr/bin/script"), "the program 'script', which makes a terminal, is not installed");
        var start = new ProcessStartInfo("script", ["-qec", command, "/dev/null"])
        {
            WorkingDirectory = folder,
            RedirectStandardInput = true,
            RedirectStandardOutput = true,
        };
        using var process = Process.Start(start)!;
        var output = process.StandardOutput.ReadToEndAsync();
        if (!process.WaitForExit(Polling.Deadline))
        {
            process.Kill(entireProcessTree: true);
            throw new TimeoutException($"{command} did not end within {Polling.Deadline}");
        }

        return output.GetAwaiter().GetResult();
    }
}
