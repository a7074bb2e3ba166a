namespace FractalEngine.Tests.Support;

/// <summary>Exit code and texts of a run of the program.</summary>
internal sealed record AppResult(int ExitCode, string Output, string Error);
