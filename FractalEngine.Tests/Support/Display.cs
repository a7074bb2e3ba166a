namespace FractalEngine.Tests.Support;

/// <summary>The display that programs under test draw on.</summary>
internal static class Display
{
    /// <summary>Skips the test where there is none.</summary>
    public static void Require() => Skip.If(
        OperatingSystem.IsLinux() && string.IsNullOrEmpty(Environment.GetEnvironmentVariable("DISPLAY")), "no display to draw on");
}
