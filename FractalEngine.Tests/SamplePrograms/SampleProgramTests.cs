using System.Diagnostics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.SamplePrograms;

/// <summary>Tests that the programs in samples/ are short, say what they print, print just that, and are what the README shows.</summary>
public sealed class SampleProgramTests : IDisposable
{
    private const int MaxLines = 40;
    private const string OutputHeading = "// Output:";

    // Building a program of one file takes seconds, on a busy machine a minute.
    private static readonly TimeSpan Patience = TimeSpan.FromMinutes(4);

    private readonly TemporaryFolder _folder = new();

    public static TheoryData<string> Programs =>
        [.. Directory.GetFiles(Repository.Full("samples"), "*.cs").Select(file => Path.GetFileName(file)).Order(StringComparer.Ordinal)];

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Programs_AreOneForEachUse() => Assert.True(Programs.Count >= 7, $"only {Programs.Count} programs");

    [Theory]
    [MemberData(nameof(Programs))]
    public void Program_IsShortAndSaysWhatItPrints(string program)
    {
        var lines = File.ReadAllLines(Repository.Full("samples/" + program));
        Assert.InRange(lines.Length, 10, MaxLines);
        Assert.StartsWith("#:project ../FractalEngine.", lines[0], StringComparison.Ordinal);
        Assert.Contains("#:property PublishAot=false", lines);
        Assert.NotEmpty(ExpectedOutput(lines));
    }

    [Fact]
    public void QuickStart_HoldsTheProgramOfTheReadMe()
    {
        var readMe = File.ReadAllText(Repository.Full("README.md"));
        var start = readMe.IndexOf("var sponge = Fractal.Of(", StringComparison.Ordinal);
        Assert.True(start >= 0, "the README has no program");
        var block = readMe[start..readMe.IndexOf("```", start, StringComparison.Ordinal)];
        Assert.Contains(block.Trim(), File.ReadAllText(Repository.Full("samples/quick-start.cs")), StringComparison.Ordinal);
    }

    [SkippableTheory]
    [MemberData(nameof(Programs))]
    [Trait("Category", "Soak")]
    public void Program_PrintsWhatItSays(string program)
    {
        var text = File.ReadAllLines(Repository.Full("samples/" + program));
        var draws = text[0].Contains("Render", StringComparison.Ordinal);
        Skip.If(draws && OperatingSystem.IsLinux() && Environment.GetEnvironmentVariable("DISPLAY") is null, "no display to draw on");
        // Its own files stay in a folder of their own; the assets are where it looks for them.
        Directory.CreateSymbolicLink(_folder["assets"], Repository.Full("assets"));
        var start = new ProcessStartInfo("dotnet", ["run", Repository.Full("samples/" + program)])
        {
            WorkingDirectory = _folder.Path,
            RedirectStandardOutput = true,
            RedirectStandardError = true,
        };
        using var process = Process.Start(start)!;
        var output = process.StandardOutput.ReadToEndAsync();
        var error = process.StandardError.ReadToEndAsync();
        if (!process.WaitForExit(Patience))
        {
            process.Kill(entireProcessTree: true);
            Assert.Fail($"{program} did not end within {Patience}");
        }

        Assert.Equal((0, ""), (process.ExitCode, error.GetAwaiter().GetResult()));
        Assert.Equal(ExpectedOutput(text), output.GetAwaiter().GetResult().TrimEnd().Split('\n').Select(line => line.TrimEnd()));
    }

    private static string[] ExpectedOutput(string[] lines) =>
        [.. lines.SkipWhile(line => line != OutputHeading).Skip(1).Select(line => line.Length > 3 ? line[3..].TrimEnd() : "")];
}
