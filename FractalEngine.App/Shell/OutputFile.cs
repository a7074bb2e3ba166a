using FractalEngine.Core.Files;

namespace FractalEngine.App.Shell;

/// <summary>Writes the output of a command whole or not at all, also when a signal ends the command.</summary>
internal static class OutputFile
{
    /// <summary>Creates or replaces a file, see <see cref="AtomicFile.Write"/>.</summary>
    /// <param name="path">Path of the file; <c>-</c> for the standard output.</param>
    /// <param name="write">Writes the contents.</param>
    /// <param name="stop">Ends the work of a window, whose process signals end as always; none for a command, which they end.</param>
    /// <exception cref="IOException">The file can't be written.</exception>
    /// <exception cref="OperationCanceledException">A signal has arrived, or the work was stopped.</exception>
    public static void Write(string path, Action<Stream> write, CancellationToken stop = default) => Poll(poll =>
    {
        if (path == StandardInput.Name)
        {
            using var output = new BufferedStream(StandardStreams.OpenOutput());
            write(new InterruptibleStream(output, poll));
            return;
        }

        AtomicFile.Write(path, stream => write(new InterruptibleStream(stream, poll)));
    }, stop);

    /// <summary>Creates or replaces two files that belong together, both or neither, see <see cref="AtomicFile.WritePair"/>.</summary>
    /// <param name="companion">Path of the file that the other one refers to.</param>
    /// <param name="writeCompanion">Writes its contents.</param>
    /// <param name="path">Path of the other file.</param>
    /// <param name="write">Writes its contents.</param>
    /// <param name="stop">As for <see cref="Write"/>.</param>
    /// <exception cref="IOException">A file can't be written.</exception>
    /// <exception cref="OperationCanceledException">A signal has arrived, or the work was stopped.</exception>
    public static void WritePair(
        string companion, Action<Stream> writeCompanion, string path, Action<Stream> write, CancellationToken stop = default) =>
        Poll(poll => AtomicFile.WritePair(
            companion, stream => writeCompanion(new InterruptibleStream(stream, poll)),
            path, stream => write(new InterruptibleStream(stream, poll))), stop);

    private static void Poll(Action<Action> write, CancellationToken stop)
    {
        if (stop.CanBeCanceled)
        {
            write(stop.ThrowIfCancellationRequested);
            return;
        }

        using var interruption = new InterruptSignal();
        write(interruption.ThrowIfRequested);
    }
}
