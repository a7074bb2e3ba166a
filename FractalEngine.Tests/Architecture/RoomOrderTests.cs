using System.Text.RegularExpressions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Architecture;

/// <summary>
/// Tests that the rooms (folders) of an assembly form an order: each names only types of rooms before it. docs/architecture.md lists them
/// in that order, with what each holds.
/// </summary>
public partial class RoomOrderTests
{
    private static readonly string Page = File.ReadAllText(Repository.Full("docs/architecture.md"));

    /// <summary>The assemblies that the engine consists of.</summary>
    public static TheoryData<string> Projects => ["Core", "Parsing", "Render", "App"];

    [Theory]
    [MemberData(nameof(Projects))]
    public void Rooms_OfAnAssembly_AreItsFolders(string project) => Assert.Equal(
        Sources(project).Select(source => source.Room).Distinct().Order(StringComparer.Ordinal),
        ListedRooms(project).Order(StringComparer.Ordinal));

    [Theory]
    [MemberData(nameof(Projects))]
    public void Rooms_OfAnAssembly_NameOnlyTypesOfRoomsBeforeThem(string project)
    {
        var order = ListedRooms(project);
        var sources = Sources(project);
        var definitions = sources.SelectMany(source => source.Definitions).ToLookup(definition => definition.Name);
        var offences =
            from source in sources
            from use in source.Uses
                // A name that several rooms define says nothing: it may be any of these.
            where definitions[use.Name].Select(definition => definition.Room).Distinct().Count() == 1
            let definition = definitions[use.Name].First()
            where Array.IndexOf(order, definition.Room) > Array.IndexOf(order, source.Room)
            select $"{source.Path}:{use.Line} names {use.Name} of the later room {definition.Room}, {definition.Path}:{definition.Line}";
        Assert.Empty(offences);
    }

    /// <summary>Returns the rooms of an assembly in the order of the page; its root is called by the assembly's name.</summary>
    private static string[] ListedRooms(string project)
    {
        var section = Page[Page.IndexOf($"### {project}\n", StringComparison.Ordinal)..].Split("\n#", 2)[0];
        return [.. Row().Matches(section).Select(match => match.Groups[1].Value)];
    }

    private static Source[] Sources(string project)
    {
        var root = Repository.Full($"FractalEngine.{project}");
        return
        [
            .. Directory.EnumerateFiles(root, "*.cs", SearchOption.AllDirectories)
                .Select(file => Path.GetRelativePath(root, file).Replace('\\', '/'))
                .Where(path => path.Split('/')[0] is not ("bin" or "obj"))
                .Order(StringComparer.Ordinal)
                .Select(path => Read(project, path)),
        ];
    }

    private static Source Read(string project, string path)
    {
        var folder = Path.GetDirectoryName(path)!.Replace('\\', '/');
        var room = folder == "" ? project : folder;
        var file = $"FractalEngine.{project}/{path}";
        var definitions = new List<Definition>();
        var uses = new List<(string Name, int Line)>();
        var lines = File.ReadAllLines(Repository.Full(file));
        for (var i = 0; i < lines.Length; i++)
        {
            // Comments and texts name nothing.
            var line = Text().Replace(Comment().Replace(lines[i], ""), "\"\"");
            if (TypeDefinition().Match(line) is { Success: true } match)
            {
                definitions.Add(new(match.Groups[1].Value, room, file, i + 1));
            }

            uses.AddRange(TypeName().Matches(line).Select(name => (name.Value, i + 1)));
        }

        return new(room, file, definitions, uses);
    }

    // Types at the top level only: those within others are part of them.
    [GeneratedRegex(@"^(?:[a-z]+ )*(?:class|struct|interface|enum|record(?: class| struct)?|delegate \S+) ([A-Z]\w+)")]
    private static partial Regex TypeDefinition();

    [GeneratedRegex(@"(?<![.\w])[A-Z]\w+\b")]
    private static partial Regex TypeName();

    [GeneratedRegex("(?<!:)//.*")]
    private static partial Regex Comment();

    [GeneratedRegex(@"""(\\.|[^""\\])*""")]
    private static partial Regex Text();

    [GeneratedRegex(@"^\| `([^`]+)` \|", RegexOptions.Multiline)]
    private static partial Regex Row();

    private sealed record Definition(string Name, string Room, string Path, int Line);

    private sealed record Source(string Room, string Path, List<Definition> Definitions, List<(string Name, int Line)> Uses);
}
