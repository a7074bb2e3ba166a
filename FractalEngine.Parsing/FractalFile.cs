using System.Collections.Immutable;
using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Files;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Fdo.Writing;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing;

/// <summary>
/// Reads and writes fractals as files (<c>.fdo</c>). What is written reads back as an equal fractal; with
/// <see cref="LoadOptions.AllowOutsideFiles"/>, where its base mesh has a file outside the folder of the new one. Where a recursive's body
/// names other fractal files, it reads back as the same shape, made of other parts.
/// </summary>
/// <example><code>
/// FractalFile.Write("sponge.fdo", Fractal.Of(Shapes.Cube()).Repeat(maps, 5)); // and sponge-base.obj
/// var sponge = FractalFile.Read("sponge.fdo");
/// </code></example>
public static class FractalFile
{
    /// <summary>Reads a fractal and its base mesh.</summary>
    /// <param name="path">Path of a file that ends in <c>.fdo</c>.</param>
    /// <param name="options">Options for loading; null for the defaults.</param>
    /// <exception cref="ArgumentException">The path does not end in <c>.fdo</c>.</exception>
    /// <exception cref="SourceException">The file or its base mesh can't be loaded.</exception>
    public static Fractal Read(string path, LoadOptions? options = null)
    {
        FileKinds.Require(path, FileKind.Fractal);
        return ((FractalModel)AssetLoader.Load(path, options).Scene.Objects[0].Model).Fractal;
    }

    /// <summary>Creates or replaces the file of a fractal, and its base mesh beside it if that has no file.</summary>
    /// <param name="path">Path that ends in <c>.fdo</c>; its folder is created if it is missing.</param>
    /// <param name="fractal">Fractal made in code or read from a file.</param>
    /// <exception cref="ArgumentException">The path does not end in <c>.fdo</c>.</exception>
    /// <exception cref="FractalEngineException">The fractal or its base mesh can't be expressed in the files.</exception>
    /// <exception cref="IOException">A file can't be written. No new file is left then, and old ones are unchanged.</exception>
    /// <remarks>
    /// A base mesh that was loaded from a file keeps that file, which is named relative to the new one. Reading needs
    /// <see cref="LoadOptions.AllowOutsideFiles"/> if it lies outside the new file's <see cref="AssetFolder"/>. Any other base mesh is
    /// written as <see cref="BaseMeshPath"/>: a file with equal contents is used as it is; a different one stays untouched, and
    /// <c>NAME-base-2.obj</c> and so on are tried.
    /// </remarks>
    public static void Write(string path, Fractal fractal)
    {
        FileKinds.Require(path, FileKind.Fractal);
        ArgumentNullException.ThrowIfNull(fractal);
        using var companions = new NewFiles();
        var text = WriteText(Path.GetFullPath(path), fractal, static _ => ImmutableDictionary<string, Material>.Empty, companions);
        AtomicFile.Write(path, stream => stream.Write(text));
        companions.Keep();
    }

    /// <summary>
    /// Returns the path of the base mesh that is written beside a fractal: <c>NAME-base.obj</c>, as <c>NAME.obj</c> is where one would
    /// write the mesh that the fractal makes.
    /// </summary>
    /// <param name="path">Path that ends in <c>.fdo</c>.</param>
    public static string BaseMeshPath(string path) => $"{Path.ChangeExtension(path, null)}-base.obj";

    /// <summary>Returns the text of a fractal file, and writes the base mesh if it has no file.</summary>
    /// <param name="fullPath">Full path of the fractal file, or of another one in the same folder.</param>
    /// <param name="fractal">Fractal made in code or read from a file.</param>
    /// <param name="materialsOf">Gives the materials of a base mesh that has no file, by its index.</param>
    /// <param name="companions">Receives the base mesh if it has no file.</param>
    internal static byte[] WriteText(
        string fullPath, Fractal fractal, Func<int, IReadOnlyDictionary<string, Material>> materialsOf, NewFiles companions)
    {
        if (FractalCheck.FindBoundsFault(fractal) is { } fault)
        {
            throw new FractalEngineException($"the fractal can't be written as a file: {fault}");
        }

        ImmutableArray<BaseReference> bases = [.. Enumerable.Range(0, fractal.BaseMeshes.Length).Select(NameBase)];
        return Encoding.UTF8.GetBytes(FractalWriter.Write(fractal.Description, bases));

        BaseReference NameBase(int index)
        {
            var (mesh, meshPath) = (fractal.BaseMeshes[index], fractal.BaseMeshPaths[index]);
            // The loader of fractals names material files by their full paths, those of meshes as these do.
            var material = mesh is { MaterialLibraries: [var library], Groups: [{ Material: var name }, ..] }
                && Path.IsPathFullyQualified(library) && File.Exists(library)
                    ? new MaterialReference(FileReference.Create(fullPath, library), name, 0) : null;
            return BaseShapes.NameOf(mesh, isPainted: material is not null) is { } shape ? new(shape, 0) { Material = material }
                : meshPath is not null && File.Exists(meshPath)
                    ? new(FileReference.Create(fullPath, meshPath), 0) { Material = material }
                : new(FileReference.Create(
                    fullPath, MeshFile.WriteNew(BaseMeshPath(fullPath), mesh, materialsOf(index), companions)), 0);
        }
    }
}
