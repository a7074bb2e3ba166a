using System.Globalization;

namespace FractalEngine.Tests.Support;

/// <summary>Counts of long runs, which environment variables make longer or repeat from another seed.</summary>
internal static class LongRuns
{
    /// <summary>Reads a number from an environment variable.</summary>
    /// <param name="variable">Name of the variable.</param>
    /// <param name="otherwise">The number where it is not set.</param>
    public static int NumberOf(string variable, int otherwise) =>
        Environment.GetEnvironmentVariable(variable) is { } text ? int.Parse(text, CultureInfo.InvariantCulture) : otherwise;
}
