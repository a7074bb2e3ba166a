using System.Collections.Immutable;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>Draws a file of a model, and those that it uses.</summary>
internal sealed class RandomGraphFiles
{
    private const int MaxFiles = 3;
    private static readonly string[] Words = ["o", "leaf", "Bough", "b_", "x-y", "Ast", "plant", "part"];

    private readonly Random _random;
    private readonly GraphOptions _options;
    private readonly ImmutableArray<OracleMesh> _meshes;
    private readonly RandomProducts _products;
    private readonly List<GraphDeclaration> _declarations = [];
    // All names that the object of a name uses, itself included, and those that it is built on.
    private readonly Dictionary<string, ImmutableHashSet<string>> _used = [];
    private readonly Dictionary<string, ImmutableHashSet<string>> _built = [];
    private readonly string _folder;
    private readonly List<string> _paths;
    private int _names;

    private RandomGraphFiles(
        Random random, GraphOptions options, ImmutableArray<OracleMesh> meshes, string folder, List<string> paths)
    {
        _random = random;
        _options = options;
        _meshes = meshes;
        _folder = folder;
        _paths = paths;
        _products = new(random, options);
    }

    /// <summary>Draws models until one is small enough.</summary>
    public static (GraphFile File, ImmutableArray<PlacedMesh> Instances) Create(Random random, GraphOptions options)
    {
        while (true)
        {
            var count = options.IsLinear ? 1 : random.Next(2, 5);
            var meshes = RandomOracleMeshes.Create(random, count, options.IsForImages);
            var file = new RandomGraphFiles(random, options, meshes, "", ["main.fdo"]).CreateFile("main.fdo");
            // One without triangles may be right, but is not needed often.
            if (ModelExpansion.TryExpand(file, options.MaxInstances, options.MaxFaces) is { } instances
                && (instances.Any(static instance => instance.Mesh.FaceCount > 0) || (!options.IsForImages && random.Happens(2))))
            {
                return (file, instances);
            }
        }
    }

    private GraphFile CreateFile(string path)
    {
        foreach (var mesh in _meshes)
        {
            if (_options.IsLinear || _random.Happens(75))
            {
                var shape = OracleMesh.ShapeNames[_random.Next(OracleMesh.ShapeNames.Length)];
                Declare(_options.IsLinear && _random.Happens(20) ? new ObjectTerm.Named(shape) : new ObjectTerm.Mesh(mesh));
            }
        }

        for (var i = _random.Next(1, 5); i >= 0; i--)
        {
            if (_random.Next(2) == 0 || !TryDeclareGroup())
            {
                Declare(CreateTerm(2, static _ => true));
            }
        }

        return new(path, [.. _declarations], CreateTerm(2, static _ => true));
    }

    private void Declare(ObjectTerm body)
    {
        var name = NewName();
        _declarations.Add(new GraphDeclaration.Alias(name, body));
        _used[name] = [name, .. NamesIn(body, _used)];
        _built[name] = [name, .. NamesIn(body, _built)];
    }

    private bool TryDeclareGroup()
    {
        string[] shapes = _options.IsLinear ? [] : [.. OracleMesh.ShapeNames];
        var candidates = _declarations.OfType<GraphDeclaration.Alias>().Select(static alias => alias.Name).Concat(shapes).ToList();
        var count = _options.IsLinear ? 1 : _random.Draw((6, 1), (3, 2), (2, 3));
        if (candidates.Count < count)
        {
            return false;
        }

        var bases = new string[count];
        for (var i = 0; i < count; i++)
        {
            var index = _random.Next(candidates.Count);
            bases[i] = candidates[index];
            candidates.RemoveAt(index);
        }

        var bodies = Enumerable.Range(0, count).Select(i => CreateBody(bases, i)).ToArray();
        var names = bases.Select(_ => NewName()).ToArray();
        _declarations.Add(new GraphDeclaration.Group(
            [.. bases.Select((name, i) => new GraphDeclaration.Recursive(names[i], name, bodies[i]))]));
        for (var i = 0; i < count; i++)
        {
            _used[names[i]] =
                [.. names, .. bases.SelectMany(name => Find(name, _used)), .. bodies.SelectMany(body => NamesIn(body, _used))];
            _built[names[i]] = [names[i], .. Find(bases[i], _built)];
        }

        return true;
    }

    private ObjectTerm CreateBody(string[] bases, int index)
    {
        // Each body has a call, and a recursive alone calls itself.
        var called = bases.Length == 1 ? bases[0] : bases[_random.Next(2) == 0 ? (index + 1) % bases.Length : _random.Next(bases.Length)];
        if (_options.IsLinear)
        {
            return CreateSets(_random.Next(1, 3), CreateLinearCall(called));
        }

        List<ObjectTerm> terms = [CreateSets(_random.Draw((2, 0), (8, 1), (2, 2)), new ObjectTerm.Named(called), minMaps: 1)];
        var isPlain = IsPlainIn(bases);
        for (var i = _random.Draw((3, 0), (5, 1), (2, 2)); i > 0; i--)
        {
            terms.Insert(_random.Next(terms.Count + 1), _random.Next(2) == 0
                ? CreateSets(_random.Next(0, 3), new ObjectTerm.Named(bases[_random.Next(bases.Length)]))
                : CreateTerm(1, isPlain));
        }

        // A recursive that is nothing but its base is refused.
        return terms.Count > 1 ? new ObjectTerm.Sum([.. terms])
            : terms[0] is ObjectTerm.Named ? CreateSets(1, terms[0], minMaps: 1)
            : terms[0];
    }

