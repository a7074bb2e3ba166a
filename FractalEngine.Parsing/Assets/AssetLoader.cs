using System.Collections.Immutable;
using FractalEngine.Core;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>
/// Loads a mesh, fractal or scene with all files that it refers to. Each file is read once, however often it is named, unless the options
/// say otherwise.
/// </summary>
public sealed class AssetLoader
{
    private readonly string _path;
    private readonly string _fullPath;
    private readonly LoadOptions _options;
    private readonly ModelLoader _models;
    private readonly bool _isCached;
    private readonly List<Diagnostic> _errors = [];
    private readonly HashSet<Diagnostic> _knownErrors = [];
    private readonly bool _findsAllFaults;

    private AssetLoader(
        string path, LoadOptions? options, IProgress<LoadProgress>? progress, AssetCache? cache, bool findsAllFaults = false)
    {
        _findsAllFaults = findsAllFaults;
        _path = path;
        _fullPath = Path.GetFullPath(path);
        _options = options ?? new();
        if (_options.Depth is { } depth)
        {
            ArgumentOutOfRangeException.ThrowIfNegative(depth, nameof(options));
            ArgumentOutOfRangeException.ThrowIfGreaterThan(depth, FractalLimits.Depth.Value, nameof(options));
        }

        _isCached = cache is not null;
        _models = new(_fullPath, _options, progress, cache);
    }

    /// <summary>Loads a file and everything that it refers to.</summary>
    /// <param name="path">Path that ends in .obj, .obj.gz, .ply, .stl, .glb, .gltf, .fdo or .sdo.</param>
    /// <param name="options">Options for loading; null for the defaults.</param>
    /// <param name="progress">Receives the progress of each large file.</param>
    /// <param name="cache">What earlier loads with the same options have read, to read only what has changed; null for none.</param>
    /// <exception cref="SourceException">The file, or one that it refers to, can't be loaded: the first error.</exception>
    /// <exception cref="ArgumentOutOfRangeException">The depth of the options is negative or beyond the limit.</exception>
    public static LoadedFile Load(
        string path, LoadOptions? options = null, IProgress<LoadProgress>? progress = null, AssetCache? cache = null)
    {
        var loader = new AssetLoader(path, options, progress, cache);
        var isSuccessful = false;
        cache?.ReadCount = 0;
        try
        {
            var file = loader.LoadFile();
            isSuccessful = loader._errors.Count == 0;
            return isSuccessful ? file : throw new SourceException(loader._errors[0]);
        }
        finally
        {
            cache?.Finish(loader._models.Record.All, isSuccessful);
        }
    }

    /// <summary>Loads a file only to find its faults.</summary>
    /// <param name="path">Path that ends in .obj, .obj.gz, .ply, .stl, .glb, .gltf, .fdo or .sdo.</param>
    /// <param name="options">Options for loading; null for the defaults.</param>
    /// <returns>
    /// Errors: of a scene those of its lines, a hundred at most, then one for each file that it refers to. Then the warnings.
    /// </returns>
    public static ImmutableArray<Diagnostic> Check(string path, LoadOptions? options = null)
    {
        var loader = new AssetLoader(path, options, null, null, findsAllFaults: true);
        try
        {
            loader.LoadFile();
        }
        catch (SourceException exception)
        {
            loader._errors.Add(exception.Diagnostic);
        }

        return [.. loader._errors, .. loader._models.Warnings];
    }

    private FileKind? Kind => _options.Text is { } text
        ? text.Text.Contains("<$>", StringComparison.Ordinal) ? FileKind.Fractal : FileKind.Scene
        : FileKinds.FromName(_path);

    private LoadedFile LoadFile()
    {
        if (_options.Text is null && !Path.Exists(_fullPath))
        {
            // A missing file is reported as missing first, whatever its name is. The record has it, so that it can appear.
            _models.Record.Add(_fullPath);
            throw new SourceException(_path, $"file not found{NeighbourSuggestion.Ask(_fullPath)}");
        }

        return Kind switch
        {
            FileKind.Scene => LoadScene(),
            { } kind => CreateSingleObjectFile(kind, _models.LoadModel(_fullPath, _path, kind)),
            _ => throw new SourceException(
                _path, $"the ending says nothing of the contents, expected {FileKinds.MeshEndings}, .fdo or .sdo"),
        };
    }

