using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Fractals;
using FractalEngine.Parsing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests of <c>approximate</c> in processes: what signals leave, and that the number of threads changes nothing.</summary>
public sealed class ApproximateProcessTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [InlineData(true)]
    [InlineData(false)]
    public void Approximate_Interrupted_LeavesTheBestOnlyIfAsked(bool keepsPartial)
    {
        Signals.Require("INT");
        MeshFile.Write(_folder["terrain.obj"], OrganicModels.Create(OrganicKind.Terrain, 1, 1_000).Mesh);
        string[] arguments = ["approximate", "terrain.obj", "--output", "found.fdo", "--report", "found.json", "--verbose"];
        using var process = AppProcess.Start(_folder.Path, [], keepsPartial ? [.. arguments, "--keep-partial"] : arguments);
        try
        {
            // One half with its mirror image is measured, and the search for the other one takes as long.
            for (var line = ""; !line.Contains("best so far", StringComparison.Ordinal);)
            {
                line = process.StandardError.ReadLine() ?? throw new EndOfStreamException("the process has ended");
            }

            Signals.Send(process, "INT");
            Assert.True(process.WaitForExit(Polling.Deadline), "the process does not end");
        }
        finally
        {
            process.Kill();
        }

        Assert.Equal(130, process.ExitCode);
        Assert.EndsWith("error: interrupted\n", process.StandardError.ReadToEnd(), StringComparison.Ordinal);
        string[] kept = keepsPartial ? ["found-base.obj", "found.fdo", "found.json"] : [];
        Assert.Equal([.. kept, "terrain.obj"], Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Order(StringComparer.Ordinal));
        if (keepsPartial)
        {
            Assert.Contains("\"endedBy\": \"interruption\"", File.ReadAllText(_folder["found.json"]), StringComparison.Ordinal);
            Assert.InRange(FractalFile.Read(_folder["found.fdo"]).Flatten(1_000).FaceCount, 2, 999);
        }
    }

    [Fact]
    public void Approximate_OnAnyNumberOfThreads_WritesTheSameFiles()
    {
        var input = UnseenFractals.Create(FractalKind.Leaves, 1, 600);
        MeshFile.Write(_folder["mesh.obj"], new Damage(DamageKind.Noise, 0.01).Apply(input, 1).Mesh);
        var (one, four) = (FilesOf("1"), FilesOf("4"));
        Assert.Contains("APPROXIMATE", one[0], StringComparison.Ordinal);
        Assert.Equal(one, four);

        string[] FilesOf(string threads)
        {
            var (exitCode, output, error) = AppProcess.Run(
                _folder.Path, new Dictionary<string, string?> { ["DOTNET_PROCESSOR_COUNT"] = threads },
                "approximate", "mesh.obj", "--output", $"{threads}/found.fdo", "--effort", "0.5", "--quiet");
            Assert.True(exitCode == 0, error);
            return [output, .. Directory.GetFiles(_folder[threads]).Order(StringComparer.Ordinal).Select(File.ReadAllText)];
        }
    }
}
