namespace FractalEngine.Tests.Support;

/// <summary>What a run of the program left behind.</summary>
internal sealed record AppResult(int ExitCode, string Output, string Error);
