using System.Collections.Immutable;
using FractalEngine.Core;
using FractalEngine.Core.Files;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>Loads meshes and fractals, each file once unless the options say otherwise.</summary>
internal sealed class ModelLoader
{
    private readonly string _fullPath;
    private readonly LoadOptions _options;
    private readonly IProgress<LoadProgress>? _progress;
    private readonly AssetCache? _cache;
    private readonly FileReferenceResolver _references;
    private readonly MaterialLoader _materials;

    // By full paths, with and without instances.
    private readonly Dictionary<(string Path, bool KeepsInstances), MeshContents> _meshes = [];

    // By full paths, and by the names in the scene: to find a file costs more than a line of the scene.
    private readonly Dictionary<string, Model> _models = [];
    private readonly Dictionary<string, Diagnostic> _faults = [];

    // The fractals that are parts of others, by full paths, and those that are being read, the outermost first.
    private readonly Dictionary<string, LoadedBase> _innerFractals = [];
    private readonly List<string> _openFractals = [];
    private long _textBytes;

    /// <summary>Prepares for the models of one file.</summary>
    /// <param name="fullPath">Full path of the file that is loaded.</param>
    /// <param name="options">Options for loading.</param>
    /// <param name="progress">Receives the progress of each large file.</param>
    /// <param name="cache">What earlier loads have read; null for none.</param>
    public ModelLoader(string fullPath, LoadOptions options, IProgress<LoadProgress>? progress, AssetCache? cache)
    {
        _fullPath = fullPath;
        _options = options;
        Values = options.Values;
        _progress = progress;
        _cache = options.ShareModels ? cache : null;
        _references = new(AssetFolder.ForFile(fullPath), options.AllowOutsideFiles, Record);
        _materials = new(_references, Warnings, Record, _cache);
    }

    /// <summary>Values of named numbers of fractals.</summary>
    public ImmutableDictionary<string, double> Values { get; set; }

    /// <summary>The files that were looked at.</summary>
    public FileRecord Record { get; } = new();

    /// <summary>Warnings about everything that was ignored. What is taken from a cache has its warnings as often as it is named.</summary>
    public List<Diagnostic> Warnings { get; } = [];

    /// <summary>Total size of all files read, each counted once, in bytes.</summary>
    public long StorageBytes => _textBytes + _materials.StorageBytes;

    /// <summary>Loads a model that a text names, each name once.</summary>
    /// <param name="source">The text.</param>
    /// <param name="offset">Offset of the name in the text.</param>
    /// <param name="file">Name as written.</param>
    /// <exception cref="SourceException">The file can't be loaded.</exception>
    public Model LoadReferenced(SourceText source, int offset, string file)
    {
        if (_options.ShareModels && _models.TryGetValue(file, out var named))
        {
            return named;
        }

        var (fullPath, displayName) = _references.Resolve(source, offset, _fullPath, file);
        if (_options.ShareModels && _models.TryGetValue(fullPath, out var cached))
        {
            return _models[file] = cached;
        }

        if (_faults.TryGetValue(fullPath, out var fault))
        {
            throw new SourceException(fault);
        }

        try
        {
            return _models[file] = _models[fullPath] = LoadModel(fullPath, displayName, FileKinds.FromName(fullPath));
        }
        catch (SourceException exception)
        {
            _faults[fullPath] = exception.Diagnostic;
            throw;
        }
    }