    private LoadedFile CreateSingleObjectFile(FileKind kind, Model model)
    {
        // Meshes come from other tools, which are right-handed; fractals are seen as the paper's figures show them.
        var scene = model.Surroundings ?? new() { Handedness = kind == FileKind.Mesh ? Handedness.Right : Handedness.Left };
        // Camera and lights of a file stand where it has them.
        scene = _options.Placement == Transformation.Identity ? scene : new() { Handedness = scene.Handedness };
        scene = scene with
        {
            Handedness = _options.Handedness ?? scene.Handedness,
            Objects = [new(Path.GetFileName(_fullPath), _options.Placement) { Model = model }],
        };
        return CreateLoadedFile(kind, LoadedScene.Of(_options.IsStaged ? Stage.Of(scene, kind == FileKind.Fractal) : scene), null);
    }

    private LoadedFile CreateLoadedFile(FileKind kind, LoadedScene scene, ParsedScene? parsedScene) =>
        new(_fullPath, kind, scene, parsedScene, _models.StorageBytes,
            _options.ShareModels && !_isCached ? [.. _models.Warnings] : [.. _models.Warnings.Distinct()]);

    private LoadedFile LoadScene()
    {
        var text = _models.ReadText(_fullPath, _path, ParsingLimits.DescriptionBytes.Value);
        var parsed = _findsAllFaults ? SceneParser.Parse(text, _errors) : SceneParser.Parse(text);
        _models.Warnings.AddRange(parsed.Warnings);
        if (_options.FilmTime is { } time && parsed.Scene.Film is { } film)
        {
            _models.Values = film.ValuesAt(time).SetItems(_options.Values);
        }

        var objects = ImmutableArray.CreateBuilder<SceneObject>(parsed.Scene.Objects.Length);
        foreach (var (declared, offset) in parsed.Scene.Objects.Zip(parsed.FileNameOffsets))
        {
            Attempt(() =>
            {
                declared.AttachModel(_models.LoadReferenced(parsed.Source, offset, declared.File!));
                objects.Add(declared);
            });
        }

        var sky = parsed.Scene.Sky;
        if (sky is ImageSky declaredSky)
        {
            Attempt(() => sky = declaredSky with { Image = _models.LoadSkyImage(parsed.Source, parsed.SkyNameOffset, declaredSky.File) });
        }

        var scene = LoadedScene.Of(parsed.Scene with { Objects = objects.DrainToImmutable(), Sky = sky });
        if (_errors.Count == 0)
        {
            RequireKnownNumbers(scene, parsed);
            RequireFiniteBounds(scene, parsed);
        }

        return CreateLoadedFile(FileKind.Scene, scene, parsed);
    }

    /// <summary>Loads a file. After a fault loading goes on, so that a check finds the faults of the other files too.</summary>
    private void Attempt(Action load)
    {
        try
        {
            load();
        }
        catch (SourceException exception)
        {
            if (_knownErrors.Add(exception.Diagnostic))
            {
                _errors.Add(exception.Diagnostic);
            }
        }
    }

    /// <summary>Throws for a key of a number that no fractal has.</summary>
    private static void RequireKnownNumbers(LoadedScene scene, ParsedScene parsed)
    {
        var names = scene.Models.OfType<FractalModel>().SelectMany(static model => model.NumberNames).ToHashSet();
        foreach (var (index, key) in (parsed.Scene.Film?.Keys ?? []).Index())
        {
            if (key is NumberKey { Name: var name } && !names.Contains(name))
            {
                throw parsed.Source.Error(
                    parsed.DeclarationOffset(index, SceneDeclarationKind.FilmKey),
                    $"no fractal of the scene declares a number '{name}'{NameSuggestion.Ask(name, names)}");
            }
        }
    }

    /// <summary>Throws for an object whose placement takes it beyond the numbers that there are.</summary>
    private static void RequireFiniteBounds(LoadedScene scene, ParsedScene parsed)
    {
        foreach (var (placed, offset) in scene.Objects.Zip(parsed.FileNameOffsets))
        {
            if (!placed.Bounds.IsEmpty && !(placed.Bounds.Minimum.IsFinite() && placed.Bounds.Maximum.IsFinite()))
            {
                throw parsed.Source.Error(
                    offset, "the placement takes the object beyond 1.8e308, the limit of a coordinate", isLimitExceeded: true);
            }
        }
    }
}
