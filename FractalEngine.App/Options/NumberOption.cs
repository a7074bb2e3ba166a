using System.CommandLine;
using System.Globalization;
using System.Numerics;

namespace FractalEngine.App.Options;

/// <summary>Creates options whose value is one number. Numbers are written with a decimal point in every culture.</summary>
internal static class NumberOption
{
    /// <summary>Creates an option for a whole number in a closed range.</summary>
    /// <typeparam name="T">The type that holds the number.</typeparam>
    /// <param name="name">The name with its dashes.</param>
    /// <param name="helpName">The placeholder of the value in the help text.</param>
    /// <param name="min">The smallest valid value.</param>
    /// <param name="max">The largest valid value.</param>
    /// <param name="description">The sentence in the help text.</param>
    public static Option<T?> Integer<T>(string name, string helpName, T min, T max, string description)
        where T : struct, IBinaryInteger<T> => Create<T>(
            name, helpName, description, NumberStyles.AllowLeadingSign, number => number >= min && number <= max,
            string.Create(CultureInfo.InvariantCulture, $"a whole number from {min} to {max}"));

    /// <summary>Creates an option for a whole number in a closed range, which the option may go without.</summary>
    /// <param name="name">The name with its dashes.</param>
    /// <param name="helpName">The placeholder of the value in the help text.</param>
    /// <param name="min">The smallest valid value.</param>
    /// <param name="max">The largest valid value.</param>
    /// <param name="fallback">The value where the option has no number.</param>
    /// <param name="description">The sentence in the help text.</param>
    public static Option<int?> OptionalInteger(string name, string helpName, int min, int max, int fallback, string description)
    {
        var option = Integer<int>(name, helpName, min, max, description);
        var parse = option.CustomParser!;
        option.Arity = ArgumentArity.ZeroOrOne;
        option.CustomParser = result => result.Tokens.Count == 0 ? fallback : parse(result);
        return option;
    }

    /// <summary>Creates an option for a decimal number in a closed range.</summary>
    /// <inheritdoc cref="Integer{T}"/>
    public static Option<double?> Decimal(string name, string helpName, double min, double max, string description) => Create<double>(
        name, helpName, description, NumberStyles.Float, number => number >= min && number <= max,
        string.Create(CultureInfo.InvariantCulture, $"a number from {min} to {max}"));

    /// <summary>Creates an option for a finite decimal number above 0.</summary>
    /// <param name="name">The name with its dashes.</param>
    /// <param name="helpName">The placeholder of the value in the help text.</param>
    /// <param name="description">The sentence in the help text.</param>
    /// <param name="unit">A unit that may stand behind the number; empty for none.</param>
    public static Option<double?> Positive(string name, string helpName, string description, string unit = "") => Create<double>(
        name, helpName, description, NumberStyles.Float, static number => number > 0 && double.IsFinite(number), "a number above 0", unit);

    /// <summary>Creates an option for a finite decimal number of at least 0.</summary>
    public static Option<double?> NonNegative(string name, string helpName, string description) => Create<double>(
        name, helpName, description, NumberStyles.Float, static number => number >= 0 && double.IsFinite(number),
        "a number that is not negative");

    private static Option<T?> Create<T>(
        string name, string helpName, string description, NumberStyles styles, Func<T, bool> isValid, string expected, string unit = "")
        where T : struct, INumberBase<T> => new(name)
        {
            Description = description,
            HelpName = helpName,
            CustomParser = result =>
            {
                if (result.Tokens is [{ Value: var token }]
                    && T.TryParse(
                        token.EndsWith(unit, StringComparison.Ordinal) ? token.AsSpan(0, token.Length - unit.Length) : token, styles,
                        CultureInfo.InvariantCulture, out var number) && isValid(number))
                {
                    return number;
                }

                result.AddError($"{name}: expected {expected}");
                return null;
            },
        };
}
