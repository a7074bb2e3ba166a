using FractalEngine.Core;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Parsing.Approximation;

/// <summary>What the files of a grammar make, as they are read back.</summary>
/// <param name="Mesh">All faces.</param>
/// <param name="Bytes">Size of the files without comments.</param>
public sealed record WrittenGrammar(Mesh Mesh, long Bytes)
{
    /// <summary>Writes a grammar into a folder that is removed again, and expands what is read from there.</summary>
    /// <param name="grammar">What makes a mesh.</param>
    /// <param name="length">Diagonal of the mesh, scene units, see <see cref="GrammarFile.Write"/>.</param>
    /// <param name="maxFaces">Maximum number of faces.</param>
    /// <exception cref="FractalEngineException">
    /// The language can't express it, as with nearly flat maps, or it has too many faces.
    /// </exception>
    /// <exception cref="IOException">The folder for temporary files can't be written.</exception>
    public static WrittenGrammar Create(MeshGrammar grammar, double length, long maxFaces)
    {
        var folder = CreateFolder();
        try
        {
            var path = Path.Combine(folder.FullName, "found.fdo");
            GrammarFile.Write(path, grammar, length, []);
            return new(FractalFile.Read(path).Flatten(maxFaces), folder.EnumerateFiles().Sum(file => file.Length));
        }
        finally
        {
            folder.Delete(recursive: true);
        }
    }

    private static DirectoryInfo CreateFolder()
    {
        try
        {
            return Directory.CreateTempSubdirectory("fractalengine");
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            throw new IOException(
                $"{Path.GetTempPath()}, the folder for temporary files, can't be written: {exception.Message}", exception);
        }
    }
}
