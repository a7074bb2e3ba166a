using System.Globalization;
using FractalEngine.App.Shell;
using FractalEngine.Core.Geometry;

namespace FractalEngine.App.Jobs;

/// <summary>Section planes as text: the normal and the offset, <c>NX,NY,NZ,D</c>.</summary>
internal static class SectionText
{
    private const int NumberCount = 4;

    /// <summary>Parses the plane of all points with x·NX + y·NY + z·NZ = D. Commas, blanks or both separate the numbers.</summary>
    /// <exception cref="UsageException">The text has not four finite numbers, or the normal is 0.</exception>
    public static SectionPlane Parse(string option, string text)
    {
        var words = text.Split([',', ' '], StringSplitOptions.RemoveEmptyEntries);
        var numbers = new double[words.Length];
        for (var i = 0; i < words.Length; i++)
        {
            if (!double.TryParse(words[i], NumberStyles.Float, CultureInfo.InvariantCulture, out numbers[i])
                || !double.IsFinite(numbers[i]))
            {
                throw new UsageException($"{option}: '{words[i]}' is no number; expected NX,NY,NZ,D");
            }
        }

        if (numbers.Length != NumberCount)
        {
            throw new UsageException(FormattableString.Invariant($"{option}: expected four numbers NX,NY,NZ,D, got {numbers.Length}"));
        }

        try
        {
            return SectionPlane.Of(new(numbers[0], numbers[1], numbers[2]), numbers[3]);
        }
        catch (ArgumentException)
        {
            throw new UsageException($"{option}: the normal of the plane must be neither 0 nor beyond the range of numbers");
        }
    }
}
