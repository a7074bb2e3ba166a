using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Fractals;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>
/// Loads meshes, fractals and scenes with everything that they refer to. Each file is read once, however often it is named, unless the options say otherwise.
/// </summary>
/// <param name="options">How to load.</param>
/// <param name="progress">Told how far each large file has come.</param>
public sealed class AssetLoader(LoadOptions options, IProgress<LoadProgress>? progress = null)
{
    private readonly Dictionary<string, (Mesh Mesh, ImmutableDictionary<string, Material> Materials, long Bytes)> _meshes = [];
    private readonly Dictionary<string, Model> _models = [];
    private readonly List<Diagnostic> _warnings = [];
    private readonly List<Diagnostic> _errors = [];
    private long _textBytes;
    private FileReferences? _references;
    private MaterialLoader? _materials;

    /// <summary>Loads a file.</summary>
    /// <param name="path">Ends in .obj, .fdo or .sdo.</param>
    /// <param name="options">How to load; null for the usual way.</param>
    /// <param name="progress">Told how far each large file has come.</param>
    /// <exception cref="SourceException">The file, or one that it refers to, can't be loaded: the first error.</exception>
    public static LoadedFile Load(string path, LoadOptions? options = null, IProgress<LoadProgress>? progress = null)
    {
        var loader = new AssetLoader(options ?? new(), progress);
        var file = loader.LoadFile(path);
        return loader._errors.Count == 0 ? file : throw new SourceException(loader._errors[0]);
    }

    /// <summary>Loads a file only to see what is wrong: every error of every file it refers to, then the warnings.</summary>
    public static ImmutableArray<Diagnostic> Check(string path, LoadOptions? options = null)
    {
        var loader = new AssetLoader(options ?? new());
        try
        {
            loader.LoadFile(path);
        }
        catch (SourceException exception)
        {
            loader._errors.Add(exception.Diagnostic);
        }

        return [.. loader._errors, .. loader._warnings];
    }

    private long StorageBytes => _textBytes + _materials!.StorageBytes;

    private LoadedFile LoadFile(string path)
    {
        var full = Path.GetFullPath(path);
        _references = new(AssetFolder.Of(full), options.AllowOutside);
        _materials = new(_references, _warnings);
        return Path.GetExtension(path).ToUpperInvariant() switch
        {
            ".SDO" => LoadScene(full, path),
            ".FDO" => Single(full, FileKind.Fractal, LoadFractal(full, path)),
            ".OBJ" => Single(full, FileKind.Mesh, LoadMesh(full, path)),
            // What is missing is said to be missing first, whatever it is called.
            _ when !File.Exists(full) && !Directory.Exists(full) => throw new SourceException(path, "file not found"),
            _ => throw new SourceException(path, "the ending says nothing of the contents, expected .obj, .fdo or .sdo"),
        };
    }

    private LoadedFile Single(string full, FileKind kind, Model model)
    {
        var declared = new SceneObject(Path.GetFileName(full), Transformation.Identity);
        return Finish(full, kind, new(new() { Objects = [declared] }, [new(declared, model)]), null);
    }

    private LoadedFile Finish(string full, FileKind kind, LoadedScene scene, SceneFile? sceneFile) =>
        new(full, kind, scene, sceneFile, StorageBytes, options.SharesFiles ? [.. _warnings] : [.. _warnings.Distinct()]);

    private LoadedFile LoadScene(string full, string name)
    {
        var file = SceneParser.Parse(Read(full, name, ParsingLimits.DescriptionBytes));
        var placed = ImmutableArray.CreateBuilder<PlacedModel>();
        foreach (var (declared, offset) in file.Scene.Objects.Zip(file.FileOffsets))
        {
            try
            {
                placed.Add(new(declared, LoadReferenced(file.Source, offset, full, declared.File)));
            }
            catch (SourceException exception)
            {
                // Kept, so that a check finds what is wrong with the other files too; loading fails all the same.
                if (!_errors.Contains(exception.Diagnostic))
                {
                    _errors.Add(exception.Diagnostic);
                }
            }
        }

        return Finish(full, FileKind.Scene, new(file.Scene, placed.ToImmutable()), file);
    }

    private Model LoadReferenced(SourceText source, int offset, string referrer, string file)
    {
        var (full, name) = _references!.Resolve(source, offset, referrer, file);
        if (options.SharesFiles && _models.TryGetValue(full, out var known))
        {
            return known;
        }

        return _models[full] = file.EndsWith(".fdo", StringComparison.OrdinalIgnoreCase) ? LoadFractal(full, name) : LoadMesh(full, name);
    }

    private MeshModel LoadMesh(string full, string name)
    {
        var (mesh, materials, bytes) = ReadMesh(full, name);
        return new(full, bytes, mesh) { Materials = materials };
    }

    private FractalModel LoadFractal(string full, string name)
    {
        var before = StorageBytes;
        var file = FractalParser.Parse(Read(full, name, ParsingLimits.DescriptionBytes));
        var ownBytes = StorageBytes - before;
        var (baseFull, baseName) = _references!.Resolve(file.Source, file.BaseFileOffset, full, file.Description.BaseFile);
        var fractal = FractalGenerator.Create(Adapt(file), _ => ReadMesh(baseFull, baseName).Mesh);
        if (fractal.Bounds != BoundingBox.Empty && !fractal.Bounds.Size.IsFinite())
        {
            throw file.Source.Error(file.ResultOffset, fractal.Description.IsInfinite
                ? "the infinite fractal has no bounds: its transformations don't shrink"
                : "the fractal grows beyond the range of a double");
        }

        return new(full, ownBytes + _meshes[baseFull].Bytes, fractal) { Materials = _meshes[baseFull].Materials };
    }

    /// <summary>What the file says, changed as the options ask.</summary>
    private FractalDescription Adapt(FractalFile file)
    {
        var description = file.Description with { Composition = options.Composition ?? file.Description.Composition };
        if (options.Depth is { } depth && description.HasDepth)
        {
            description = description.WithDepth(depth);
        }

        return description is { IsInfinite: true, Composition: Composition.Componentwise }
            ? throw file.Source.Error(file.ResultOffset, "an infinite fractal can't be composed componentwise: its positions don't shrink; give it a depth")
            : description;
    }

    private (Mesh Mesh, ImmutableDictionary<string, Material> Materials, long Bytes) ReadMesh(string full, string name)
    {
        if (options.SharesFiles && _meshes.TryGetValue(full, out var known))
        {
            return known;
        }

        var before = StorageBytes;
        var source = Read(full, name, ParsingLimits.ObjBytes, acceptLatin1: true);
        var file = ObjParser.Parse(source, progress is null ? null : new FileProgress(name, progress));
        _warnings.AddRange(file.Warnings);
        var materials = _materials!.Load(file, source, full);
        return _meshes[full] = (file.Mesh, materials, StorageBytes - before);
    }

    private SourceText Read(string full, string name, long byteLimit, bool acceptLatin1 = false)
    {
        var source = SourceText.Read(full, name, byteLimit, acceptLatin1);
        _textBytes += new FileInfo(full) is { Exists: true } info ? info.Length : 0;
        return source;
    }

    private sealed class FileProgress(string file, IProgress<LoadProgress> progress) : IProgress<double>
    {
        public void Report(double value) => progress.Report(new(file, value));
    }
}
