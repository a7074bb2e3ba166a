using FractalEngine.Parsing.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Scenes;

[Collection(TimedTests.Name)]
public class SceneParserTimeTests
{
    [Fact]
    public void Parse_OfAHundredThousandObjects_TakesNoLongerThanTwoSeconds()
    {
        var text = string.Concat(Enumerable.Range(0, 100_000).Select(i => $"o \"a.obj\" (({i}, 0, 0), #, #)\n"));
        var start = System.Diagnostics.Stopwatch.StartNew();
        Assert.Equal(100_000, SceneParser.Parse(new("test.sdo", text)).Scene.Objects.Length);
        Assert.True(start.ElapsedMilliseconds < 2000, $"{start.ElapsedMilliseconds} ms");
    }
}
