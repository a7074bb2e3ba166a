using System.Text.RegularExpressions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>Tests that every page links only to files and folders that exist.</summary>
public partial class PageLinkTests
{
    public static TheoryData<string> Pages
    {
        get
        {
            var files = Directory.GetFiles(Repository.Full("docs"), "*.md", SearchOption.AllDirectories)
                .Concat(Directory.GetFiles(Repository.Root, "*.md"))
                .Append(Repository.Full("assets/README.md"))
                .Append(Repository.Full("FractalEngine.Benchmarks/README.md"));
            return [.. files.Select(file => Path.GetRelativePath(Repository.Root, file)).Order(StringComparer.Ordinal)];
        }
    }

    [Theory]
    [MemberData(nameof(Pages))]
    public void Page_LinksToWhatExists(string page)
    {
        var folder = Path.GetDirectoryName(Repository.Full(page))!;
        var links = Link().Matches(File.ReadAllText(Repository.Full(page))).Select(match => match.Groups[1].Value)
            .Where(link => !link.Contains("://", StringComparison.Ordinal));
        Assert.All(links, link => Assert.True(Path.Exists(Path.GetFullPath(link, folder)), $"{page} links to {link}"));
    }

    /// <summary>Matches a link's target, which is in brackets behind a text in square ones, up to the name of a heading.</summary>
    [GeneratedRegex(@"\]\(([^)#\s]+)(?:#[^)]*)?\)")]
    private static partial Regex Link();
}
