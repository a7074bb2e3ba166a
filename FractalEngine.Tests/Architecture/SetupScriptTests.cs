using System.Diagnostics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Architecture;

/// <summary>What the scripts do on machines that lack something.</summary>
public sealed class SetupScriptTests
{
    /// <summary>Compiling ahead of time needs a package; where it can't be had, run.sh starts what a plain build makes.</summary>
    [SkippableFact]
    public void BuildReady_WherePublishingFails_BuildsAndLeavesNoHalf()
    {
        Skip.If(OperatingSystem.IsWindows(), "there is no bash");
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
