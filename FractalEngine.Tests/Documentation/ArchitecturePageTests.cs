using System.Text.RegularExpressions;
using FractalEngine.Core.Colliders;
using FractalEngine.Parsing.Text.Grammar;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>Compares the diagrams of docs/architecture.md with the code.</summary>
public partial class ArchitecturePageTests
{
    private static readonly string[] Projects = ["App", "Core", "Parsing", "Render"];

    private static readonly string Page = File.ReadAllText(Repository.Full("docs/architecture.md"));

    [Fact]
    public void Assemblies_AreThoseOfTheProjects() => Assert.Equal(
        Projects.SelectMany(project => Reference()
            .Matches(File.ReadAllText(Repository.Full($"FractalEngine.{project}/FractalEngine.{project}.csproj")))
            .Select(match => $"{project} --> {match.Groups[1].Value}")).Order(StringComparer.Ordinal),
        Arrow().Matches(Page).Select(match => match.Value).Order(StringComparer.Ordinal));

    [Theory]
    [InlineData("Colliders", typeof(Collider))]
    [InlineData("Parsers", typeof(Parser))]
    public void Family_IsThatOfTheClasses(string heading, Type ancestor)
    {
        var section = Page[Page.IndexOf($"## {heading}", StringComparison.Ordinal)..];
        section = section.Split("\n## ")[0];
        var classes = ancestor.Assembly.GetTypes().Where(type => type.IsSubclassOf(ancestor))
            .Select(type => $"{type.BaseType!.Name} <|-- {type.Name}");
        Assert.Equal(
            classes.Order(StringComparer.Ordinal),
            Inheritance().Matches(section).Select(match => match.Value).Order(StringComparer.Ordinal));
    }

    [GeneratedRegex(@"<ProjectReference Include=""[^""]*FractalEngine\.(\w+)\.csproj""")]
    private static partial Regex Reference();

    [GeneratedRegex(@"\w+ --> \w+")]
    private static partial Regex Arrow();

    [GeneratedRegex(@"\w+ <\|-- \w+")]
    private static partial Regex Inheritance();
}