    /// <summary>The base itself, or what leads to it.</summary>
    private ObjectTerm CreateLinearCall(string called)
    {
        var leading = _built.Keys.Where(name => name != called && _built[name].Contains(called)).Order(StringComparer.Ordinal).ToArray();
        return !_options.HasIndirectCalls || leading.Length == 0 || _random.Next(3) == 0
            ? new ObjectTerm.Named(called)
            : Use(leading[_random.Next(leading.Length)]);
    }

    /// <summary>What takes no level in a body: names that don't lead to a base, unless indirect calls are wanted.</summary>
    private Func<string, bool> IsPlainIn(string[] bases) =>
        name => _options.HasIndirectCalls ? !bases.Contains(name) : !Find(name, _used).Overlaps(bases);

    private ObjectTerm CreateTerm(int height, Func<string, bool> isAllowed)
    {
        if (_options.IsLinear)
        {
            var names = _used.Keys.Order(StringComparer.Ordinal).ToArray();
            return CreateSets(_random.Draw((6, 0), (3, 1), (1, 2)), Use(names[_random.Next(names.Length)]));
        }

        return height == 0
            ? CreateLeaf(isAllowed)
            : _random.Draw<Func<ObjectTerm>>(
                (40, () => CreateLeaf(isAllowed)),
                (35, () => CreateSets(_random.Next(1, 3), CreateTerm(height - 1, isAllowed))),
                (25, () => new ObjectTerm.Sum(
                    [.. Enumerable.Range(0, _random.Next(2, 4)).Select(_ => CreateTerm(height - 1, isAllowed))])))();
    }

    private ObjectTerm CreateLeaf(Func<string, bool> isAllowed)
    {
        var names = _used.Keys.Where(isAllowed).Order(StringComparer.Ordinal).ToArray();
        var shapes = OracleMesh.ShapeNames.Where(isAllowed).Where(IsWanted).ToArray();
        return _random.Draw<Func<ObjectTerm>>(
            (names.Length > 0 ? 12 : 0, () => Use(names[_random.Next(names.Length)])),
            (3, () => new ObjectTerm.Mesh(_meshes[_random.Next(_meshes.Length)])),
            (shapes.Length > 0 ? 2 : 0, () => new ObjectTerm.Named(shapes[_random.Next(shapes.Length)])),
            (_paths.Count < MaxFiles ? 2 : 0, CreateFileTerm))();
    }

    // Images are compared under flat normals, which round shapes don't have.
    private bool IsWanted(string shape) => !_options.IsForImages || shape is "box" or "tetrahedron";

    private ObjectTerm Use(string name)
    {
        var isRecursive = _declarations.Single(declaration => declaration.Names.Contains(name)) is GraphDeclaration.Group;
        return isRecursive
            ? new ObjectTerm.AtDepth(name, _random.Draw((1, 0), (3, 1), (5, 2), (5, 3), (3, 4), (2, 5), (1, 6)))
            : new ObjectTerm.Named(name);
    }

    private ObjectTerm.File CreateFileTerm()
    {
        var folder = _folder + _random.Draw((2, ""), (2, "sub/"), (1, "sub/deep/"));
        var path = $"{folder}part{_paths.Count}.fdo";
        _paths.Add(path);
        return new(new RandomGraphFiles(_random, _options, _meshes, folder, _paths).CreateFile(path));
    }

    private ObjectTerm CreateSets(int count, ObjectTerm term, int minMaps = 0) =>
        count == 0 ? term : new ObjectTerm.Mapped(_products.CreateSet(minMaps), CreateSets(count - 1, term, minMaps));

    private string NewName() => $"{Words[_random.Next(Words.Length)]}{++_names}";

    private static ImmutableHashSet<string> Find(string name, Dictionary<string, ImmutableHashSet<string>> sets) =>
        sets.GetValueOrDefault(name, [name]);

    private static IEnumerable<string> NamesIn(ObjectTerm term, Dictionary<string, ImmutableHashSet<string>> sets) => term switch
    {
        ObjectTerm.Named(var name) => Find(name, sets),
        ObjectTerm.AtDepth(var name, _) => Find(name, sets),
        ObjectTerm.Mapped(_, var inner) => NamesIn(inner, sets),
        ObjectTerm.Sum(var terms) => terms.SelectMany(part => NamesIn(part, sets)),
        _ => [],
    };
}
