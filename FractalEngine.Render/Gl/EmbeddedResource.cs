namespace FractalEngine.Render.Gl;

/// <summary>Opens files that are embedded in the assembly.</summary>
internal static class EmbeddedResource
{
    /// <summary>Opens an embedded file.</summary>
    /// <param name="name">Folder and name, such as <c>Shaders/mesh.vert</c>.</param>
    /// <exception cref="FileNotFoundException">The assembly has no such file.</exception>
    public static Stream Open(string name) =>
        typeof(EmbeddedResource).Assembly.GetManifestResourceStream(name)
        ?? throw new FileNotFoundException($"the assembly has no embedded file {name}", name);

    /// <summary>Reads a whole embedded text file.</summary>
    /// <exception cref="FileNotFoundException">The assembly has no such file.</exception>
    public static string ReadText(string name)
    {
        using var reader = new StreamReader(Open(name));
        return reader.ReadToEnd();
    }
}
