using System.Diagnostics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Architecture;

/// <summary>What the scripts do on machines that lack something.</summary>
public sealed class SetupScriptTests
{
    /// <summary>A dead display must not pass as green, while other systems and users may lack what they can't have.</summary>
    [SkippableTheory]
    [InlineData("", 0, "")]
    [InlineData("not meant for this system: modes are those of Unix", 0, "skipped 1: not meant for this system: modes are those of Unix\n")]
    [InlineData("there is no display :99", 1, "skipped 1 that could run: there is no display :99\n")]
    [InlineData("no & \"display\"", 1, "skipped 1 that could run: no & \"display\"\n")]
    public void ReportSkips_OfAReason_FailsWhereTheTestCouldRun(string reason, int exitCode, string report)
    {
        Elsewhere.SkipOnWindows("there is no bash");
        using var folder = new TemporaryFolder();
        var skipped = System.Security.SecurityElement.Escape(reason) is { Length: > 0 } escaped
            ? $"<UnitTestResult testName=\"b\" outcome=\"NotExecuted\"><Output><ErrorInfo><Message>{escaped}</Message></ErrorInfo></Output>"
            : "";
        folder.Write("tests.trx", $"<Results><UnitTestResult testName=\"a\" outcome=\"Passed\" />\n{skipped}\n</Results>");
        using var process = Process.Start(new ProcessStartInfo("bash", ["-c", ". eng/setup.sh; report_skips \"$1\"", "test", folder.Path])
        {
            WorkingDirectory = Repository.Full("."), RedirectStandardOutput = true,
        })!;
        Assert.Equal(report, process.StandardOutput.ReadToEnd());
        process.WaitForExit();
        Assert.Equal(exitCode, process.ExitCode);
    }

    /// <summary>Compiling ahead of time needs a package; where it can't be had, run.sh starts what a plain build makes.</summary>
    [SkippableFact]
    public void BuildReady_WherePublishingFails_BuildsAndLeavesNoHalf()
    {
        Elsewhere.SkipOnWindows("there is no bash");
        using var folder = new TemporaryFolder();
        const string script = """
            set -euo pipefail
            . eng/setup.sh
            root="$1"
            is_up_to_date() { return 1; }
            run_dotnet() { mkdir -p "$root/Project/bin/ready" && return 1; }
            build() { echo "built $1"; }
            build_ready Project
            [ ! -e "$root/Project/bin/ready" ] && [ -e "$root/Project/obj/ready.stamp" ] && echo "ready"
            """;
        using var process = Process.Start(new ProcessStartInfo("bash", ["-c", script, "test", folder.Path])
        {
            WorkingDirectory = Repository.Full("."), RedirectStandardOutput = true,
        })!;
        Assert.Equal("built Project\nready\n", process.StandardOutput.ReadToEnd());
        process.WaitForExit();
        Assert.Equal(0, process.ExitCode);
    }
}
