using System.Text.RegularExpressions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>Names, summaries and lines as CONTRIBUTING.md asks for them.</summary>
public partial class WordsTests
{
    private const int MaxCodeColumns = 140;
    private const int MaxDocsColumns = 120;
    private const int MinSummaryWords = 4;

    /// <summary>All C# files of the checkout, by their paths relative to it.</summary>
    private static readonly (string Name, string Text)[] Code =
    [
        .. Directory.EnumerateFiles(Repository.Root, "*.cs", SearchOption.AllDirectories)
            .Select(file => Path.GetRelativePath(Repository.Root, file).Replace('\\', '/'))
            .Where(name => !BuiltFolder().IsMatch(name))
            .Order(StringComparer.Ordinal)
            .Select(name => (name, File.ReadAllText(Repository.Full(name)))),
    ];

    [Fact]
    public void Code_IsFound() => Assert.True(Code.Length > 400, $"only {Code.Length} files");

    [Fact]
    public void Summaries_SaySomethingAlone()
    {
        var summaries = Code.Where(file => !file.Name.StartsWith("FractalEngine.Tests/", StringComparison.Ordinal))
            .SelectMany(file => Summary().Matches(file.Text).Select(match => (file.Name, Text: Words(match.Groups[1].Value)))).ToArray();
        Assert.True(summaries.Length > 2000, $"only {summaries.Length} summaries");
        var fragments = summaries.Where(summary => summary.Text.Length < MinSummaryWords)
            .Select(summary => $"{summary.Name}: {string.Join(' ', summary.Text)}");
        Assert.Empty(fragments);
    }

    [Fact]
    public void Lines_OfCode_EndWithin140Columns() => Assert.Empty(LongLines(Code, MaxCodeColumns));

    [Fact]
    public void Lines_OfDocs_EndWithin120Columns()
    {
        var pages = Directory.EnumerateFiles(Repository.Root, "*.md", SearchOption.AllDirectories)
            .Select(file => Path.GetRelativePath(Repository.Root, file).Replace('\\', '/'))
            // Pages of docs/api are made from signatures, which stay whole.
            .Where(name => !BuiltFolder().IsMatch(name) && !name.StartsWith("docs/api/", StringComparison.Ordinal))
            .Select(name => (name, File.ReadAllText(Repository.Full(name)))).ToArray();
        Assert.True(pages.Length > 15, $"only {pages.Length} pages");
        var longLines = LongLines(pages, MaxDocsColumns).Where(line => !line.Text.StartsWith('|')).ToArray();
        Assert.Empty(longLines);
    }

    [Fact]
    public void RetiredIdentifiers_AreNotInCode()
    {
        var retired = RetiredIdentifiers();
        Assert.True(retired.Count > 100, $"only {retired.Count} retired identifiers");
        Assert.Empty(from file in Code
                     from Match match in Identifier().Matches(file.Text)
                     where retired.Contains(match.Value)
                     select $"{file.Name}: {match.Value}");
    }

    private static HashSet<string> RetiredIdentifiers()
    {
        var glossary = File.ReadAllText(Repository.Full("docs/glossary.md"));
        var list = glossary[glossary.IndexOf("## Retired identifiers", StringComparison.Ordinal)..];
        return [.. Quoted().Matches(list).Select(match => match.Groups[1].Value)];
    }

    private static IEnumerable<(string Name, int Line, string Text)> LongLines(IEnumerable<(string Name, string Text)> files, int columns) =>
        from file in files
        from line in file.Text.Split('\n').Select((text, index) => (Text: text.TrimEnd('\r'), Number: index + 1))
        where line.Text.Length > columns
        select (file.Name, line.Number, line.Text);

    /// <summary>The words of a summary; a reference counts as one.</summary>
    private static string[] Words(string summary) =>
        [.. Tag().Replace(Margin().Replace(summary, " "), match => match.Value.StartsWith("</", StringComparison.Ordinal) ? "" : " x ")
            .Split((char[]?)null, StringSplitOptions.RemoveEmptyEntries).Where(word => word.Any(char.IsLetterOrDigit))];

    [GeneratedRegex(@"(^|/)(bin|obj|out|\.git)/")]
    private static partial Regex BuiltFolder();

    [GeneratedRegex("<summary>(.*?)</summary>", RegexOptions.Singleline)]
    private static partial Regex Summary();

    [GeneratedRegex(@"\n\s*///")]
    private static partial Regex Margin();

    [GeneratedRegex("<[^>]*>")]
    private static partial Regex Tag();

    [GeneratedRegex(@"[A-Za-z_]\w*")]
    private static partial Regex Identifier();

    [GeneratedRegex(@"`(\w+)`")]
    private static partial Regex Quoted();
}
