using System.Reflection.PortableExecutable;
using System.Text.Json;
using Microsoft.CodeAnalysis;
using Microsoft.CodeAnalysis.CSharp;
using Microsoft.CodeAnalysis.CSharp.Syntax;

namespace FractalEngine.Mutants;

/// <summary>Finds the mutants that don't compile, without a build.</summary>
internal sealed class Checker
{
    // What the SDK imports and grants, as the projects ask it to.
    private const string ImplicitUsings = """
        global using System;
        global using System.Collections.Generic;
        global using System.IO;
        global using System.Linq;
        global using System.Net.Http;
        global using System.Threading;
        global using System.Threading.Tasks;
        [assembly: System.Runtime.CompilerServices.InternalsVisibleTo("FractalEngine.Parsing")]
        [assembly: System.Runtime.CompilerServices.InternalsVisibleTo("FractalEngine.Render")]
        [assembly: System.Runtime.CompilerServices.InternalsVisibleTo("FractalEngine.App")]
        """;

    private static readonly string[] Projects =
        ["FractalEngine.Core", "FractalEngine.Parsing", "FractalEngine.Render", "FractalEngine.App"];
    private readonly IReadOnlyDictionary<string, string> _sources;
    private readonly Dictionary<string, (CSharpCompilation Compilation, Dictionary<string, SyntaxTree> Trees)> _projects = [];
    private readonly Dictionary<string, HashSet<string>> _known = [];

    /// <summary>Prepares the projects of the product.</summary>
    /// <param name="sources">All C# files of the product by their paths.</param>
    /// <param name="mutant">Text of the class that the copy asks for the living mutant.</param>
    /// <param name="tree">Restored copy, which knows where packages are.</param>
    public Checker(IReadOnlyDictionary<string, string> sources, string mutant, string tree)
    {
        _sources = sources;
        var references = References(tree);
        var parsed = sources.AsParallel().ToDictionary(source => source.Key, source => Parse(source.Key, source.Value));
        var options = new CSharpCompilationOptions(
            OutputKind.DynamicallyLinkedLibrary, allowUnsafe: true, nullableContextOptions: NullableContextOptions.Disable);
        foreach (string project in Projects)
        {
            var trees = parsed.Where(file => file.Key.StartsWith(project + "/", StringComparison.Ordinal)
                && !file.Key.EndsWith(".NuGet.cs", StringComparison.Ordinal)).ToDictionary();
            var compilation = CSharpCompilation.Create(
                project,
                [.. trees.Values, Parse("Mutant.cs", mutant), Parse("Usings.cs", ImplicitUsings)],
                [.. references, .. _projects.Values.Select(other => other.Compilation.ToMetadataReference())],
                options);
            _projects[project] = (compilation, trees);
        }
    }

    /// <summary>Replaces mutants until all compile, and gives them the forms in which they do.</summary>
    /// <returns>Number of mutants that don't compile.</returns>
    public int Settle(Draw draw)
    {
        int replaced = 0;
        var settled = new Dictionary<string, string>();
        while (true)
        {
            for (int i = 0; i < draw.Drawn.Count; i++)
            {
                draw.Drawn[i].Number = i;
            }

            // Numbers change when mutants are replaced; what matters is which stand in the file, and how.
            var wrong = draw.Drawn.GroupBy(mutation => mutation.Site.Path).AsParallel().Select(file => (file.Key, Mutations: file.ToList()))
                .Select(file => (file.Key, file.Mutations, Name: string.Join(' ', file.Mutations.Select(one => one.Id + one.Form))))
                .Where(file => settled.GetValueOrDefault(file.Key) != file.Name)
                .Select(file => (file.Key, file.Name, Wrong: FindWrong(file.Key, file.Mutations))).ToList();
            foreach (var file in wrong.Where(file => file.Wrong.Count == 0))
            {
                settled[file.Key] = file.Name;
            }

            var mutations = wrong.SelectMany(file => file.Wrong).ToHashSet();
            if (mutations.Count == 0)
            {
                return replaced;
            }

            // In the order of the draw, whatever the order of the diagnostics.
            foreach (var mutation in draw.Drawn.Where(mutations.Contains).ToList())
            {
                if (mutation.Form != Form.Body && mutation.Site.Body is not null)
                {
                    mutation.Form = Form.Body;
                }
                else
                {
                    draw.Replace(mutation);
                    replaced++;
                }
            }
        }
    }

    private static SyntaxTree Parse(string path, string text) => CSharpSyntaxTree.ParseText(text, Parsing.Options, path);

