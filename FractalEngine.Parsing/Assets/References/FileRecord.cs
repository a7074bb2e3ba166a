using System.Collections.Immutable;
using FractalEngine.Core.Files;

namespace FractalEngine.Parsing.Assets.References;

/// <summary>Records the files that a load looks at, and what they were before, so that each part of it knows its own files.</summary>
internal sealed class FileRecord
{
    private readonly Dictionary<string, FileStamp> _stamps = [];
    private readonly List<string> _paths = [];

    /// <summary>All files so far.</summary>
    public ImmutableDictionary<string, FileStamp> All => _stamps.ToImmutableDictionary();

    /// <summary>A mark for <see cref="Since"/>.</summary>
    public int Position => _paths.Count;

    /// <summary>Records a file before it is read or found missing.</summary>
    /// <param name="path">Full path of the file, or of a folder that is searched.</param>
    /// <returns>Its stamp at the first time.</returns>
    public FileStamp Add(string path)
    {
        _paths.Add(path);
        return _stamps.TryGetValue(path, out var known) ? known : _stamps[path] = FileStamp.Of(path);
    }

    /// <summary>Records the files of something that is not loaded again.</summary>
    public void AddRange(ImmutableDictionary<string, FileStamp> files)
    {
        foreach (var (path, stamp) in files)
        {
            _paths.Add(path);
            _stamps.TryAdd(path, stamp);
        }
    }

    /// <summary>Returns the files that were recorded since a position.</summary>
    public ImmutableDictionary<string, FileStamp> Since(int position) =>
        _paths.Skip(position).Distinct().ToImmutableDictionary(static path => path, path => _stamps[path]);
}
