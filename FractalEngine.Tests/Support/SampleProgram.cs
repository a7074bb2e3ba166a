namespace FractalEngine.Tests.Support;

/// <summary>Reads a program in samples/: directives, code, and what it says that it prints.</summary>
/// <param name="name">Name of its file.</param>
internal sealed class SampleProgram(string name)
{
    private const string OutputHeading = "// Output:";

    /// <summary>Names of all programs, in order.</summary>
    public static IEnumerable<string> Names =>
        Directory.GetFiles(Repository.Full("samples"), "*.cs").Select(file => Path.GetFileName(file)).Order(StringComparer.Ordinal);

    /// <summary>Full path of the file.</summary>
    public string File { get; } = Repository.Full("samples/" + name);

    /// <summary>All lines of the file.</summary>
    public string[] Lines { get; } = System.IO.File.ReadAllLines(Repository.Full("samples/" + name));

    /// <summary>The lines without the directives of `dotnet run`, such as a project compiles.</summary>
    public IEnumerable<string> Code => Lines.Where(line => !line.StartsWith("#:", StringComparison.Ordinal));

    /// <summary>The lines that the program says it prints.</summary>
    public string[] ExpectedOutput =>
        [.. Lines.SkipWhile(line => line != OutputHeading).Skip(1).Select(line => line.Length > 3 ? line[3..].TrimEnd() : "")];

    /// <summary>Splits what a program printed into lines like <see cref="ExpectedOutput"/>.</summary>
    /// <param name="output">Standard output.</param>
    public static IEnumerable<string> SplitOutput(string output) => output.TrimEnd().Split('\n').Select(line => line.TrimEnd());
}