    private HashSet<Mutation> FindWrong(string path, List<Mutation> mutations)
    {
        var (text, placed) = Instrumenter.Write(_sources[path], mutations);
        var tree = Parse(path, text);
        HashSet<string> known;
        lock (_known)
        {
            if (!_known.TryGetValue(path, out known!))
            {
                _known[path] = known = [.. Errors(path, null).Select(Describe)];
            }
        }

        var wrong = new HashSet<Mutation>();
        foreach (var error in Errors(path, tree).Where(error => !known.Contains(Describe(error))))
        {
            var blamed = Blame(error, tree, placed);
            if (blamed.Count == 0)
            {
                throw new InvalidOperationException($"can't tell which mutant breaks {path}: {error}");
            }

            // Some errors stand at the member's name; then each is tried alone.
            wrong.UnionWith(blamed.Count == 1 || blamed.Exists(one => one.Form != Form.Body)
                ? blamed
                : blamed.Where(one => FindWrong(path, [one]).Count > 0));
        }

        return wrong;
    }

    private static string Describe(Diagnostic diagnostic) => $"{diagnostic.Id} {diagnostic.GetMessage()}";

    private IEnumerable<Diagnostic> Errors(string path, SyntaxTree? changed)
    {
        var (compilation, trees) = _projects[path[..path.IndexOf('/', StringComparison.Ordinal)]];
        var tree = trees[path];
        if (changed is not null)
        {
            compilation = compilation.ReplaceSyntaxTree(tree, changed);
            tree = changed;
        }

        return compilation.GetSemanticModel(tree).GetDiagnostics().Where(diagnostic => diagnostic.Severity == DiagnosticSeverity.Error);
    }

    private static List<Mutation> Blame(Diagnostic error, SyntaxTree tree, IReadOnlyList<Placed> placed)
    {
        var span = error.Location.SourceSpan;
        var changed = placed.Where(one => one.Changed.IntersectsWith(span)).ToList();
        if (changed.Count > 0)
        {
            return [changed.MinBy(one => one.Changed.Length)!.Mutation];
        }

        // A mutant in brackets can break what stands around it, up to the whole member. In its own body it can't.
        var around = placed.Where(one => one.Mutation.Form != Form.Body && one.Whole.Contains(span)).ToList();
        if (around.Count > 0)
        {
            return [around.MinBy(one => one.Whole.Length)!.Mutation];
        }

        var member = tree.GetRoot().FindNode(span).AncestorsAndSelf()
            .FirstOrDefault(node => node is BaseMethodDeclarationSyntax or BasePropertyDeclarationSyntax or BaseFieldDeclarationSyntax);
        var inMember = placed.Where(one => member is null || member.FullSpan.Contains(one.Whole)).ToList();
        var bracketed = inMember.Where(one => one.Mutation.Form != Form.Body).ToList();
        return [.. (bracketed.Count > 0 ? bracketed : inMember).Select(one => one.Mutation)];
    }

    private static bool IsManaged(string path)
    {
        using var stream = File.OpenRead(path);
        using var reader = new PEReader(stream);
        return reader.HasMetadata;
    }

    private static List<MetadataReference> References(string tree)
    {
        // As the SDK has them: the runtime's own lack the fields by which a variable of ImmutableArray can be unassigned.
        string runtime = Path.GetDirectoryName(typeof(object).Assembly.Location)!;
        string packs = Path.GetFullPath(Path.Combine(runtime, "../../../packs/Microsoft.NETCore.App.Ref"));
        string assemblies = Directory.Exists(packs)
            ? Directory.EnumerateDirectories(packs, "10.*").Select(pack => Path.Combine(pack, "ref/net10.0"))
                .FirstOrDefault(Directory.Exists, runtime)
            : runtime;
        var paths = Directory.EnumerateFiles(assemblies, "*.dll").Where(IsManaged).ToList();
        using var assets = JsonDocument.Parse(File.ReadAllText(Path.Combine(tree, "FractalEngine.App/obj/project.assets.json")));
        var folders = assets.RootElement.GetProperty("packageFolders").EnumerateObject().Select(folder => folder.Name).ToList();
        foreach (var library in assets.RootElement.GetProperty("targets").EnumerateObject().First().Value.EnumerateObject())
        {
            if (library.Value.GetProperty("type").GetString() == "package" && library.Value.TryGetProperty("compile", out var files))
            {
                string? folder = assets.RootElement.GetProperty("libraries").GetProperty(library.Name).GetProperty("path").GetString();
                paths.AddRange(files.EnumerateObject().Where(file => file.Name.EndsWith(".dll", StringComparison.Ordinal))
                    .Select(file => folders.Select(root => Path.Combine(root, folder!, file.Name)).First(File.Exists)));
            }
        }

        const string DebianOpenTK = "/usr/lib/cli/OpenTK-1.1/OpenTK.dll";
        if (File.Exists(DebianOpenTK))
        {
            paths.Add(DebianOpenTK);
        }

        return [.. paths.Select(path => MetadataReference.CreateFromFile(path))];
    }
}
