using System.Text.RegularExpressions;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>The files that docs/coming-from.md shows whole.</summary>
public class ComingFromPageTests
{
    private static readonly string[] Files =
    [
        .. Regex.Matches(File.ReadAllText(Repository.Full("docs/coming-from.md")).Replace("\r", "", StringComparison.Ordinal),
            "```fdo\n(.*?)```", RegexOptions.Singleline).Select(static match => match.Groups[1].Value),
    ];

    [Theory]
    [InlineData(0, 200)]
    [InlineData(1, 4096)]
    [InlineData(2, 1023)]
    [InlineData(3, 28_561)]
    [InlineData(4, 331_776)]
    [InlineData(5, 2047)]
    [InlineData(6, 64 * (6 + 1 + 16))]
    public void File_HasItsInstances(int index, int count)
    {
        Assert.Equal(7, Files.Length);
        var parsed = FractalParser.Parse(new("page.fdo", Files[index]));
        var meshes = parsed.Bases.Select(static one => BaseShapes.TryFind(one.File, out var mesh) ? mesh : Mesh.Empty);
        Assert.Equal(count, DistinctInstances.Count(new(parsed.Description, [.. meshes])));
    }
}