    /// <summary>Loads the image of a sky, or takes it from the cache.</summary>
    /// <param name="source">The text that names it.</param>
    /// <param name="offset">Offset of the name in the text.</param>
    /// <param name="file">Name as written.</param>
    /// <exception cref="SourceException">The file can't be loaded.</exception>
    public SkyImage LoadSkyImage(SourceText source, int offset, string file)
    {
        var (fullPath, displayName) = _references.Resolve(source, offset, _fullPath, file);
        _textBytes += new FileInfo(fullPath).Length;
        return AssetCache.ReadOrFind(_cache, fullPath, Record.Add(fullPath), () =>
        {
            _cache?.ReadCount += 1;
            var bytes = SourceText.ReadBytes(fullPath, displayName, ParsingLimits.ImageBytes.Value);
            try
            {
                return new SkyImage(RadianceFile.Read(bytes, ParsingLimits.SkyPixels.Value)) { SourcePath = fullPath };
            }
            catch (FractalEngineException fault)
            {
                throw source.Error(offset, $"the image \"{file}\" {fault.Message}", fault.Kind == ErrorKind.Limit);
            }
        });
    }

    /// <summary>Loads a model, or takes it from the cache if none of its files has changed.</summary>
    /// <exception cref="SourceException">The file can't be loaded.</exception>
    public Model LoadModel(string fullPath, string displayName, FileKind? kind)
    {
        if (_cache?.FindModel(fullPath, EditedText(fullPath), Values) is { } cached)
        {
            Record.AddRange(cached.Files);
            Warnings.AddRange(cached.Warnings);
            _textBytes += cached.StorageBytes;
            return cached.Model;
        }

        var filesBefore = Record.Position;
        var warningsBefore = Warnings.Count;
        var bytesBefore = StorageBytes;
        Model model = kind == FileKind.Fractal ? LoadFractal(fullPath, displayName) : LoadMesh(fullPath, displayName);
        _cache?.Store(fullPath, new(
            model, Record.Since(filesBefore), [.. Warnings.Skip(warningsBefore)], StorageBytes - bytesBefore, EditedText(fullPath),
            Values));
        return model;
    }

    private Model LoadMesh(string fullPath, string displayName)
    {
        var contents = ReadMesh(fullPath, displayName, keepsInstances: MeshReader.HasInstances(fullPath));
        var parsed = contents.Parsed;
        if (parsed.Instances.IsEmpty)
        {
            return new MeshModel(parsed.Mesh)
            {
                SourcePath = fullPath,
                FileBytes = contents.ByteCount,
                Materials = contents.Materials,
                Surroundings = parsed.Surroundings,
            };
        }

        // What stands once is one mesh. No file has any of these alone.
        IEnumerable<(Mesh Mesh, string Name, TransformationSet Places)> parts = parsed.Mesh.FaceCount == 0
            ? parsed.Instances : parsed.Instances.Prepend((parsed.Mesh, "others", TransformationSet.Of(Transformation.Identity)));
        return new FractalModel(Fractal.Sum(parts.Select(part => new Fractal(new([part.Places]), part.Mesh)
        {
            BaseMeshPath = $"{fullPath}#{part.Name}",
        })))
        {
            SourcePath = fullPath,
            FileBytes = contents.ByteCount,
            Materials = contents.Materials,
            Surroundings = parsed.Surroundings,
        };
    }

