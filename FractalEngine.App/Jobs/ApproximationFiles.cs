using System.Text;
using FractalEngine.App.Shell;
using FractalEngine.Core;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Fdo.Writing;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.App.Jobs;

/// <summary>The files of a fractal that approximates a mesh: its text, the base mesh, and at times a mesh for the ends.</summary>
internal sealed class ApproximationFiles
{
    private readonly string _output;
    private readonly MeshGrammar _grammar;
    private readonly double _length;
    private readonly string _basePath;
    private readonly string _leafPath;
    private readonly byte[] _baseText;
    private readonly byte[] _leafText;

    /// <param name="output">Path of the fractal file.</param>
    /// <param name="grammar">What it says.</param>
    /// <param name="length">Diagonal of the mesh, scene units.</param>
    public ApproximationFiles(string output, MeshGrammar grammar, double length)
    {
        _output = output;
        _grammar = grammar;
        _length = length;
        _basePath = FractalFile.BaseMeshPath(output);
        _leafPath = $"{Path.ChangeExtension(output, null)}-leaf.obj";
        _baseText = TextOf(grammar.Base);
        _leafText = grammar.Leaf is { } leaf ? TextOf(leaf) : [];
    }

    /// <summary>Bytes of all files with a text of no comments.</summary>
    public long ByteCount => Encoding.UTF8.GetByteCount(TextOf([])) + _baseText.Length + _leafText.Length;

    /// <summary>Writes the files into a folder for a while, and expands what is read back.</summary>
    /// <param name="maxFaces">Largest number of faces.</param>
    /// <returns>The mesh; null where the language refuses the fractal, such as maps that are flat to rounding.</returns>
    public Mesh? ReadBack(long maxFaces)
    {
        var folder = Directory.CreateTempSubdirectory("fractalengine");
        try
        {
            string At(string path) => Path.Combine(folder.FullName, Path.GetFileName(path));
            File.WriteAllBytes(At(_basePath), _baseText);
            if (_leafText.Length > 0)
            {
                File.WriteAllBytes(At(_leafPath), _leafText);
            }

            File.WriteAllText(At(_output), TextOf([]));
            return FractalFile.Read(At(_output)).Flatten(maxFaces);
        }
        catch (FractalEngineException)
        {
            return null;
        }
        finally
        {
            folder.Delete(recursive: true);
        }
    }

    /// <summary>Writes the fractal's file, and the meshes that it names.</summary>
    /// <param name="comments">Lines at the beginning of the fractal's file.</param>
    public void Write(IEnumerable<string> comments)
    {
        if (_leafText.Length > 0)
        {
            OutputFile.Write(_leafPath, stream => stream.Write(_leafText));
        }

        var text = Encoding.UTF8.GetBytes(TextOf(comments));
        OutputFile.WritePair(_basePath, stream => stream.Write(_baseText), _output, stream => stream.Write(text));
    }

    private string TextOf(IEnumerable<string> comments) =>
        GrammarWriter.Write(_grammar, _length, comments, Path.GetFileName(_basePath), Path.GetFileName(_leafPath));

    private static byte[] TextOf(Mesh mesh)
    {
        using var stream = new MemoryStream();
        ObjMeshWriter.Write(mesh, stream);
        return stream.ToArray();
    }
}
