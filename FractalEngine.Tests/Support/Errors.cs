using FractalEngine.Parsing.Text;

namespace FractalEngine.Tests.Support;

/// <summary>Catches errors of parsers, whose messages have file, line, column, text, the source line and the caret.</summary>
internal static class Errors
{
    public static string MessageOf(Func<object> parse) => Assert.Throws<SourceException>(() => { parse(); }).Message;

    public static SourceException ThrownBy(Func<object> parse) => Assert.Throws<SourceException>(() => { parse(); });

    public static void AssertMessage(string expected, Func<object> parse) =>
        Assert.Equal(expected.ReplaceLineEndings("\n"), MessageOf(parse));
}
