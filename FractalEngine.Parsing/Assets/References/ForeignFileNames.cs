namespace FractalEngine.Parsing.Assets.References;

/// <summary>
/// Finds files by names that other programs wrote on other systems: with backslashes, quotes, another case or an absolute path.
/// </summary>
/// <remarks>
/// A name counts as it stands first, then with slashes and without quotes, then in any case, and at last without its folders, beside the
/// file that has the name. Where names differ only in case, the first in ordinal order is taken. Each folder is listed once. Nothing
/// outside the asset folder is found or listed.
/// </remarks>
/// <param name="isAllowed">Tells whether a full path may be referred to.</param>
/// <param name="record">Receives the paths of all files that are looked for, and of the folders that are listed.</param>
internal sealed class ForeignFileNames(Func<string, bool> isAllowed, FileRecord record)
{
    // Actual names of the entries of each listed folder, by their names in any case.
    private readonly Dictionary<string, Dictionary<string, string>> _folders = [];

    /// <summary>Returns the full path of the file that a name means, or null.</summary>
    /// <param name="folder">Full path of the folder that the name is relative to.</param>
    /// <param name="name">Name as written.</param>
    public string? Find(string folder, string name)
    {
        if (FindExact(folder, name) is { } exact)
        {
            return exact;
        }

        var plainName = RemoveQuotes(name).Replace('\\', '/').Trim();
        return plainName.Length == 0 ? null
            : (plainName == name ? null : FindExact(folder, plainName))
            ?? FindInAnyCase(folder, plainName)
            ?? FindInAnyCase(folder, plainName[(plainName.LastIndexOf('/') + 1)..]);
    }

    private static string RemoveQuotes(string name)
    {
        var trimmed = name.Trim();
        return trimmed is ['"', .., '"'] or ['\'', .., '\''] ? trimmed[1..^1] : trimmed;
    }

    private string? FindExact(string folder, string name)
    {
        // A name with a NUL character is none on any system.
        if (name.Contains('\0', StringComparison.Ordinal))
        {
            return null;
        }

        var path = Path.GetFullPath(Path.Combine(folder, name));
        if (!isAllowed(path))
        {
            return null;
        }

        record.Add(path);
        return File.Exists(path) ? path : null;
    }

    /// <summary>Finds a relative name segment by segment.</summary>
    private string? FindInAnyCase(string folder, string name)
    {
        if (name.Length == 0 || Path.IsPathRooted(name))
        {
            return null;
        }

        var path = folder;
        foreach (var segment in name.Split('/', StringSplitOptions.RemoveEmptyEntries))
        {
            if (segment is "." or "..")
            {
                path = Path.GetFullPath(Path.Combine(path, segment));
            }
            else if (ListFolder(path).TryGetValue(segment, out var entry))
            {
                path = Path.Combine(path, entry);
            }
            else
            {
                return null;
            }
        }

        return isAllowed(path) && File.Exists(path) ? path : null;
    }

    /// <summary>Returns the names in a folder by their names in any case; none if it can't be listed.</summary>
    private Dictionary<string, string> ListFolder(string folder)
    {
        var isKnown = _folders.TryGetValue(folder, out var cached);
        if (isAllowed(folder))
        {
            record.Add(folder);
        }

        if (isKnown)
        {
            return cached!;
        }

        var names = new Dictionary<string, string>(StringComparer.OrdinalIgnoreCase);
        if (isAllowed(folder) && Directory.Exists(folder))
        {
            try
            {
                foreach (var name in Directory.EnumerateFileSystemEntries(folder).Select(Path.GetFileName).Order(StringComparer.Ordinal))
                {
                    names.TryAdd(name!, name!);
                }
            }
            catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
            {
                // A folder that can't be listed has no other names than those that are written exactly.
            }
        }

        return _folders[folder] = names;
    }
}
