using System.Globalization;

namespace FractalEngine.Tests.Stability;

/// <summary>Numbers like 1, 2, 5, 10, 20, 50, at which curves over many orders of magnitude are measured.</summary>
internal static class RoundNumbers
{
    public static IEnumerable<int> To(int last) =>
        from ten in Enumerable.Range(0, 10)
        from digit in (int[])[1, 2, 5]
        let number = digit * Math.Pow(10, ten)
        where number <= last
        select (int)number;

    /// <summary>Returns the double next to a power of ten.</summary>
    public static double PowerOfTen(int exponent) =>
        double.Parse(string.Create(CultureInfo.InvariantCulture, $"1e{exponent}"), CultureInfo.InvariantCulture);

    /// <summary>Returns the first round number that is not smaller.</summary>
    /// <param name="number">A number from 1 to 10⁹.</param>
    public static int From(long number)
    {
        var ten = 1;
        while (5 * (long)ten < number)
        {
            ten *= 10;
        }

        return number <= ten ? ten : number <= 2 * (long)ten ? 2 * ten : 5 * ten;
    }
}
