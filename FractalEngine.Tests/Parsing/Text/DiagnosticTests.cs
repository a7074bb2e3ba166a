using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Text;

public class DiagnosticTests
{
    [Fact]
    public void ToString_OfAnError_IsOneLineAndTheSourceLine() => Assert.Equal(
        "assets/fractals/tree.fdo:4:12: error: unexpected 'x'\n  t.a.b. (a, x, b)\n             ^",
        new Diagnostic("assets/fractals/tree.fdo", 4, 12, DiagnosticSeverity.Error, "unexpected 'x'", "t.a.b. (a, x, b)").ToString());

    [Fact]
    public void ToString_OfAWarning_SaysSo() => Assert.Equal(
        "a.obj:1:1: warning: skipped", new Diagnostic("a.obj", 1, 1, DiagnosticSeverity.Warning, "skipped").ToString());

    [Fact]
    public void ToString_BehindTheLastCharacter_PointsThere() => Assert.Equal(
        "a:1:4: error: m\n  abc\n     ^", new Diagnostic("a", 1, 4, DiagnosticSeverity.Error, "m", "abc").ToString());

    [Fact]
    public void ToString_OfALineWithTabs_IndentsTheCaretByTheSameTabs() => Assert.Equal(
        "a:1:4: error: m\n  \tv\tx\n  \t \t^", new Diagnostic("a", 1, 4, DiagnosticSeverity.Error, "m", "\tv\tx").ToString());

    [Theory]
    [InlineData(1)]
    [InlineData(99)]
    [InlineData(100)]
    [InlineData(101)]
    [InlineData(5_000)]
    [InlineData(999_999)]
    [InlineData(1_000_000)]
    public void ToString_OfAVeryLongLine_ShowsThePartAroundTheCaret(int column)
    {
        var line = new string('a', column - 1) + "X" + new string('b', 1_000_000 - column);
        var shown = new Diagnostic("f", 1, column, DiagnosticSeverity.Error, "m", line).ToString().Split('\n');
        Assert.All(shown, part => Assert.True(part.Length <= 120, $"{part.Length} characters"));
        Assert.Equal('X', shown[1][shown[2].IndexOf('^', StringComparison.Ordinal)]);
    }

    [Fact]
    public void ToString_OfControlCharacters_DoesNotPassThemOn() =>
        Assert.DoesNotContain('\u001B', new Diagnostic("f", 1, 1, DiagnosticSeverity.Error, "m", "\u001B[2J\u0007").ToString());

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void ToString_InAnyCulture_IsTheSame(string culture) => Assert.Equal(
        "f:12345:6: error: m", InCulture.Run(culture, () => new Diagnostic("f", 12345, 6, DiagnosticSeverity.Error, "m").ToString()));

    [Theory]
    [InlineData(0, 1, 1, "one")]
    [InlineData(2, 1, 3, "one")]
    [InlineData(3, 1, 4, "one")]
    [InlineData(5, 2, 1, "")]
    [InlineData(7, 3, 1, "three")]
    [InlineData(12, 3, 6, "three")]
    public void Diagnose_OfAnOffset_FindsLineAndColumn(int offset, int line, int column, string sourceLine)
    {
        var diagnostic = new SourceText("f", "one\r\n\r\nthree").Diagnose(offset, "m");
        Assert.Equal((line, column, sourceLine), (diagnostic.Line, diagnostic.Column, diagnostic.SourceLine ?? ""));
    }

    [Fact]
    public void Diagnose_WithCarriageReturnsAlone_CountsLines()
    {
        var diagnostic = new SourceText("f", "one\rtwo\rthree").Diagnose(9, "m");
        Assert.Equal((3, 2, "three"), (diagnostic.Line, diagnostic.Column, diagnostic.SourceLine));
    }
}
