namespace FractalEngine.App;

/// <summary>The name by which the program was called, for help and messages.</summary>
internal static class ProgramName
{
    /// <summary>The name that help shows unless a script has called the program.</summary>
    public const string Default = "fractal-engine";

    // Set by run.sh to the path by which the script itself was called.
    private const string Variable = "FRACTALENGINE_PROGRAM";

    /// <summary>The script that called the program, or the program's own name.</summary>
    public static string Current => Environment.GetEnvironmentVariable(Variable) is { Length: > 0 } script ? script : Default;
}
