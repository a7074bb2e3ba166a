using FractalEngine.Parsing.Simulation;

namespace FractalEngine.Tests.Parsing.Simulation;

/// <summary>Tests the quoting of body names in comma-separated values.</summary>
public class BodyCsvWriterTests
{
    [Theory]
    [InlineData("ball", "ball")]
    [InlineData("", "")]
    [InlineData("#3", "#3")]
    [InlineData(" a b ", " a b ")]
    [InlineData("red, large", "\"red, large\"")]
    [InlineData("the \"big\" one", "\"the \"\"big\"\" one\"")]
    [InlineData("two\nlines", "\"two\nlines\"")]
    [InlineData("two\rlines", "\"two\rlines\"")]
    public void Quote_OfAnyText_IsOnlyUsedWhereNeeded(string text, string expected) => Assert.Equal(expected, BodyCsvWriter.Quote(text));
}
