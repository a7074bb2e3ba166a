using System.Globalization;
using System.Text.RegularExpressions;
using FractalEngine.Benchmarks.Approximation;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Approximation;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>Tests that docs/approximate.md states what is found for its models.</summary>
public sealed class ApproximatePageTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("tree", "fractals", 5)]
    public void Table_HasWhatIsFound(string model, string folder, int? depth)
    {
        var path = Repository.Full($"assets/{folder}/{model}.fdo");
        Check(model, FractalFile.Read(path, new LoadOptions { Depth = depth }).Flatten(200_000));
    }

    [Theory]
    [InlineData("romanesco", "fractals", 2)]
    [InlineData("snowflake", "fractals", 3)]
    [InlineData("menger-3", "fractals", null)]
    [InlineData("arch", "classics", null)]
    [Trait("Category", "Soak")]
    public void Table_OfOtherAssets_HasWhatIsFound(string model, string folder, int? depth) => Table_HasWhatIsFound(model, folder, depth);

    [Fact]
    [Trait("Category", "Soak")]
    public void Table_OfSamples_HasWhatIsFound()
    {
        SampleModels.Write(_folder.Path);
        string[] models = ["spiral-stairs", "temple", "ruined-tree", "strange-tree", "creature"];
        Assert.All(models, model => Check(model, MeshFile.Read(_folder[$"{model}.obj"])));
    }

    private static void Check(string model, Mesh mesh)
    {
        var row = File.ReadLines(Repository.Full("docs/approximate.md"))
            .Single(line => Regex.IsMatch(line, $@"^\| {model} \| [\d,]+ \| [\d,]+ \| \d+ \|")).Split(" | ");
        var found = MeshApproximator.Find(mesh);
        Assert.Equal(
            [Format(mesh.FaceCount), Format(found.Grammar.FaceCount), Format(found.Grammar.MapCount)], row[1..4]);
        Assert.Equal([Format(found.Bytes), found.Verdict.ToString().ToUpperInvariant() + " |"], row[5..]);

        static string Format(long number) => number.ToString("N0", CultureInfo.InvariantCulture);
    }
}
