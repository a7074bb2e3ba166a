using System.Text;
using Microsoft.Win32.SafeHandles;

namespace FractalEngine.App.Shell;

/// <summary>
/// The standard output and the standard error of the program: an output that can't be written is an error that names it, and messages
/// that can't be written are lost without changing anything else.
/// </summary>
internal static class StandardStreams
{
    /// <summary>Lets <see cref="Console.Out"/> and <see cref="Console.Error"/> write through these streams.</summary>
    public static void Install()
    {
        Console.SetOut(CreateWriter(OpenOutput(Console.OpenStandardOutput)));
        Console.SetError(CreateWriter(new StandardStream(() => Open(2, Console.OpenStandardError), static _ => { })));
    }

    /// <summary>Writes a line with numbers to the standard error, in the invariant culture.</summary>
    public static void WriteReportLine(FormattableString line) => Console.Error.WriteLine(FormattableString.Invariant(line));

    /// <summary>Opens the standard output for the result of a command. Once nothing reads it any more, writing fails.</summary>
    /// <returns>A stream whose errors are an <see cref="IOException"/> that names the standard output.</returns>
    public static Stream OpenOutput() => OpenOutput(OpenPipeOrConsole);

    /// <summary>
    /// Tells whether the program was started without a stream. The runtime has taken its number for a pipe of its own then: reading that
    /// would wait for ever, and what is written is lost. What a program is started with does not close on exec; all that the runtime
    /// opens does.
    /// </summary>
    /// <param name="number">0 for the standard input, 1 for the standard output, 2 for the standard error.</param>
    public static bool IsClosed(int number)
    {
        const long closeOnExec = 0x80000;
        try
        {
            return HasFlag(number, closeOnExec);
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or FormatException)
        {
            // Only Linux tells. There a number without a file is closed.
            return exception is FileNotFoundException && Directory.Exists("/proc/self/fdinfo");
        }
    }

    private static StandardStream OpenOutput(Func<Stream> open) => new(() => Open(1, open), static exception =>
        throw new IOException($"the standard output can't be written: {exception.Message}", exception));

    /// <summary>
    /// The console's own stream writes into a pipe that nothing reads as if all were well. That of a file does not wait where writing does
    /// not block, and at places of its own: so it is for pipes that block.
    /// </summary>
    private static Stream OpenPipeOrConsole()
    {
        const long nonBlocking = 0x800;
        try
        {
            // The flag first: a number is a handle on Linux alone.
            if (!HasFlag(1, nonBlocking)
                && new FileStream(new SafeFileHandle(1, ownsHandle: false), FileAccess.Write, bufferSize: 0) is { CanSeek: false } pipe)
            {
                return pipe;
            }
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or FormatException)
        {
            // Only Linux tells.
        }

        return Console.OpenStandardOutput();
    }

    /// <summary>Tells whether a stream of the process was opened with a flag. Only Linux tells: errors of reading it are thrown.</summary>
    private static bool HasFlag(int number, long flag)
    {
        var flags = File.ReadLines(FormattableString.Invariant($"/proc/self/fdinfo/{number}"))
            .FirstOrDefault(static line => line.StartsWith("flags:", StringComparison.Ordinal));
        return flags is not null && (Convert.ToInt64(flags["flags:".Length..].Trim(), 8) & flag) != 0;
    }

    private static Stream Open(int number, Func<Stream> open) => IsClosed(number) ? throw new IOException("it is closed") : open();

    // The encoding of the console. That of UTF-8 would put a mark before the first message.
    private static StreamWriter CreateWriter(Stream stream)
    {
        var encoding = Console.OutputEncoding;
        if (encoding.CodePage == Encoding.UTF8.CodePage)
        {
            encoding = new UTF8Encoding(encoderShouldEmitUTF8Identifier: false);
        }

        return new(stream, encoding) { AutoFlush = true };
    }
}
