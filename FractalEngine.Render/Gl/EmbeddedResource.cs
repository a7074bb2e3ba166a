namespace FractalEngine.Render.Gl;

/// <summary>Files that are part of the assembly.</summary>
internal static class EmbeddedResource
{
    /// <summary>Opens a file.</summary>
    /// <param name="name">Folder and name: <c>Shaders/mesh.vert</c>.</param>
    /// <exception cref="FileNotFoundException">There is no such file in the assembly.</exception>
    public static Stream Open(string name) =>
        typeof(EmbeddedResource).Assembly.GetManifestResourceStream(name)
        ?? throw new FileNotFoundException($"the assembly holds no file {name}", name);

    /// <summary>Reads a whole text file.</summary>
    public static string ReadText(string name)
    {
        using var reader = new StreamReader(Open(name));
        return reader.ReadToEnd();
    }
}
