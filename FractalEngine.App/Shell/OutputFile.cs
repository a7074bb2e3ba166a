using FractalEngine.Core.Files;

namespace FractalEngine.App.Shell;

/// <summary>Writes the output of a command whole or not at all, also when a signal ends the command.</summary>
internal static class OutputFile
{
    /// <summary>Creates or replaces a file, see <see cref="AtomicFile.Write"/>.</summary>
    /// <param name="path">Path of the file; <c>-</c> for the standard output.</param>
    /// <param name="write">Writes the contents.</param>
    /// <exception cref="IOException">The file can't be written.</exception>
    /// <exception cref="OperationCanceledException">A signal has arrived.</exception>
    public static void Write(string path, Action<Stream> write)
    {
        using var interruption = new InterruptSignal();
        if (path == StandardInput.Name)
        {
            using var output = new BufferedStream(StandardStreams.OpenOutput());
            write(new InterruptibleStream(output, interruption));
            return;
        }

        AtomicFile.Write(path, stream => write(new InterruptibleStream(stream, interruption)));
    }

    /// <summary>Creates or replaces two files that belong together, both or neither, see <see cref="AtomicFile.WritePair"/>.</summary>
    /// <param name="companion">Path of the file that the other one refers to.</param>
    /// <param name="writeCompanion">Writes its contents.</param>
    /// <param name="path">Path of the other file.</param>
    /// <param name="write">Writes its contents.</param>
    /// <exception cref="IOException">A file can't be written.</exception>
    /// <exception cref="OperationCanceledException">A signal has arrived.</exception>
    public static void WritePair(string companion, Action<Stream> writeCompanion, string path, Action<Stream> write)
    {
        using var interruption = new InterruptSignal();
        AtomicFile.WritePair(
            companion, stream => writeCompanion(new InterruptibleStream(stream, interruption)),
            path, stream => write(new InterruptibleStream(stream, interruption)));
    }
}
