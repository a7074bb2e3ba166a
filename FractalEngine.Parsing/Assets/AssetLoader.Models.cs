using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <content>Loads meshes and fractals, each file once.</content>
public sealed partial class AssetLoader
{
    private Model LoadReferenced(SourceText source, int offset, string file)
    {
        if (_options.ShareModels && _namedModels.TryGetValue(file, out var named))
        {
            return named;
        }

        var (fullPath, displayName) = _references.Resolve(source, offset, _fullPath, file);
        if (_options.ShareModels && _models.TryGetValue(fullPath, out var cached))
        {
            return _namedModels[file] = cached;
        }

        if (_faults.TryGetValue(fullPath, out var fault))
        {
            throw new SourceException(fault);
        }

        try
        {
            return _namedModels[file] = _models[fullPath] = LoadModel(fullPath, displayName, FileKinds.FromName(fullPath));
        }
        catch (SourceException exception)
        {
            _faults[fullPath] = exception.Diagnostic;
            throw;
        }
    }

    /// <summary>Loads a model, or takes it from the cache if none of its files has changed.</summary>
    private Model LoadModel(string fullPath, string displayName, FileKind? kind)
    {
        if (_cache?.FindModel(fullPath, EditedText(fullPath)) is { } cached)
        {
            _record.AddRange(cached.Files);
            _warnings.AddRange(cached.Warnings);
            _textBytes += cached.StorageBytes;
            return cached.Model;
        }

        var filesBefore = _record.Position;
        var warningsBefore = _warnings.Count;
        var bytesBefore = StorageBytes;
        Model model = kind == FileKind.Fractal ? LoadFractal(fullPath, displayName) : LoadMesh(fullPath, displayName);
        _cache?.Store(fullPath, new(
            model, _record.Since(filesBefore), [.. _warnings.Skip(warningsBefore)], StorageBytes - bytesBefore, EditedText(fullPath)));
        return model;
    }

    private MeshModel LoadMesh(string fullPath, string displayName)
    {
        var contents = ReadMesh(fullPath, displayName);
        return new(contents.Mesh) { SourcePath = fullPath, FileBytes = contents.ByteCount, Materials = contents.Materials };
    }

    private FractalModel LoadFractal(string fullPath, string displayName)
    {
        var parsed = ReadOrFindFractal(fullPath, displayName);
        _warnings.AddRange(parsed.Warnings);
        var (basePath, baseDisplayName) = _references.Resolve(parsed.Source, parsed.BaseFileNameOffset, fullPath, parsed.BaseFile);
        var description = ApplyOptions(parsed);
        var contents = ReadMesh(basePath, baseDisplayName);
        var fractal = new Fractal(description, contents.Mesh) { BaseMeshPath = basePath };
        if (FractalCheck.FindBoundsFault(fractal) is { } fault)
        {
            throw parsed.Source.Error(parsed.ResultOffset, fault, isLimitExceeded: !description.IsInfinite);
        }

        var byteCount = parsed.Source.ByteCount + contents.ByteCount;
        return new(fractal) { SourcePath = fullPath, FileBytes = byteCount, Materials = contents.Materials };
    }

    /// <summary>Returns the description in a file with the overrides of the options.</summary>
    private FractalDescription ApplyOptions(ParsedFractal parsed)
    {
        var description = parsed.Description with { Composition = _options.Composition ?? parsed.Description.Composition };
        if (_options.Depth is { } depth && description.HasDepth)
        {
            description = description.WithDepth(depth);
        }

        return FractalCheck.IsComposable(description)
            ? description
            : throw parsed.Source.Error(parsed.ResultOffset, FractalCheck.NotComposableMessage);
    }

    private MeshContents ReadMesh(string fullPath, string displayName)
    {
        if (_options.ShareModels && _meshes.TryGetValue(fullPath, out var cached))
        {
            _record.AddRange(cached.Files);
            return cached;
        }

        var filesBefore = _record.Position;
        var bytesBefore = StorageBytes;
        var parsed = ReadOrFindMesh(fullPath, displayName);
        _textBytes += parsed.ByteCount;
        _warnings.AddRange(parsed.Warnings);
        if (parsed.Mesh.FaceCount == 0)
        {
            _warnings.Add(new(displayName, 1, 1, DiagnosticSeverity.Warning, "the file has no faces, so nothing of it is drawn"));
        }

        var materials = _materials.Load(parsed, fullPath);
        return _meshes[fullPath] = new(parsed.Mesh, materials, StorageBytes - bytesBefore, _record.Since(filesBefore));
    }

    private ParsedFractal ReadOrFindFractal(string fullPath, string displayName)
    {
        var stamp = _record.Add(fullPath);
        var bytesBefore = _textBytes;
        var parsed = EditedText(fullPath) is null ? AssetCache.ReadOrFind(_cache, fullPath, stamp, Read) : Read();
        _textBytes = bytesBefore + parsed.Source.ByteCount;
        return parsed;

        ParsedFractal Read() => FractalParser.Parse(ReadText(fullPath, displayName, ParsingLimits.MaxDescriptionBytes));
    }

    private ParsedObj ReadOrFindMesh(string fullPath, string displayName) =>
        AssetCache.ReadOrFind(_cache, fullPath, _record.Add(fullPath), () =>
        {
            var parsed = MeshReader.Read(fullPath, displayName, _progress is null ? null : new FileProgress(displayName, _progress));
            _cache?.ReadCount += 1;
            return parsed;
        });

    private SourceText ReadText(string fullPath, string displayName, long maxBytes)
    {
        _record.Add(fullPath);
        var source = _options.Text is { } text && fullPath == _fullPath ? text
            : EditedText(fullPath) is { } edited ? new(displayName, edited)
            : SourceText.Read(fullPath, displayName, maxBytes);
        _textBytes += source.ByteCount;
        _cache?.ReadCount += 1;
        return source;
    }
}
