using System.Diagnostics;
using System.Security.Cryptography;
using System.Text;

namespace FractalEngine.Mutants;

/// <summary>
/// The folder outside the checkout in which everything happens: copies of the checkout, what was recorded, and results. It stays, so
/// that a second run is cheap.
/// </summary>
internal sealed class Workspace
{
    private readonly string _root;
    private readonly SortedDictionary<string, byte[]> _files = new(StringComparer.Ordinal);

    /// <summary>Reads all files of the checkout.</summary>
    public Workspace(string root)
    {
        _root = root;
        Common = Path.Combine(Path.GetTempPath(), $"fractal-engine-mutants-{Environment.UserName}");
        Folder = Path.Combine(Common, Hashing.Hex(root, 12));
        Directory.CreateDirectory(Folder);
        foreach (string name in Names())
        {
            string path = Path.Combine(root, name);
            if (File.Exists(path))
            {
                _files[name] = File.ReadAllBytes(path);
            }
        }

        Hash = HashOf(_ => true);
        TestedHash = HashOf(name => !name.StartsWith("eng/", StringComparison.Ordinal) && !name.EndsWith(".md", StringComparison.Ordinal)
            && name != "test.sh");
        Sources = _files.Where(file => file.Key.EndsWith(".cs", StringComparison.Ordinal)
                && (file.Key.StartsWith("FractalEngine.Core/", StringComparison.Ordinal)
                    || file.Key.StartsWith("FractalEngine.Parsing/", StringComparison.Ordinal)
                    || file.Key.StartsWith("FractalEngine.Render/", StringComparison.Ordinal)
                    || file.Key.StartsWith("FractalEngine.App/", StringComparison.Ordinal)))
            .ToDictionary(file => file.Key, file => Encoding.UTF8.GetString(file.Value).TrimStart('\ufeff'));
    }

    /// <summary>The folder of all checkouts of this user.</summary>
    public string Common { get; }

    /// <summary>The folder of this checkout.</summary>
    public string Folder { get; }

    /// <summary>Hash of all files.</summary>
    public string Hash { get; }

    /// <summary>Hash of the files that what was recorded depends on: pages and scripts may change meanwhile.</summary>
    public string TestedHash { get; }

    /// <summary>The C# files of the product, by their paths.</summary>
    public IReadOnlyDictionary<string, string> Sources { get; }

    /// <summary>Text of a file of the checkout.</summary>
    public string Text(string name) => Encoding.UTF8.GetString(_files[name]);

    /// <summary>Makes a copy of the checkout, or brings it up to date. What didn't change isn't touched: builds are short.</summary>
    /// <param name="tree">Folder of the copy.</param>
    /// <param name="instrumented">Files that differ from the checkout's.</param>
    public void Copy(string tree, IReadOnlyDictionary<string, string> instrumented)
    {
        var wanted = new Dictionary<string, byte[]>(_files);
        foreach (var (name, text) in instrumented)
        {
            wanted[name] = Encoding.UTF8.GetBytes(text);
        }

        if (Directory.Exists(tree))
        {
            foreach (string path in Directory.EnumerateFiles(tree, "*", SearchOption.AllDirectories))
            {
                string name = Path.GetRelativePath(tree, path);
                if (!wanted.ContainsKey(name) && !IsBuilt(name))
                {
                    File.Delete(path);
                }
            }
        }

        foreach (var (name, bytes) in wanted)
        {
            string path = Path.Combine(tree, name);
            if (!File.Exists(path) || !File.ReadAllBytes(path).AsSpan().SequenceEqual(bytes))
            {
                Directory.CreateDirectory(Path.GetDirectoryName(path)!);
                File.WriteAllBytes(path, bytes);
                if (OperatingSystem.IsLinux() && name.EndsWith(".sh", StringComparison.Ordinal))
                {
                    File.SetUnixFileMode(path, (UnixFileMode)0b111_101_101);
                }
            }
        }
    }

    private string HashOf(Func<string, bool> isCounted) => Hashing.Hex(
        string.Join("\n", _files.Where(file => isCounted(file.Key))
            .Select(file => $"{file.Key} {Convert.ToHexString(SHA256.HashData(file.Value))}")),
        16);

    private static bool IsBuilt(string name) => name.Split('/').Any(part => part is "bin" or "obj" or ".git");

    private IEnumerable<string> Names()
    {
        var start = new ProcessStartInfo("git", ["-C", _root, "ls-files", "-co", "--exclude-standard"]) { RedirectStandardOutput = true };
        if (Path.Exists(Path.Combine(_root, ".git")))
        {
            using var git = Process.Start(start)!;
            string output = git.StandardOutput.ReadToEnd();
            git.WaitForExit();
            return output.Split('\n', StringSplitOptions.RemoveEmptyEntries);
        }

        return Directory.EnumerateFiles(_root, "*", SearchOption.AllDirectories).Select(path => Path.GetRelativePath(_root, path))
            .Where(name => !IsBuilt(name));
    }
}
