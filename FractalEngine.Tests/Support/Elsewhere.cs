namespace FractalEngine.Tests.Support;

/// <summary>
/// Skips tests of what a machine can't have, whatever is installed on it: another operating system, or rights that the user has not.
/// <c>test.sh</c> lets these skip and no others, by the beginning of their reason.
/// </summary>
internal static class Elsewhere
{
    /// <summary>How the reason of such a skip begins, which <c>eng/setup.sh</c> knows too.</summary>
    public const string Prefix = "not meant for this system: ";

    /// <summary>Skips the test on Windows.</summary>
    /// <param name="reason">What is different there.</param>
    public static void SkipOnWindows(string reason) => SkipIf(OperatingSystem.IsWindows(), reason);

    /// <summary>Skips the test where it is not meant for the machine.</summary>
    /// <param name="condition">Whether that is so.</param>
    /// <param name="reason">What is different there.</param>
    public static void SkipIf(bool condition, string reason) => Skip.If(condition, Prefix + reason);
}
