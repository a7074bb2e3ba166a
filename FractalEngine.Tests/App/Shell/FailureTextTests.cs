using System.Runtime.CompilerServices;
using FractalEngine.App.Shell;

namespace FractalEngine.Tests.App.Shell;

/// <summary>Tests what is told of errors that carry more than a message.</summary>
public sealed class FailureTextTests
{
    [Fact]
    public void Of_AFaultyValue_ShowsItBelowTheMessage() => Assert.Equal(
        new Failure(2, "error: --up: unexpected 'x'\n  (x, 0, 0)\n   ^"),
        Failure.Of(new UsageException("--up: unexpected 'x'", "  (x, 0, 0)\n   ^")));

    [Fact]
    public void Of_AnErrorOfTheProgramItself_NamesItsPlaceOnOneLine() => Assert.Equal(
        new Failure(
            70,
            "error: internal error, please report it: "
            + "FormatException: two lines (in FractalEngine.Tests.App.Shell.FailureTextTests.Throw)"),
        Failure.Of(Record.Exception(Throw)!));

    [Fact]
    public void Of_SeveralErrorsAtOnce_IsAnErrorOfTheProgram()
    {
        var failure = Failure.Of(new AggregateException("several", new IOException("one"), new IOException("two")));
        Assert.Equal(70, failure.ExitCode);
        Assert.StartsWith(
            "error: internal error, please report it: AggregateException: several", failure.Text, StringComparison.Ordinal);
    }

    [Fact]
    public void Of_AMessageWithControlCharacters_EscapesThem() => Assert.Equal(
        new Failure(2, "error: a\\u001Bb"), Failure.Of(new IOException("a\u001Bb")));

    [MethodImpl(MethodImplOptions.NoInlining)]
    private static void Throw() => throw new FormatException("two\nlines");
}
