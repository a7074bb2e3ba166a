using FractalEngine.App.Window.Panels;

namespace FractalEngine.Tests.App.Window.Panels;

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
        Assert.Equal(comment, FractalComments.Above(Text, Text.IndexOf(number, StringComparison.Ordinal)));
}
