using System.Text;
using FractalEngine.Core.Files;
using FractalEngine.Parsing.Fractals;

namespace FractalEngine.App.Window;

/// <summary>Writes fractals to begin with. No other file is ever replaced.</summary>
internal static class NewFractalFile
{
    private const string Extension = ".fdo";

    /// <summary>Returns a name for a fractal in a folder that no other file has.</summary>
    /// <param name="template">What the fractal begins with.</param>
    /// <param name="folder">Full path of the folder.</param>
    public static string Propose(FractalTemplate template, string folder) => Enumerable.Range(1, int.MaxValue)
        .Select(number => Path.Combine(
            folder, number == 1 ? $"{template.Name}{Extension}" : FormattableString.Invariant($"{template.Name}-{number}{Extension}")))
        .First(static path => !Path.Exists(path) && !Path.Exists(FractalFile.BaseMeshPath(path)));

    /// <summary>Writes a fractal, and its base mesh beside it.</summary>
    /// <param name="template">What the fractal begins with.</param>
    /// <param name="path">Full path of the new file.</param>
    /// <exception cref="IOException">A name is taken or has another ending, or a file can't be written.</exception>
    public static void Write(FractalTemplate template, string path)
    {
        if (!path.EndsWith(Extension, StringComparison.OrdinalIgnoreCase))
        {
            throw new IOException($"the name of a fractal ends in {Extension}");
        }

        if (!Directory.Exists(Path.GetDirectoryName(path)))
        {
            throw new IOException($"the folder {Path.GetDirectoryName(path)} does not exist");
        }

        if (path.IndexOfAny(['"', '\n', '\r']) >= 0)
        {
            throw new IOException("the name of a fractal has no quote and no line break");
        }

        var meshPath = FractalFile.BaseMeshPath(path);
        if (FirstTaken(path, meshPath) is { } taken)
        {
            throw new IOException($"{Path.GetFileName(taken)} exists already, and is not replaced");
        }

        WriteNew(meshPath, template.MeshText);
        WriteNew(path, template.TextWith(Path.GetFileName(meshPath)));
    }

    private static string? FirstTaken(params ReadOnlySpan<string> paths)
    {
        foreach (var path in paths)
        {
            if (Path.Exists(path))
            {
                return path;
            }
        }

        return null;
    }

    private static void WriteNew(string path, string text)
    {
        var bytes = Encoding.UTF8.GetBytes(text);
        var written = AtomicFile.WriteWithoutReplacing(path, stream => stream.Write(bytes), out var isCreated);
        if (!isCreated || written != path)
        {
            // Another program has taken the name just now.
            if (isCreated)
            {
                File.Delete(written);
            }

            throw new IOException($"{Path.GetFileName(path)} exists already, and is not replaced");
        }
    }
}
