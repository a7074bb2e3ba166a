namespace FractalEngine.App;

/// <summary>What the program's exit status says.</summary>
internal static class ExitCode
{
    /// <summary>Done.</summary>
    public const int Done = 0;

    /// <summary>The input can't be loaded.</summary>
    public const int BadInput = 1;

    /// <summary>The command line makes no sense, or names an output that can't be written.</summary>
    public const int WrongUsage = 2;

    /// <summary>The input is well-formed, but beyond a stated limit.</summary>
    public const int OverLimit = 3;

    /// <summary>There is no display, or no OpenGL on it.</summary>
    public const int NoGraphics = 4;

    /// <summary>The program itself is at fault, as sysexits.h counts it (EX_SOFTWARE).</summary>
    public const int Internal = 70;

    /// <summary>Ended from outside, as shells count it: 128 and the number of the signal of Ctrl+C.</summary>
    public const int Interrupted = 130;
}
