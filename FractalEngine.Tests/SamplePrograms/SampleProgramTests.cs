using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.SamplePrograms;

/// <summary>Tests that the programs in samples/ are short, say what they print, print just that, and are what the README shows.</summary>
public sealed class SampleProgramTests : IDisposable
{
    private const int MaxLines = 40;
    private readonly TemporaryFolder _folder = new();

    public static TheoryData<string> Programs => [.. SampleProgram.Names];

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Programs_AreOneForEachUse() => Assert.True(Programs.Count >= 7, $"only {Programs.Count} programs");

    [Theory]
    [MemberData(nameof(Programs))]
    public void Program_IsShortAndSaysWhatItPrints(string program)
    {
        var sample = new SampleProgram(program);
        var lines = sample.Lines;
        Assert.InRange(lines.Length, 10, MaxLines);
        Assert.StartsWith("#:project ../FractalEngine.", lines[0], StringComparison.Ordinal);
        Assert.Contains("#:property PublishAot=false", lines);
        Assert.NotEmpty(sample.ExpectedOutput);
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
        var sample = new SampleProgram(program);
        var draws = sample.Lines[0].Contains("Render", StringComparison.Ordinal);
        if (draws)
        {
            Display.Require();
        }

        // Its own files stay in a folder of their own; the assets are where it looks for them.
        Directory.CreateSymbolicLink(_folder["assets"], Repository.Full("assets"));
        var (exitCode, output, error) = Dotnet.Run(_folder.Path, null, "run", sample.File);
        Assert.Equal((0, ""), (exitCode, error));
        Assert.Equal(sample.ExpectedOutput, SampleProgram.SplitOutput(output));
    }
}
