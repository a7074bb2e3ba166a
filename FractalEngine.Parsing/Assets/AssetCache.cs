using System.Collections.Immutable;
using FractalEngine.Core.Files;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Fractals;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>
/// Keeps what was read from files, so that loading again reads only those that have changed. Models whose files are unchanged are the
/// same objects as before. It belongs to one set of <see cref="LoadOptions"/>, of which only edited texts may change, and serves one
/// load at a time.
/// </summary>
public sealed class AssetCache
{
    private readonly Dictionary<string, (FileStamp Stamp, ParsedObj Contents)> _meshes = [];
    private readonly Dictionary<string, (FileStamp Stamp, ParsedMtl Contents)> _materials = [];
    private readonly Dictionary<string, (FileStamp Stamp, ParsedFractal Contents)> _fractals = [];
    private readonly Dictionary<string, CachedModel> _models = [];

    /// <summary>
    /// All files that the last load looked at, by their full paths, as they were before it read them. Missing ones and searched folders
    /// are among them, also after a load that has failed.
    /// </summary>
    public ImmutableDictionary<string, FileStamp> Files { get; private set; } = ImmutableDictionary<string, FileStamp>.Empty;

    /// <summary>Number of files that the last load has read, and not taken from here.</summary>
    public int ReadCount { get; internal set; }

    /// <summary>Returns the contents of an unchanged mesh file; null for one that must be read.</summary>
    internal ParsedObj? FindMesh(string path, FileStamp stamp) => Find(_meshes, path, stamp);

    /// <summary>Returns the contents of an unchanged material file; null for one that must be read.</summary>
    internal ParsedMtl? FindMaterials(string path, FileStamp stamp) => Find(_materials, path, stamp);

    /// <summary>Returns the contents of an unchanged fractal file; null for one that must be read.</summary>
    internal ParsedFractal? FindFractal(string path, FileStamp stamp) => Find(_fractals, path, stamp);

    /// <summary>Returns a model of which no file and no edited text has changed; null for one that must be made again.</summary>
    internal CachedModel? FindModel(string path, string? editedText) =>
        _models.TryGetValue(path, out var cached) && ReferenceEquals(cached.EditedText, editedText)
        && cached.Files.All(static file => FileStamp.Of(file.Key) == file.Value) ? cached : null;

    internal void Store(string path, FileStamp stamp, ParsedObj contents) => _meshes[path] = (stamp, contents);

    internal void Store(string path, FileStamp stamp, ParsedMtl contents) => _materials[path] = (stamp, contents);

    internal void Store(string path, FileStamp stamp, ParsedFractal contents) => _fractals[path] = (stamp, contents);

    internal void Store(string path, CachedModel model) => _models[path] = model;

    /// <summary>Ends a load. After a successful one, what it did not need is dropped.</summary>
    internal void Finish(ImmutableDictionary<string, FileStamp> files, bool isSuccessful)
    {
        Files = files;
        if (isSuccessful)
        {
            Drop(_meshes, files);
            Drop(_materials, files);
            Drop(_fractals, files);
            Drop(_models, files);
        }
    }

    private static T? Find<T>(Dictionary<string, (FileStamp Stamp, T Contents)> entries, string path, FileStamp stamp)
        where T : class => entries.TryGetValue(path, out var entry) && entry.Stamp == stamp ? entry.Contents : null;

    private static void Drop<T>(Dictionary<string, T> entries, ImmutableDictionary<string, FileStamp> files)
    {
        foreach (var path in entries.Keys.Where(path => !files.ContainsKey(path)).ToArray())
        {
            entries.Remove(path);
        }
    }

    /// <summary>A model with all files that it depends on.</summary>
    /// <param name="Model">The model.</param>
    /// <param name="Files">The stamps of the files before they were read.</param>
    /// <param name="Warnings">The warnings about the files.</param>
    /// <param name="StorageBytes">Size of the files that were read, in bytes.</param>
    /// <param name="EditedText">The text in place of the model's own file; null where that was read.</param>
    internal sealed record CachedModel(
        Model Model, ImmutableDictionary<string, FileStamp> Files, ImmutableArray<Diagnostic> Warnings, long StorageBytes,
        string? EditedText);
}