    private FractalModel LoadFractal(string fullPath, string displayName)
    {
        var parsed = ReadOrFindFractal(fullPath, displayName);
        Warnings.AddRange(parsed.Warnings);
        var bases = LoadBases(parsed, fullPath);
        if (!parsed.KeepsSums && bases.Exists(static one => one.Fractal.Description.HasChance))
        {
            // It names the same files, perhaps fewer times.
            var loaded = parsed.Bases.Zip(bases).DistinctBy(static one => KeyOf(one.First))
                .ToDictionary(static one => KeyOf(one.First), static one => one.Second);
            parsed = FractalParser.ParseKeepingSums(parsed.Source, Values);
            bases = [.. parsed.Bases.Select(reference => loaded[KeyOf(reference)])];
        }

        var joined = Join(parsed, bases);
        // Options are those of the whole, and so are bounds.
        var fractal = _openFractals.Count > 0 ? joined : ApplyOptions(parsed, joined);
        var materials = new Dictionary<Mesh, ImmutableDictionary<string, Material>>(ReferenceEqualityComparer.Instance);
        foreach (var (mesh, ofMesh) in bases.SelectMany(static one => one.Fractal.BaseMeshes.Zip(one.Materials)))
        {
            materials.TryAdd(mesh, ofMesh);
        }

        return new(fractal)
        {
            SourcePath = fullPath,
            FileBytes = parsed.Source.ByteCount + bases.DistinctBy(static one => one.Key).Sum(static one => one.ByteCount),
            Materials = fractal.HasSeveralMeshes
                ? ImmutableDictionary<string, Material>.Empty
                : materials[fractal.BaseMeshes.MaxBy(static mesh => mesh.FaceCount)!],
            MaterialsByMesh = fractal.HasSeveralMeshes ? [.. fractal.BaseMeshes.Select(mesh => materials[mesh])] : [],
            Gradient = parsed.Gradient,
            Surroundings = parsed.Handedness is { } handedness ? new() { Handedness = handedness } : null,
            NumberNames = [.. parsed.NumberNames.Concat(bases.SelectMany(static one => one.NumberNames)).Distinct()],
        };
    }

    private List<LoadedBase> LoadBases(ParsedFractal parsed, string fullPath)
    {
        _openFractals.Add(fullPath);
        try
        {
            return parsed.Bases.Select(reference => LoadBase(parsed, reference, fullPath)).ToList();
        }
        finally
        {
            _openFractals.RemoveAt(_openFractals.Count - 1);
        }
    }

    /// <summary>Loads what stands for a base mesh: a mesh, a shape or another fractal, perhaps with a material of its own.</summary>
    private LoadedBase LoadBase(ParsedFractal parsed, BaseReference reference, string fullPath)
    {
        var loaded = LoadPlainBase(parsed, reference, fullPath);
        if (reference.Material is not { } named)
        {
            return loaded;
        }

        var (name, material, filePath) = _materials.LoadNamed(parsed.Source, named, fullPath);
        var mesh = loaded.Fractal.BaseMesh;
        mesh = material.IsTextured && mesh.TextureIndices.IsEmpty ? mesh.WithBoxProjection() : mesh;
        ImmutableArray<MeshGroup> groups = mesh.Groups.IsEmpty
            ? [new(0, mesh.FaceCount, "", "", name, 0)]
            : ImmutableArray.CreateRange(mesh.Groups, group => group with { Material = name });
        return loaded with
        {
            Fractal = new(new([]), mesh.WithGroups(groups, [filePath])) { BaseMeshPath = loaded.Fractal.BaseMeshPath },
            Materials = [ImmutableDictionary<string, Material>.Empty.Add(name, material)],
        };
    }

    private static (string File, string? MaterialFile, string? Material) KeyOf(BaseReference reference) =>
        (reference.File, reference.Material?.File, reference.Material?.Name);

    private LoadedBase LoadPlainBase(ParsedFractal parsed, BaseReference reference, string fullPath)
    {
        // No name of a file is that of a shape, since it has an ending.
        if (BaseShapes.TryFind(reference.File, out var shape))
        {
            return new(reference.File, Fractal.Of(shape!), [ImmutableDictionary<string, Material>.Empty], 0, []);
        }

        var (path, displayName) = _references.Resolve(parsed.Source, reference.Offset, fullPath, reference.File);
        if (FileKinds.FromName(path) != FileKind.Fractal)
        {
            var contents = ReadMesh(path, displayName);
            return new(path, new(new([]), contents.Parsed.Mesh) { BaseMeshPath = path }, [contents.Materials], contents.ByteCount, []);
        }

        if (_innerFractals.TryGetValue(path, out var known))
        {
            Record.AddRange(known.Files);
            return known;
        }

        if (_openFractals.IndexOf(path) is >= 0 and var first)
        {
            var files = string.Join(" → ", _openFractals.Skip(first).Append(path).Select(Path.GetFileName));
            throw parsed.Source.Error(reference.Offset, $"a fractal can't contain itself: {files}");
        }

        if (_openFractals.Count >= FractalLimits.Nesting.Value)
        {
            throw parsed.Source.Error(
                reference.Offset, $"more than the limit of {FractalLimits.Nesting.Value} fractal files inside each other",
                isLimitExceeded: true);
        }

        var filesBefore = Record.Position;
        var model = LoadFractal(path, displayName);
        if (model.Fractal.Description.Composition == Composition.Componentwise)
        {
            throw parsed.Source.Error(
                reference.Offset, $"'{reference.File}' is composed componentwise, and can't be a part of another fractal");
        }

        ImmutableDictionary<string, Material>[] materials =
            [.. Enumerable.Range(0, model.Fractal.BaseMeshes.Length).Select(model.MaterialsAt)];
        return _innerFractals[path] = new(path, model.Fractal, [.. materials], model.FileBytes, model.NumberNames)
        {
            Files = Record.Since(filesBefore),
        };
    }

