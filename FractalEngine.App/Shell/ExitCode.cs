namespace FractalEngine.App.Shell;

/// <summary>The exit codes of the program.</summary>
internal static class ExitCode
{
    /// <summary>The command has succeeded.</summary>
    public const int Done = 0;

    /// <summary>The input can't be loaded, or has no valid meaning.</summary>
    public const int BadInput = 1;

    /// <summary>
    /// The command line is invalid, names an output that can't be written, or names a collider that does not fit the model.
    /// </summary>
    public const int WrongUsage = 2;

    /// <summary>
    /// The input is well-formed, but exceeds a documented limit, what the driver can do, or the machine's memory; or the system lets the
    /// program open too few files.
    /// </summary>
    public const int OverLimit = 3;

    /// <summary>There is no display, or no OpenGL on the display.</summary>
    public const int NoGraphics = 4;

    /// <summary>No fractal was found that makes a mesh.</summary>
    public const int NoFractal = 6;

    /// <summary>The program itself has failed (EX_SOFTWARE of sysexits.h).</summary>
    public const int Internal = 70;

    /// <summary>
    /// SIGINT, SIGTERM or SIGHUP has ended a simulation or the writing of a file. For all it is 128 plus the number of SIGINT, 2, as shells
    /// count.
    /// </summary>
    public const int Interrupted = 130;
}
