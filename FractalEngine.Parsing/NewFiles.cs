using FractalEngine.Core.Files;

namespace FractalEngine.Parsing;

/// <summary>
/// Files that are written beside another one. Those that were created are deleted again unless <see cref="Keep"/> is called.
/// </summary>
internal sealed class NewFiles : IDisposable
{
    private readonly List<string> _created = [];

    /// <summary>Writes a file without replacing a different one, see <see cref="AtomicFile.WriteWithoutReplacing"/>.</summary>
    /// <param name="path">Full path of the file; another name is chosen if it is taken.</param>
    /// <param name="write">Writes the contents.</param>
    /// <returns>Full path of the file that has these contents.</returns>
    /// <exception cref="IOException">The file can't be written.</exception>
    public string Write(string path, Action<Stream> write)
    {
        var result = AtomicFile.WriteWithoutReplacing(path, write, out var isCreated);
        if (isCreated)
        {
            _created.Add(result);
        }

        return result;
    }

    /// <summary>Keeps all files that were written so far.</summary>
    public void Keep() => _created.Clear();

    /// <summary>Deletes the files that were created and not kept.</summary>
    public void Dispose() => _created.ForEach(File.Delete);
}
