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
/// Loads meshes, fractals and scenes with everything that they refer to. Each file is read once, however often it is named, unless the
/// options say otherwise.
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
    private FileReferenceResolver? _references;
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
        var fullPath = Path.GetFullPath(path);
        _references = new(AssetFolder.ForFile(fullPath), options.AllowOutsideFiles);
        _materials = new(_references, _warnings);
        return Path.GetExtension(path).ToUpperInvariant() switch
        {
            ".SDO" => LoadScene(fullPath, path),
            ".FDO" => CreateSingleObjectFile(fullPath, FileKind.Fractal, LoadFractal(fullPath, path)),
            ".OBJ" => CreateSingleObjectFile(fullPath, FileKind.Mesh, LoadMesh(fullPath, path)),
            // What is missing is said to be missing first, whatever it is called.
            _ when !File.Exists(fullPath) && !Directory.Exists(fullPath) => throw new SourceException(path, "file not found"),
            _ => throw new SourceException(path, "the ending says nothing of the contents, expected .obj, .fdo or .sdo"),
        };
    }

    private LoadedFile CreateSingleObjectFile(string fullPath, FileKind kind, Model model)
    {
        var declared = new SceneObject(Path.GetFileName(fullPath), Transformation.Identity) { Model = model };
        return CreateLoadedFile(fullPath, kind, LoadedScene.Of(new() { Objects = [declared] }), null);
    }

    private LoadedFile CreateLoadedFile(string fullPath, FileKind kind, LoadedScene scene, SceneFile? sceneFile) =>
        new(fullPath, kind, scene, sceneFile, StorageBytes, options.ShareModels ? [.. _warnings] : [.. _warnings.Distinct()]);

    private LoadedFile LoadScene(string fullPath, string displayName)
    {
        var file = SceneParser.Parse(ReadText(fullPath, displayName, ParsingLimits.DescriptionBytes));
        var objects = ImmutableArray.CreateBuilder<SceneObject>();
        foreach (var (declared, offset) in file.Scene.Objects.Zip(file.FileNameOffsets))
        {
            try
            {
                objects.Add(declared with { Model = LoadReferenced(file.Source, offset, fullPath, declared.File!) });
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

        return CreateLoadedFile(fullPath, FileKind.Scene, LoadedScene.Of(file.Scene with { Objects = objects.ToImmutable() }), file);
    }

    private Model LoadReferenced(SourceText source, int offset, string referrer, string file)
    {
        var (fullPath, displayName) = _references!.Resolve(source, offset, referrer, file);
        if (options.ShareModels && _models.TryGetValue(fullPath, out var cached))
        {
            return cached;
        }

        return _models[fullPath] = file.EndsWith(".fdo", StringComparison.OrdinalIgnoreCase)
            ? LoadFractal(fullPath, displayName)
            : LoadMesh(fullPath, displayName);
    }

    private MeshModel LoadMesh(string fullPath, string displayName)
    {
        var (mesh, materials, bytes) = ReadMesh(fullPath, displayName);
        return new(mesh) { SourcePath = fullPath, FileBytes = bytes, Materials = materials };
    }

    private FractalModel LoadFractal(string fullPath, string displayName)
    {
        var bytesBefore = StorageBytes;
        var file = FractalParser.Parse(ReadText(fullPath, displayName, ParsingLimits.DescriptionBytes));
        var ownBytes = StorageBytes - bytesBefore;
        var (baseFullPath, baseDisplayName) = _references!.Resolve(file.Source, file.BaseFileNameOffset, fullPath, file.BaseFile);
        var description = ApplyOptions(file);
        var (baseMesh, materials, baseBytes) = ReadMesh(baseFullPath, baseDisplayName);
        var fractal = new Fractal(description, baseMesh) { BaseMeshPath = baseFullPath };
        if (fractal.Bounds != BoundingBox.Empty && !fractal.Bounds.Size.IsFinite())
        {
            throw file.Source.Error(file.ResultOffset, fractal.Description.IsInfinite
                ? "the infinite fractal has no bounds: its transformations don't shrink"
                : "the fractal grows beyond the range of a double");
        }

        return new(fractal) { SourcePath = fullPath, FileBytes = ownBytes + baseBytes, Materials = materials };
    }

    /// <summary>What the file says, changed as the options ask.</summary>
    private FractalDescription ApplyOptions(FractalFile file)
    {
        var description = file.Description with { Composition = options.Composition ?? file.Description.Composition };
        if (options.Depth is { } depth && description.HasDepth)
        {
            description = description.WithDepth(depth);
        }

        return description is { IsInfinite: true, Composition: Composition.Componentwise }
            ? throw file.Source.Error(file.ResultOffset,
            "an infinite fractal can't be composed componentwise: its positions don't shrink; give it a depth")
            : description;
    }

    private (Mesh Mesh, ImmutableDictionary<string, Material> Materials, long Bytes) ReadMesh(string fullPath, string displayName)
    {
        if (options.ShareModels && _meshes.TryGetValue(fullPath, out var cached))
        {
            return cached;
        }

        var bytesBefore = StorageBytes;
        var source = ReadText(fullPath, displayName, ParsingLimits.ObjBytes, acceptLatin1: true);
        var file = ObjParser.Parse(source, progress is null ? null : new FileProgress(displayName, progress));
        _warnings.AddRange(file.Warnings);
        var materials = _materials!.Load(file, source, fullPath);
        return _meshes[fullPath] = (file.Mesh, materials, StorageBytes - bytesBefore);
    }

    private SourceText ReadText(string fullPath, string displayName, long maxBytes, bool acceptLatin1 = false)
    {
        var source = SourceText.Read(fullPath, displayName, maxBytes, acceptLatin1);
        _textBytes += new FileInfo(fullPath) is { Exists: true } info ? info.Length : 0;
        return source;
    }

    private sealed class FileProgress(string file, IProgress<LoadProgress> progress) : IProgress<double>
    {
        public void Report(double value) => progress.Report(new(file, value));
    }
}
