using FractalEngine.Parsing.Sdo;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Sdo;

public class SceneParserTimeTests
{
    [Fact]
    public void Parse_OfAHundredThousandObjects_TakesNoQuadraticTime()
    {
        var text = string.Concat(Enumerable.Range(0, 100_000).Select(i => $"o \"a.obj\" (({i}, 0, 0), #, #)\n"));
        // It takes a fraction of a second. The square of the objects would be ten thousand million.
        Assert.Equal(100_000, ProcessorTime.RunWithin(5, () => SceneParser.Parse(new("test.sdo", text)).Scene.Objects.Length));
    }
}
