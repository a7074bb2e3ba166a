using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Points;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Tests.Parsing.Points;

public class RaysParserTests
{
    [Fact]
    public void Parse_OfBlanksCommasAndComments_GivesOneRayALine() => Assert.Equal(
        [new Ray(new(1, 2, 3), new(0, 0, 1)), new Ray(new(-1e-3, 0.5, 4), new(0, -2, 0))],
        Parse("# origin, direction\n\n1 2 3 0 0 1\n  -1e-3, 0.5,4, 0 -2 0 # a comment\r\n"));

    [Theory]
    [InlineData("")]
    [InlineData("# nothing\n")]
    public void Parse_OfNoRays_IsEmpty(string text) => Assert.Empty(Parse(text));

    [Theory]
    [InlineData("1 2 3 0 0\n", 1, 10, "number")]
    [InlineData("0 0 0 0 0 1\n1 2 3 0 0 1 7\n", 2, 13, "unexpected '7'")]
    [InlineData("1 2 3 0 0 0\n", 1, 7, "a direction of length 0")]
    [InlineData("1 2 x 0 0 1\n", 1, 5, "number")]
    [InlineData("1 2 3 0 0 nan\n", 1, 11, "number")]
    [InlineData("1e301 2 3 0 0 1\n", 1, 1, "beyond the limit of 1E+75")]
    [InlineData("1 2 3 0 1e301 1\n", 1, 7, "beyond the limit of 1E+150")]
    public void Parse_OfAWrongLine_NamesItsPlace(string text, int line, int column, string message)
    {
        var exception = Assert.Throws<SourceException>(() => Parse(text));
        Assert.Equal((line, column), (exception.Diagnostic.Line, exception.Diagnostic.Column));
        Assert.Contains(message, exception.Message, StringComparison.Ordinal);
    }

    private static Ray[] Parse(string text) => [.. RaysParser.Parse(new SourceText("rays.txt", text))];
}
