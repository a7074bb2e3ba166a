using System.Text.RegularExpressions;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>Tests that each step of the tutorial shows its file as it is, and that each file loads without a warning.</summary>
public partial class FirstTreeTests
{
    private const int StepCount = 10;

    public static TheoryData<string> Steps => [.. Directory.GetFiles(Repository.Full("assets/examples"), "tree-*")
        .Select(static file => Path.GetFileName(file)).Order(StringComparer.Ordinal)];

    private static string Page => File.ReadAllText(Repository.Full("docs/first-tree.md"));

    [Fact]
    public void Page_HasTenStepsInOrder() => Assert.Equal(
        Enumerable.Range(1, StepCount), Heading().Matches(Page).Select(static match => int.Parse(match.Groups[1].ValueSpan, null)));

    [Theory]
    [MemberData(nameof(Steps))]
    public void Step_ShowsItsFileAndItsImage(string file)
    {
        var text = File.ReadAllText(Repository.Full($"assets/examples/{file}"));
        Assert.Contains($"`assets/examples/{file}`:\n\n```\n{text}```\n", Page, StringComparison.Ordinal);
        var image = $"images/{Path.GetFileNameWithoutExtension(file)}.png";
        Assert.Contains($"]({image})", Page, StringComparison.Ordinal);
        Assert.True(ImageFile.Load(Repository.Full($"docs/{image}")).Width > 0);
    }

    [Theory]
    [MemberData(nameof(Steps))]
    public void Step_LoadsWithoutAWarning(string file) => Assert.Empty(AssetLoader.Check(Repository.Full($"assets/examples/{file}")));

    [GeneratedRegex(@"^## ([0-9]+)\. ", RegexOptions.Multiline)]
    private static partial Regex Heading();
}
