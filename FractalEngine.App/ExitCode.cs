namespace FractalEngine.App;

/// <summary>The exit codes of the program.</summary>
internal static class ExitCode
{
    /// <summary>The command has succeeded.</summary>
    public const int Done = 0;

    /// <summary>The input can't be loaded.</summary>
    public const int BadInput = 1;

    /// <summary>The command line is invalid, or names an output that can't be written.</summary>
    public const int WrongUsage = 2;

    /// <summary>The input is well-formed, but exceeds a documented limit.</summary>
    public const int OverLimit = 3;

    /// <summary>There is no display, or no OpenGL on the display.</summary>
    public const int NoGraphics = 4;

    /// <summary>The program itself has failed (EX_SOFTWARE of sysexits.h).</summary>
    public const int Internal = 70;

    /// <summary>A signal has ended the program, which shells report as 128 plus the signal number; SIGINT is 2.</summary>
    public const int Interrupted = 130;
}
