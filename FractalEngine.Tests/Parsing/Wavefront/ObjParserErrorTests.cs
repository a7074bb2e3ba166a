using System.Text;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Wavefront;

/// <summary>Whole messages: these tests are the specification of what a user reads.</summary>
public class ObjParserErrorTests
{
    private const string Triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

    [Theory]
    [InlineData("")]
    [InlineData("\n\n")]
    public void File_WithoutAnything_SaysSo(string text) => Errors.AssertMessage(
        "test.obj:1:1: error: the file declares nothing: it has no vertex, face, group or material", () => Samples.ParseObj(text));

    [Fact]
    public void File_OfComments_SaysSo() => Assert.StartsWith(
        "test.obj:1:1: error: the file declares nothing", Errors.MessageOf(() => Samples.ParseObj("# Blender\n")),
        StringComparison.Ordinal);

    [Theory]
    [InlineData("f 1 2 0", 7, "vertex number 0: numbers start at 1")]
    [InlineData("f 1 2 4", 7, "vertex 4 of 3 so far: it is beyond the last")]
    [InlineData("f 1 -4 2", 5, "vertex -4 of 3 so far: it is before the first")]
    [InlineData("f 1 2 -0", 7, "vertex number 0: numbers start at 1")]
    [InlineData("f 1 2 x", 7, "unexpected 'x', expected a vertex number")]
    [InlineData("f 1 2 3/x", 9, "unexpected 'x', expected a texture coordinate number")]
    [InlineData("f 1 9", 5, "vertex 9 of 3 so far: it is beyond the last")]
    [InlineData("f 1/ /", 6, "unexpected '/', expected a vertex number")]
    [InlineData("v 1 2 3 nano", 9, "unexpected 'nano', expected the end of the line")]
    [InlineData("f 1 2 1.5", 8, "unexpected '.', expected a blank")]
    [InlineData("v 1 2 nan", 7, "unexpected 'nan', expected a number")]
    [InlineData("v 1 2 1e400", 7, "the number 1e400 is beyond the range of a double")]
    [InlineData("v 1 2 -1e400", 7, "the number -1e400 is beyond the range of a double")]
    [InlineData("v 1 2", 6, "unexpected end of line: a vector has three numbers, and this one has two")]
    public void Line_ThatIsWrong_PointsAtTheFault(string line, int column, string message) => Errors.AssertMessage(
        $"test.obj:4:{column}: error: {message}\n  {line}\n  {new string(' ', column - 1)}^",
        () => Samples.ParseObj($"{Triangle}{line}\nv 9 9 9\n"));

    [Theory]
    [InlineData("f x", 3)]
    [InlineData("f 1/2/3/4 2 3", 8)]
    [InlineData("v 1 x 3", 5)]
    [InlineData("v 1,5 2,5 3,5", 4)]
    [InlineData("vt x", 4)]
    [InlineData("vn 1 2", 7)]
    [InlineData("f 99999999999999999999 1 2", 3)]
    [InlineData("f -99999999999999999999 1 2", 3)]
    [InlineData("f 1 2 3,4", 8)]
    [InlineData("123 4", 1)]
    [InlineData("$ x", 1)]
    public void Line_WithSomethingUnexpected_PointsAtIt(string line, int column)
    {
        var error = Errors.ThrownBy(() => Samples.ParseObj(Triangle + line + "\n")).Diagnostic;
        Assert.Equal((4, column), (error.Line, error.Column));
    }

    [Fact]
    public void Polygon_BeyondTheLimit_NamesIt()
    {
        var error = Errors.ThrownBy(() => Samples.ParseObj(Triangle + "f " + new StringBuilder().Insert(0, "1 2 3 ", 7000))).Diagnostic;
        Assert.True(error.IsLimitExceeded);
        Assert.Contains($"{ParsingLimits.PolygonCorners.Value}", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Line_OfAMegabyte_GivesAShortMessage() =>
        Assert.True(Errors.MessageOf(() => Samples.ParseObj(new string('?', 1_000_000))).Length < 500);

    [Fact]
    public void Parse_OfAnyText_EndsInAMeshOrOneProperError()
    {
        var parsedCount = 0;
        Seeded.Run(3000, random =>
        {
            var text = new StringBuilder("mtllib m\nv 0 0 0\nv 1 0 0 1\nv 1 1 0 # c\nv 0 1 0\nvt 0 1\nvn 0 0 1\n"
                + "o x\ns 1\nf 1/1/1 2//1 3/1 \\\n -1\nf 1 2 3\ncurv 1\n");
            for (var change = random.Next(1, 6); change > 0; change--)
            {
                const string characters = "\0\t\n\r \"#,-.0123456789/\\flnopstv§\uD83D";
                var offset = random.Next(text.Length);
                _ = random.Next(2) switch
                {
                    0 => text.Remove(offset, Math.Min(random.Next(1, 10), text.Length - offset)),
                    _ => text.Insert(offset, characters[random.Next(characters.Length)]),
                };
            }

            try
            {
                Assert.True(Samples.ParseObj(text.ToString()).Mesh.Bounds is { IsEmpty: true } or { Diagonal: < double.PositiveInfinity });
                parsedCount++;
            }
            catch (SourceException error)
            {
                Assert.Matches(@"^test\.obj:[1-9]\d*:[1-9]\d*: error: \S", error.Message);
            }
        });
        // Both happen, so that neither check is empty.
        Assert.InRange(parsedCount, 100, 2900);
    }
}
