using FractalEngine.Parsing.Fdo;

namespace FractalEngine.Tests.Parsing.Fdo;

/// <summary>Tests what the panel of a fractal tells about its numbers.</summary>
public class FractalCommentsTests
{
    private const string Text =
        "v 9 9 9\n# the trunk\n# goes on\nv 1 0 0\nv 2 0 0\n\n#shapes\nv 3 0 0\nt.a. (a, #, 4)\nx. \"a.obj\"\n## depth\n<$>. z 5\n";

    [Theory]
    [InlineData("9 9 9", null)]
    [InlineData("1 0 0", "the trunk goes on")]
    [InlineData("2 0 0", "the trunk goes on")]
    [InlineData("3 0 0", "shapes")]
    [InlineData("4)", null)]
    [InlineData("5", "depth")]
    public void Above_OfANumber_IsTheCommentOfItsGroup(string number, string? comment) =>
        Assert.Equal(comment, Assert.Single(FractalComments.Above(Text, [Text.IndexOf(number, StringComparison.Ordinal)])));

    [Theory]
    [InlineData(1, "where the leader goes on")]
    [InlineData(2, "where branches leave")]
    [InlineData(3, "where branches leave")]
    [InlineData(4, "where branches leave")]
    [InlineData(5, "as thick as 0.5 of the first")]
    [InlineData(6, "thinner: by half")]
    [InlineData(7, null)]
    [InlineData(8, "thinner: by half")]
    [InlineData(9, null)]
    public void About_AVector_IsWhatTheCommentSaysOfIt(int vector, string? words) => Assert.Equal(
        words,
        FractalComments.About(
            "All: 1: where the leader goes on. 2 to 4: where branches leave. 5: as thick as 0.5 of the first. 6 and 8: thinner: by half.",
            vector));

    [Fact]
    public void About_WithoutNumbers_IsNothing() => Assert.Null(FractalComments.About("kept: three cubes", 1));

    /// <summary>To look through all that stands above each number would take minutes.</summary>
    [Fact]
    public void Above_OfManyNumbers_ReadsTheTextOnce()
    {
        var text = "# all of them\n" + string.Concat(Enumerable.Repeat("v 1 2 3\n", 200_000));
        var start = Environment.CpuUsage.TotalTime;
        var comments = FractalComments.Above(text, Enumerable.Range(0, 200_000).Select(i => 16 + (8 * i)));
        Assert.InRange((Environment.CpuUsage.TotalTime - start).TotalSeconds, 0, 2);
        Assert.All(comments, static comment => Assert.Equal("all of them", comment));
    }
}