    /// <summary>Puts the fractals and meshes that a file names in the places of its base meshes.</summary>
    private static Fractal Join(ParsedFractal parsed, List<LoadedBase> bases)
    {
        foreach (var (i, (fractal, reference)) in bases.Select(static one => one.Fractal).Zip(parsed.Bases).Index())
        {
            if (!fractal.Description.IsMesh && parsed.Description.Composition == Composition.Componentwise)
            {
                throw parsed.Source.Error(
                    reference.Offset, "a fractal that is composed componentwise can't have another fractal as a part");
            }

            if (fractal.Description.IsInfinite && !parsed.Description.MayHoldInfinite(i))
            {
                throw parsed.Source.Error(
                    reference.Offset, $"'{reference.File}' is infinite, and can't be repeated: give its recursive a depth");
            }
        }

        Fractal joined;
        try
        {
            joined = Fractal.Of(parsed.Description, [.. bases.Select(static one => one.Fractal)]);
        }
        catch (FractalLimitException exception)
        {
            throw parsed.Source.Error(parsed.ResultOffset, exception.Message, isLimitExceeded: true);
        }

        var limit = ParsingLimits.BaseFiles.Value;
        return joined.BaseMeshes.Length <= limit ? joined : throw parsed.Source.Error(
            parsed.ResultOffset, $"the fractal has more than the limit of {limit} base meshes", isLimitExceeded: true);
    }

    /// <summary>Returns a fractal with the overrides of the options, and with finite bounds.</summary>
    private Fractal ApplyOptions(ParsedFractal parsed, Fractal joined)
    {
        var description = joined.Description with { Composition = _options.Composition ?? joined.Description.Composition };
        if (_options.Depth is { } depth && description.HasDepth)
        {
            description = description.WithDepth(depth);
        }

        if (FractalCheck.FindCompositionFault(description) is { } fault)
        {
            throw parsed.Source.Error(parsed.ResultOffset, fault);
        }

        var fractal = description == joined.Description ? joined
            : new(description, joined.BaseMeshes) { BaseMeshPaths = joined.BaseMeshPaths };
        fractal = _options.Seed is { } seed ? fractal.WithSeed(seed) : fractal;
        return FractalCheck.FindBoundsFault(fractal) is not { } boundsFault ? fractal
            : throw parsed.Source.Error(parsed.ResultOffset, boundsFault, isLimitExceeded: !description.IsInfinite);
    }

