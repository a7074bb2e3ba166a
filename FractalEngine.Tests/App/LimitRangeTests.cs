using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests which values <c>--limit</c> takes.</summary>
[Collection(ConsoleTests.Name)]
public sealed class LimitRangeTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("image-side=1", 1)]
    [InlineData("image-side=0065536", 65_536)]
    [InlineData("image-side=65536", 65_536)]
    public void Limits_OfAValueInTheRange_ListIt(string limit, int value)
    {
        var (exitCode, output, error) = AppInProcess.Run(_folder.Path, "limits", "--limit", limit);
        Assert.Equal((0, ""), (exitCode, error));
        Assert.Contains(
            FormattableString.Invariant($"\n{"image-side",-22}{value,13}  pixels along a side of an image: "),
            output.ReplaceLineEndings("\n"), StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("image-side=0")]
    [InlineData("image-side=65537")]
    [InlineData("image-side=-1")]
    [InlineData("image-side=+5")]
    [InlineData("image-side= 5")]
    [InlineData("image-side=5.0")]
    [InlineData("image-side=1,000")]
    [InlineData("image-side=5=5")]
    [InlineData("image-side=99999999999999999999")]
    [InlineData("image-side=")]
    public void Limits_OfAnotherValue_NameTheRange(string limit)
    {
        var (exitCode, output, error) = AppInProcess.Run(_folder.Path, "limits", "--limit", limit);
        Assert.Equal(
            (2, "", "error: --limit image-side: expected a whole number from 1 to 65536\n"),
            (exitCode, output, error.ReplaceLineEndings("\n")));
    }

    [Theory]
    [InlineData("5", "error: --limit '5': expected NAME=N, such as depth=1000\n")]
    [InlineData("Image-Side=5", "error: --limit 'Image-Side' is no limit: the command 'limits' lists them\n")]
    [InlineData("=5", "error: --limit '' is no limit: the command 'limits' lists them\n")]
    public void Limits_OfAnotherName_SayWhatIsExpected(string limit, string message)
    {
        var (exitCode, output, error) = AppInProcess.Run(_folder.Path, "limits", "--limit", limit);
        Assert.Equal((2, "", message), (exitCode, output, error.ReplaceLineEndings("\n")));
    }
}
