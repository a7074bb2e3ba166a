using System.Collections.Immutable;
using System.Text;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Files;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Fdo.Writing;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing;

/// <summary>Writes what makes a mesh as a fractal file, with its base meshes beside it; <see cref="FractalFile"/> reads it.</summary>
public static class GrammarFile
{
    /// <summary>Creates or replaces the file of a grammar.</summary>
    /// <param name="path">Path that ends in <c>.fdo</c>; its folder is created if it is missing.</param>
    /// <param name="grammar">What makes the mesh.</param>
    /// <param name="length">Diagonal of the mesh, scene units; numbers are rounded by at most 2e-10 of it.</param>
    /// <param name="comments">Lines at the beginning of the file, without the sign of a comment.</param>
    /// <exception cref="ArgumentException">The path does not end in <c>.fdo</c>.</exception>
    /// <exception cref="IOException">A file can't be written. No new file is left then, and old ones are unchanged.</exception>
    /// <remarks>Meshes are written as by <see cref="FractalFile.Write"/>: different files of their names stay as they are.</remarks>
    public static void Write(string path, MeshGrammar grammar, double length, IEnumerable<string> comments)
    {
        FileKinds.Require(path, FileKind.Fractal);
        ArgumentNullException.ThrowIfNull(grammar);
        ArgumentNullException.ThrowIfNull(comments);
        var fullPath = Path.GetFullPath(path);
        using var companions = new NewFiles();
        var text = GrammarWriter.Write(grammar, length, comments, (name, mesh) => FileReference.Create(fullPath, MeshFile.WriteNew(
            $"{Path.ChangeExtension(fullPath, null)}-{name}.obj", mesh, ImmutableDictionary<string, Material>.Empty, companions)));
        AtomicFile.Write(path, stream => stream.Write(Encoding.UTF8.GetBytes(text)));
        companions.Keep();
    }
}
