using System.Collections.Immutable;
using FractalEngine.Core.Files;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>
/// Keeps what was read from files, so that loading again reads only those that have changed. Models whose files are unchanged are the
/// same objects as before. It belongs to one set of <see cref="LoadOptions"/>, of which only edited texts and values of numbers may
/// change, and serves one load at a time.
/// </summary>
public sealed class AssetCache
{
    // By the type of the contents as well: a mesh may name itself as its material file.
    private readonly Dictionary<(string Path, Type Type), (FileStamp Stamp, object Contents)> _contents = [];
    private readonly Dictionary<string, CachedModel> _models = [];

    /// <summary>
    /// All files that the last load looked at, by their full paths, as they were before it read them. Missing ones and searched folders
    /// are among them, also after a load that has failed.
    /// </summary>
    public ImmutableDictionary<string, FileStamp> Files { get; private set; } = ImmutableDictionary<string, FileStamp>.Empty;

    /// <summary>Number of files that the last load has read, and not taken from here.</summary>
    public int ReadCount { get; internal set; }

    /// <summary>Returns the contents of a file, which is read where there is no cache, or where it has changed.</summary>
    internal static T ReadOrFind<T>(AssetCache? cache, string path, FileStamp stamp, Func<T> read)
        where T : class
    {
        if (cache is not null && cache._contents.TryGetValue((path, typeof(T)), out var known) && known.Stamp == stamp)
        {
            return (T)known.Contents;
        }

        var contents = read();
        cache?._contents[(path, typeof(T))] = (stamp, contents);
        return contents;
    }

    /// <summary>Returns a model of which no file, edited text or value has changed; null for one that must be made again.</summary>
    internal CachedModel? FindModel(string path, string? editedText, ImmutableDictionary<string, double> values) =>
        _models.TryGetValue(path, out var cached) && ReferenceEquals(cached.EditedText, editedText) && cached.HasValues(values)
        && cached.Files.All(static file => FileStamp.Of(file.Key) == file.Value) ? cached : null;

    internal void Store(string path, CachedModel model) => _models[path] = model;

    /// <summary>Ends a load. After a successful one, what it did not need is dropped.</summary>
    internal void Finish(ImmutableDictionary<string, FileStamp> files, bool isSuccessful)
    {
        Files = files;
        if (isSuccessful)
        {
            Drop(_contents, key => files.ContainsKey(key.Path));
            Drop(_models, files.ContainsKey);
        }
    }

    private static void Drop<TKey, TValue>(Dictionary<TKey, TValue> entries, Func<TKey, bool> isNeeded)
        where TKey : notnull
    {
        // A dictionary may lose entries while it is looked through.
        foreach (var key in entries.Keys)
        {
            if (!isNeeded(key))
            {
                entries.Remove(key);
            }
        }
    }

    /// <summary>A model with all files that it depends on.</summary>
    /// <param name="Model">The model.</param>
    /// <param name="Files">The stamps of the files before they were read.</param>
    /// <param name="Warnings">The warnings about the files.</param>
    /// <param name="StorageBytes">Size of the files that were read, in bytes.</param>
    /// <param name="EditedText">The text in place of the model's own file; null where that was read.</param>
    /// <param name="Values">Values of named numbers that it was made with.</param>
    internal sealed record CachedModel(
        Model Model, ImmutableDictionary<string, FileStamp> Files, ImmutableArray<Diagnostic> Warnings, long StorageBytes,
        string? EditedText, ImmutableDictionary<string, double> Values)
    {
        /// <summary>Tells whether it would be the same with other values: none of its own numbers has another one.</summary>
        public bool HasValues(ImmutableDictionary<string, double> values) => Model is not FractalModel fractal
            || fractal.NumberNames.All(name => Find(values, name).Equals(Find(Values, name)));

        private static double? Find(ImmutableDictionary<string, double> values, string name) =>
            values.TryGetValue(name, out var value) ? value : null;
    }
}