    private MeshContents ReadMesh(string fullPath, string displayName, bool keepsInstances = false)
    {
        if (_options.ShareModels && _meshes.TryGetValue((fullPath, keepsInstances), out var cached))
        {
            Record.AddRange(cached.Files);
            return cached;
        }

        var filesBefore = Record.Position;
        var bytesBefore = StorageBytes;
        var parsed = ReadOrFindMesh(fullPath, displayName, keepsInstances);
        _textBytes += parsed.ByteCount;
        Warnings.AddRange(parsed.Warnings);
        if (parsed.Mesh.FaceCount == 0 && parsed.Instances.IsEmpty)
        {
            Warnings.Add(new(displayName, 1, 1, DiagnosticSeverity.Warning, "the file has no faces, so nothing of it is drawn"));
        }

        var materials = parsed.Materials is { } own ? _materials.WithUsableImages(own, displayName) : _materials.Load(parsed, fullPath);
        return _meshes[(fullPath, keepsInstances)] = new(parsed, materials, StorageBytes - bytesBefore, Record.Since(filesBefore));
    }

    private ParsedFractal ReadOrFindFractal(string fullPath, string displayName)
    {
        var stamp = Record.Add(fullPath);
        var bytesBefore = _textBytes;
        // What is parsed depends on the values, which may change.
        var parsed = EditedText(fullPath) is null && Values.IsEmpty ? AssetCache.ReadOrFind(_cache, fullPath, stamp, Read) : Read();
        _textBytes = bytesBefore + parsed.Source.ByteCount;
        return parsed;

        ParsedFractal Read() =>
            FractalParser.Parse(ReadText(fullPath, displayName, ParsingLimits.DescriptionBytes.Value), Values);
    }

    private ParsedObj ReadOrFindMesh(string fullPath, string displayName, bool keepsInstances)
    {
        var stamp = Record.Add(fullPath);
        // What a .gltf names may change without it, and a .glb is another thing with its instances.
        return keepsInstances || fullPath.EndsWith(".gltf", StringComparison.OrdinalIgnoreCase)
            ? Read() : AssetCache.ReadOrFind(_cache, fullPath, stamp, Read);

        ParsedObj Read()
        {
            var progress = _progress is null ? null : new FileProgress(displayName, _progress);
            var parsed = MeshReader.Read(fullPath, displayName, progress, _references, keepsInstances);
            _cache?.ReadCount += 1;
            return parsed;
        }
    }

    /// <summary>Reads a text, or takes the one that the options have in its place.</summary>
    /// <exception cref="SourceException">The file can't be read.</exception>
    public SourceText ReadText(string fullPath, string displayName, long maxBytes)
    {
        Record.Add(fullPath);
        var source = _options.Text is { } text && fullPath == _fullPath ? text
            : EditedText(fullPath) is { } edited ? new(displayName, edited)
            : SourceText.Read(fullPath, displayName, maxBytes);
        _textBytes += source.ByteCount;
        _cache?.ReadCount += 1;
        return source;
    }

    private string? EditedText(string fullPath) => _options.EditedTexts.GetValueOrDefault(fullPath);

    /// <summary>What stands for a base mesh.</summary>
    /// <param name="Key">Full path, or name of the shape.</param>
    /// <param name="Fractal">The mesh, or what another file makes of its own base meshes.</param>
    /// <param name="Materials">The materials of each base mesh.</param>
    /// <param name="ByteCount">Bytes of all files.</param>
    /// <param name="NumberNames">Names of the numbers that can be set.</param>
    private sealed record LoadedBase(
        string Key, Fractal Fractal, ImmutableArray<ImmutableDictionary<string, Material>> Materials, long ByteCount,
        ImmutableArray<string> NumberNames)
    {
        /// <summary>The files of another fractal, with their stamps.</summary>
        public ImmutableDictionary<string, FileStamp> Files { get; init; } = ImmutableDictionary<string, FileStamp>.Empty;
    }

    private sealed record MeshContents(
        ParsedObj Parsed, ImmutableDictionary<string, Material> Materials, long ByteCount, ImmutableDictionary<string, FileStamp> Files);

    private sealed class FileProgress(string file, IProgress<LoadProgress> progress) : IProgress<double>
    {
        public void Report(double value) => progress.Report(new(file, value));
    }
}
