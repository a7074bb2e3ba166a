using FractalEngine.Core.Files;

namespace FractalEngine.Parsing.Editing;

/// <summary>Writes fractals to begin with. No other file is ever replaced.</summary>
public static class NewFractalFile
{
    private const string Extension = ".fdo";

    /// <summary>Returns a name for a fractal in a folder that no other file has.</summary>
    /// <param name="template">What the fractal begins with.</param>
    /// <param name="folder">Full path of the folder.</param>
    public static string Propose(FractalTemplate template, string folder) =>
        NewFile.Propose(Path.Combine(folder, template.Name), Extension, static path => !Path.Exists(path));

    /// <summary>Writes a fractal that needs no other file.</summary>
    /// <param name="template">What the fractal begins with.</param>
    /// <param name="path">Full path of the new file.</param>
    /// <exception cref="IOException">A name is taken or has another ending, or a file can't be written.</exception>
    public static void Write(FractalTemplate template, string path)
    {
        NewFile.Require(path, "a fractal", Extension);
        NewFile.Write(path, template.ReadText());
    }
}
