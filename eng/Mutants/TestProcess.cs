using System.Diagnostics;
using System.Globalization;
using System.Text;

namespace FractalEngine.Mutants;

/// <summary>Starts what builds and tests the copy, and ends all that came of it.</summary>
internal sealed class TestProcess : IDisposable
{
    private const string TokenName = "MUTANT_RUN";
    // Mutants that fill the memory must not take the machine with them.
    private const string HeapLimit = "0x140000000";
    private static readonly string Token = Guid.NewGuid().ToString("N");
    private static readonly List<(Process Process, string Number)> Displays = [];
    private static volatile bool _isEnding;
    private readonly Process _process;
    private readonly string _temporary;
    private readonly string _token;

    private TestProcess(Process process, string temporary, string token)
    {
        _process = process;
        _temporary = temporary;
        _token = token;
    }

    /// <summary>Starts the runner of the copy.</summary>
    /// <param name="tree">The copy.</param>
    /// <param name="folder">Folder of its own for temporary files and the log.</param>
    /// <param name="worker">Number of the display to draw on.</param>
    /// <param name="environment">Further environment variables.</param>
    /// <param name="arguments">Arguments of the runner.</param>
    public static TestProcess Start(
        string tree, string folder, int worker, IReadOnlyDictionary<string, string> environment, params string[] arguments)
    {
        if (_isEnding)
        {
            Thread.Sleep(Timeout.Infinite);
        }

        string temporary = Path.Combine(folder, "tmp");
        Directory.CreateDirectory(temporary);
        string token = $"{Token}-{Guid.NewGuid():N}";
        var start = new ProcessStartInfo("sh")
        {
            WorkingDirectory = Path.Combine(tree, "FractalEngine.Tests"),
        };
        string program = Path.Combine(tree, "FractalEngine.Tests/bin/ready/FractalEngine.Tests.dll");
        const string Command = "exec env --default-signal=INT dotnet exec \"$@\" </dev/null >\"$LOG\" 2>&1";
        foreach (string argument in (string[])["-c", Command, "sh", program, .. arguments])
        {
            start.ArgumentList.Add(argument);
        }

        foreach (var (name, value) in environment)
        {
            start.Environment[name] = value;
        }

        start.Environment["LOG"] = Path.Combine(folder, "log");
        start.Environment["TMPDIR"] = temporary;
        start.Environment[TokenName] = token;
        start.Environment["DOTNET_GCHeapHardLimit"] = HeapLimit;
        if (worker < Displays.Count)
        {
            start.Environment["DISPLAY"] = ":" + Displays[worker].Number;
        }

        return new(Process.Start(start)!, temporary, token);
    }

    /// <summary>Runs a command of the SDK in the copy.</summary>
    /// <exception cref="InvalidOperationException">It failed; the message is its output.</exception>
    public static void Dotnet(string tree, params string[] arguments)
    {
        if (!TryDotnet(tree, out string output, arguments))
        {
            throw new InvalidOperationException($"dotnet {string.Join(' ', arguments)} failed in {tree}:\n{output}");
        }
    }

    /// <summary>Runs a command of the SDK in the copy, and returns whether it succeeds.</summary>
    public static bool TryDotnet(string tree, out string output, params string[] arguments)
    {
        var start = new ProcessStartInfo("dotnet", arguments) { WorkingDirectory = tree, RedirectStandardOutput = true };
        start.Environment[TokenName] = Token;
        start.Environment["MSBUILDDISABLENODEREUSE"] = "1";
        using var process = Process.Start(start)!;
        output = process.StandardOutput.ReadToEnd();
        process.WaitForExit();
        return process.ExitCode == 0;
    }

    /// <summary>Starts a display for each worker, where the machine has the program for it.</summary>
    /// <returns>Whether tests can draw.</returns>
    public static bool StartDisplays(int workers)
    {
        for (int i = 0; i < workers; i++)
        {
            var start = new ProcessStartInfo("sh")
            {
                RedirectStandardOutput = true,
                ArgumentList = { "-c", "exec Xvfb -displayfd 1 -screen 0 1280x960x24 -noreset -nolisten tcp 2>/dev/null </dev/null" },
            };
            start.Environment[TokenName] = Token;
            var display = Process.Start(start)!;
            if (display.StandardOutput.ReadLine() is not { Length: > 0 } number)
            {
                return false;
            }

            Displays.Add((display, number));
        }

        return true;
    }

    /// <summary>Ends all that this program started.</summary>
    public static void EndAll()
    {
        _isEnding = true;
        Kill(Token);
        // What was being started meanwhile.
        Thread.Sleep(200);
        Kill(Token);
    }

    /// <summary>Waits for the end.</summary>
    /// <returns>The exit code.</returns>
    public int Wait()
    {
        _process.WaitForExit();
        if (_isEnding)
        {
            // What was killed from outside has no verdict.
            Thread.Sleep(Timeout.Infinite);
        }

        return _process.ExitCode;
    }

    /// <summary>Ends its children and removes its temporary files.</summary>
    public void Dispose()
    {
        Kill(_token);
        _process.Dispose();
        for (int attempt = 0; ; attempt++)
        {
            try
            {
                Directory.Delete(_temporary, true);
                return;
            }
            catch (IOException) when (attempt < 20)
            {
                // A child that is just ending may still write.
                Thread.Sleep(50);
            }
        }
    }

    // Children of tests, and theirs, are found by the variable that they inherit: some have sessions of their own.
    private static void Kill(string token)
    {
        byte[] wanted = Encoding.ASCII.GetBytes($"{TokenName}={token}");
        foreach (string folder in Directory.EnumerateDirectories("/proc"))
        {
            if (!int.TryParse(Path.GetFileName(folder), CultureInfo.InvariantCulture, out int id) || id == Environment.ProcessId)
            {
                continue;
            }

            try
            {
                if (File.ReadAllBytes(Path.Combine(folder, "environ")).AsSpan().IndexOf(wanted) >= 0)
                {
                    Process.GetProcessById(id).Kill();
                }
            }
            catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or ArgumentException
                or InvalidOperationException or System.ComponentModel.Win32Exception)
            {
                // Ended meanwhile, or someone else's.
            }
        }
    }
}
