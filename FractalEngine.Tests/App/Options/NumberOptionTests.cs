using System.CommandLine;
using System.Globalization;
using FractalEngine.App.Options;

namespace FractalEngine.Tests.App.Options;

/// <summary>Tests which numbers the options of the command line take, and what they say of others.</summary>
public sealed class NumberOptionTests
{
    [Theory]
    [InlineData("", "none")]
    [InlineData("--n 1", "1")]
    [InlineData("--n +7", "7")]
    [InlineData("--n 10", "10")]
    [InlineData("--n 0", "--n: expected a whole number from 1 to 10")]
    [InlineData("--n 11", "--n: expected a whole number from 1 to 10")]
    [InlineData("--n 1.5", "--n: expected a whole number from 1 to 10")]
    [InlineData("--n 1e1", "--n: expected a whole number from 1 to 10")]
    public void Integer_OfAText_IsANumberInItsRange(string arguments, string outcome) =>
        Assert.Equal(outcome, Outcome(NumberOption.Integer("--n", "N", 1, 10, "A number."), arguments));

    [Theory]
    [InlineData("", "none")]
    [InlineData("--n", "7")]
    [InlineData("--n 1", "1")]
    [InlineData("--n 10", "10")]
    [InlineData("--n 11", "--n: expected a whole number from 1 to 10")]
    [InlineData("--n x", "--n: expected a whole number from 1 to 10")]
    public void OptionalInteger_WithoutANumber_IsItsOwn(string arguments, string outcome) =>
        Assert.Equal(outcome, Outcome(NumberOption.OptionalInteger("--n", "N", 1, 10, 7, "A number."), arguments));

    [Theory]
    [InlineData("", "none")]
    [InlineData("--n 0.5", "0.5")]
    [InlineData("--n 25e-1", "2.5")]
    [InlineData("--n 0.49", "--n: expected a number from 0.5 to 2.5")]
    [InlineData("--n 2.51", "--n: expected a number from 0.5 to 2.5")]
    [InlineData("--n NaN", "--n: expected a number from 0.5 to 2.5")]
    [InlineData("--n 1,5", "--n: expected a number from 0.5 to 2.5")]
    public void Decimal_OfAText_IsANumberInItsRange(string arguments, string outcome) =>
        Assert.Equal(outcome, Outcome(NumberOption.Decimal("--n", "N", 0.5, 2.5, "A number."), arguments));

    [Theory]
    [InlineData("--n 1e-300", "1E-300")]
    [InlineData("--n 1e308", "1E+308")]
    [InlineData("--n 0", "--n: expected a number above 0")]
    [InlineData("--n 1e999", "--n: expected a number above 0")]
    [InlineData("--n NaN", "--n: expected a number above 0")]
    public void Positive_OfAText_IsAFiniteNumberAboveZero(string arguments, string outcome) =>
        Assert.Equal(outcome, Outcome(NumberOption.Positive("--n", "N", "A number."), arguments));

    [Theory]
    [InlineData("--n 0", "0")]
    [InlineData("--n 1e308", "1E+308")]
    [InlineData("--n 1e999", "--n: expected a number that is not negative")]
    [InlineData("--n NaN", "--n: expected a number that is not negative")]
    public void NonNegative_OfAText_IsAFiniteNumberFromZero(string arguments, string outcome) =>
        Assert.Equal(outcome, Outcome(NumberOption.NonNegative("--n", "N", "A number."), arguments));

    [Theory]
    [InlineData("", "none")]
    [InlineData("--w one", "1")]
    [InlineData("--w two", "2")]
    [InlineData("--w One", "--w: expected one of one, two, not 'One'")]
    public void Word_OfAText_IsOneOfTheList(string arguments, string outcome) =>
        Assert.Equal(outcome, Outcome(WordOption.Single("--w", "A word.", ("one", 1), ("two", 2)), arguments));

    private static string Outcome<T>(Option<T?> option, string arguments)
        where T : struct, IFormattable
    {
        var command = new Command("test") { option };
        var result = command.Parse(arguments);
        return result.Errors.Count > 0
            ? string.Join('|', result.Errors.Select(static error => error.Message).Distinct())
            : result.GetValue(option)?.ToString(null, CultureInfo.InvariantCulture) ?? "none";
    }
}
