using System.Collections.Immutable;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>The text of all files of a model.</summary>
/// <param name="Main">Path of the main file from the folder of the model.</param>
/// <param name="Files">Texts by their paths.</param>
internal sealed record GraphTexts(string Main, ImmutableSortedDictionary<string, string> Files)
{
    /// <summary>Writes a model as text.</summary>
    /// <param name="file">The main file.</param>
    /// <param name="random">Chooses among equivalent forms; null for the plainest ones.</param>
    /// <param name="hasNormals">Whether meshes state the normals of their faces.</param>
    public static GraphTexts Of(GraphFile file, Random? random = null, bool hasNormals = false)
    {
        var files = ImmutableSortedDictionary.CreateBuilder<string, string>(StringComparer.Ordinal);
        Add(file);
        return new(file.Path, files.ToImmutable());

        void Add(GraphFile graph)
        {
            GraphFileWriter writer = new(graph, random);
            files[graph.Path] = writer.Write();
            foreach (var mesh in writer.Meshes)
            {
                files[mesh.Path] = ObjText.Of(mesh, hasNormals);
            }

            foreach (var other in writer.Files.Where(other => !files.ContainsKey(other.Path)))
            {
                Add(other);
            }
        }
    }

    /// <summary>Writes all files into a folder, whose sub folders may name each other's files.</summary>
    /// <returns>The full path of the main file.</returns>
    public string WriteTo(TemporaryFolder folder)
    {
        folder.Write(".asset-root", "");
        foreach (var (path, text) in Files)
        {
            folder.Write(path, text);
        }

        return folder[Main];
    }

    /// <summary>Joins all texts for a message.</summary>
    public override string ToString() => string.Concat(Files.Select(static file => $"--- {file.Key}\n{file.Value}"));
}
