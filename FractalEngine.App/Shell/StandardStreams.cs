using System.Text;

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
        Console.SetOut(CreateWriter(OpenOutput()));
        Console.SetError(CreateWriter(new StandardStream(Console.OpenStandardError, static _ => { })));
    }

    /// <summary>Writes a line with numbers to the standard error, in the invariant culture.</summary>
    public static void WriteReportLine(FormattableString line) => Console.Error.WriteLine(FormattableString.Invariant(line));

    /// <summary>Opens the standard output.</summary>
    /// <returns>A stream whose errors are an <see cref="IOException"/> that names the standard output.</returns>
    public static Stream OpenOutput() => new StandardStream(Console.OpenStandardOutput, static exception =>
        throw new IOException($"the standard output can't be written: {exception.Message}", exception));

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
