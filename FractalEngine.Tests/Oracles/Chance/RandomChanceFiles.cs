using System.Collections.Immutable;
using System.Globalization;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Draws a file with choices and ends by size, and those that it uses.</summary>
internal sealed class RandomChanceFiles
{
    private const int MaxFiles = 3;

    private readonly Random _random;
    private readonly ImmutableArray<OracleMesh> _meshes;
    private readonly RandomProducts _products;
    private readonly List<GraphDeclaration> _declarations = [];
    // All names that the object of a name uses, itself included.
    private readonly Dictionary<string, ImmutableHashSet<string>> _used = [];
    private readonly List<string> _paths;
    private int _names;

    private RandomChanceFiles(Random random, ImmutableArray<OracleMesh> meshes, List<string> paths)
    {
        _random = random;
        _meshes = meshes;
        _paths = paths;
        _products = new(random, new() { HasEmptySets = false });
    }

    /// <summary>Draws models until one has a meaning and is small enough.</summary>
    public static (GraphFile File, ImmutableArray<PlacedMesh> Instances) Create(Random random, ChanceOptions options)
    {
        while (true)
        {
            var meshes = RandomOracleMeshes.Create(random, random.Next(1, 4), random.Next(3) > 0);
            var file = new RandomChanceFiles(random, meshes, ["main.fdo"]).CreateFile("main.fdo");
            if (ChanceExpansion.TryExpand(file, options) is { Length: > 0 } instances
                && ChanceResolver.TryResolve(file) is { } node && (!node.IsPlain || random.Happens(3)))
            {
                return (file, instances);
            }
        }
    }

    private GraphFile CreateFile(string path)
    {
        foreach (var mesh in _meshes)
        {
            if (_random.Happens(75))
            {
                Declare(new ObjectTerm.Mesh(mesh));
            }
        }

        for (var i = _random.Next(1, 5); i > 0; i--)
        {
            if (_random.Happens(35))
            {
                _declarations.Add(new GraphDeclaration.Seed(
                    _random.Draw((3, _random.Next(10)), (1, _random.Next(1_000_000_000))), _random.Happens(35)));
            }

            if (_random.Happens(40) || !TryDeclareGroup())
            {
                Declare(CreateObject(2));
            }
        }

        return new(path, [.. _declarations], CreateObject(2));
    }

    private ObjectTerm CreateObject(int height) =>
        _random.Happens(30) ? CreateChoice(() => CreateTerm(height, static _ => true)) : CreateTerm(height, static _ => true);

    private void Declare(ObjectTerm body)
    {
        var name = NewName();
        _declarations.Add(new GraphDeclaration.Alias(name, body));
        _used[name] = [name, .. NamesIn(body)];
    }

    private bool TryDeclareGroup()
    {
        var candidates = _declarations.OfType<GraphDeclaration.Alias>().Select(static alias => alias.Name)
            .Concat(OracleMesh.ShapeNames).ToArray();
        _random.Shuffle(candidates);
        var count = _random.Draw((7, 1), (3, 2), (1, 3));
        if (candidates.Length < count)
        {
            return false;
        }

        var shrinks = _random.Happens(65);
        var bases = candidates[..count];
        ImmutableArray<GraphDeclaration.Recursive> recursives =
            [.. bases.Select((name, i) => new GraphDeclaration.Recursive(NewName(), name, CreateBody(bases, i, shrinks)))];
        if (!recursives.All(recursive => ChanceResolver.UsesCall(recursive.Body, [.. bases]))
            || (count == 1 && recursives[0].Body is ObjectTerm.Named))
        {
            return false;
        }

        _declarations.Add(new GraphDeclaration.Group(recursives));
        ImmutableHashSet<string> used =
        [
            .. recursives.Select(static recursive => recursive.Name), .. bases.SelectMany(Find),
            .. recursives.SelectMany(recursive => NamesIn(recursive.Body)),
        ];
        foreach (var recursive in recursives)
        {
            _used[recursive.Name] = used;
        }

        return true;
    }

    private ObjectTerm CreateBody(string[] bases, int index, bool shrinks)
    {
        ObjectTerm Part(int height) => CreateBodyPart(bases, height, shrinks);

        ObjectTerm Called() => CreateCall(bases, shrinks, minSets: 1);

        return _random.Draw<Func<ObjectTerm>>(
            (12, () => CreateSets(_random.Draw((3, 1), (1, 2)), new ObjectTerm.Named(bases[index]), shrinks)),
            (30, () => new ObjectTerm.Sum([Called(), .. Enumerable.Range(0, _random.Next(1, 3)).Select(_ => Part(1))])),
            (8, () => new ObjectTerm.Sum([Part(1), Called()])),
            (35, () => CreateChoice(() => Part(2))),
            (12, () => CreateSets(_random.Draw((3, 1), (1, 2)), CreateChoice(() => Part(1)), shrinks)),
            (bases.Length > 1 ? 6 : 0, () => new ObjectTerm.Named(bases[(index + 1) % bases.Length])),
            (bases.Length > 1 ? 2 : 0, () => CreateTerm(1, IsPlainIn(bases))))();
    }

    private ObjectTerm CreateBodyPart(string[] bases, int height, bool shrinks)
    {
        ObjectTerm Part() => CreateBodyPart(bases, height - 1, shrinks);

        return _random.Draw<Func<ObjectTerm>>(
            (40, () => CreateCall(bases, shrinks, shrinks ? 1 : _random.Next(2))),
            (shrinks ? 3 : 10, () => new ObjectTerm.Named(bases[_random.Next(bases.Length)])),
            (25, () => CreateTerm(1, IsPlainIn(bases))),
            (height > 0 ? 15 : 0, () => CreateSum(Part)),
            (height > 0 ? 20 : 0, () => CreateChoice(Part)),
            (height > 0 ? 10 : 0, () => CreateSets(1, CreateChoice(Part), shrinks)))();
    }

    private ObjectTerm CreateCall(string[] bases, bool shrinks, int minSets) => CreateSets(
        Math.Max(minSets, _random.Draw((8, 1), (2, 2))), new ObjectTerm.Named(bases[_random.Next(bases.Length)]), shrinks);

    private Func<string, bool> IsPlainIn(string[] bases) => name => !Find(name).Overlaps(bases);

    private ObjectTerm CreateTerm(int height, Func<string, bool> isAllowed) => height == 0
        ? CreateLeaf(isAllowed)
        : _random.Draw<Func<ObjectTerm>>(
            (35, () => CreateLeaf(isAllowed)),
            (25, () => CreateSets(_random.Draw((4, 1), (1, 2)), CreateTerm(height - 1, isAllowed))),
            (22, () => CreateSum(() => CreateTerm(height - 1, isAllowed))),
            (18, () => CreateChoice(() => CreateTerm(height - 1, isAllowed))))();

    /// <summary>Draws a sum, at times with successive terms of the same object.</summary>
    private ObjectTerm.Sum CreateSum(Func<ObjectTerm> createTerm)
    {
        List<ObjectTerm> terms = [];
        while (terms.Count < 2 || _random.Happens(30))
        {
            var term = createTerm();
            terms.Add(_random.Happens(30) ? CreateSets(1, term) : term);
            while (_random.Happens(25))
            {
                var inner = terms[^1] is ObjectTerm.Mapped(_, var mapped) ? mapped : terms[^1];
                terms.Add(CreateSets(1, inner));
            }
        }

        return new ObjectTerm.Sum([.. terms]);
    }

    private ObjectTerm.Choice CreateChoice(Func<ObjectTerm> createTerm)
    {
        var count = _random.Draw((1, 1), (8, 2), (5, 3), (2, 4));
        while (true)
        {
            ImmutableArray<(double Weight, ObjectTerm)> alternatives =
                [.. Enumerable.Range(0, count).Select(_ => (CreateWeight(), createTerm()))];
            if (alternatives.Any(static one => one.Weight > 0))
            {
                return new(alternatives);
            }
        }
    }

    private double CreateWeight() => _random.Draw(
        (6, _random.Next(1, 5)), (2, 0), (3, Math.Round(_random.Between(0.01, 3), 2)), (1, _random.NextDouble()), (1, 1e6));

    private ObjectTerm CreateLeaf(Func<string, bool> isAllowed)
    {
        var names = _used.Keys.Where(isAllowed).Order(StringComparer.Ordinal).ToArray();
        var shapes = OracleMesh.ShapeNames.Where(isAllowed).ToArray();
        return _random.Draw<Func<ObjectTerm>>(
            (names.Length > 0 ? 14 : 0, () => Use(names[_random.Next(names.Length)])),
            (3, () => new ObjectTerm.Mesh(_meshes[_random.Next(_meshes.Length)])),
            (shapes.Length > 0 ? 2 : 0, () => new ObjectTerm.Named(shapes[_random.Next(shapes.Length)])),
            (_paths.Count < MaxFiles ? 1 : 0, CreateFileTerm))();
    }

    private ObjectTerm Use(string name)
    {
        if (_declarations.Single(declaration => declaration.Names.Contains(name)) is not GraphDeclaration.Group group)
        {
            return new ObjectTerm.Named(name);
        }

        var first = group.Recursives.Single(recursive => recursive.Name == name).Base;
        if (_random.Happens(45) && TryMeasure(first) is { } diagonal && TryMeasure(name) is not null)
        {
            var size = diagonal * Math.Pow(10, _random.Between(-1.7, 0.2));
            return new ObjectTerm.Until(name, double.Parse($"{size:G3}", CultureInfo.CurrentCulture));
        }

        return new ObjectTerm.AtDepth(name, _random.Draw((3, 1), (5, 2), (5, 3), (3, 4), (2, 5), (1, 6), (1, 9)));
    }

    /// <summary>The diagonal of an object; 0 of a recursive that may end by its size, and null of one that may not.</summary>
    private double? TryMeasure(string name)
    {
        var isRecursive = _declarations.Exists(one => one is GraphDeclaration.Group && one.Names.Contains(name));
        ObjectTerm term = isRecursive ? new ObjectTerm.Until(name, 1) : new ObjectTerm.Named(name);
        try
        {
            var node = ChanceResolver.TryResolve(new("main.fdo", [.. _declarations], term));
            return node is null ? null : isRecursive ? 0 : node.IsPlain ? ChanceExpansion.Diagonal(node) : null;
        }
        catch (UnclearModelException)
        {
            return null;
        }
    }

    private ObjectTerm.File CreateFileTerm()
    {
        var path = $"{_random.Draw((2, ""), (1, "sub/"))}part{_paths.Count}.fdo";
        _paths.Add(path);
        return new(new RandomChanceFiles(_random, _meshes, _paths).CreateFile(path));
    }

    private ObjectTerm CreateSets(int count, ObjectTerm term, bool shrinks = false)
    {
        for (; count > 0; count--)
        {
            term = new ObjectTerm.Mapped(CreateSet(shrinks), term);
        }

        return term;
    }

    private ImmutableArray<MapProduct> CreateSet(bool shrinks)
    {
        while (true)
        {
            var set = _products.CreateSet(1);
            if (shrinks)
            {
                set = [.. set.Where(static product => SetMap.AllOf(product).All(static map => map.Stretch < 0.9))];
                set = set.IsEmpty ? [new([new(new MapLeaf.Placement(Round(_random.Vector(1.5)), DrawAngles(), DrawScale()))])] : set;
            }

            if (set.Any(static product => product.Factors.Any(static power => power.Leaf is not MapLeaf.Identity)))
            {
                return set;
            }
        }
    }

    private Vector? DrawAngles() => _random.Draw<Vector?>((1, null), (1, Round(_random.Degrees())));

    private Vector DrawScale() => _random.Happens(60)
        ? Math.Round(_random.Between(0.3, 0.83), 2) * Vector.One
        : Round(new(_random.Between(0.3, 0.83), _random.Between(0.3, 0.83), _random.Between(-0.83, -0.3)));

    private static Vector Round(Vector v) => new(Math.Round(v.X, 2), Math.Round(v.Y, 2), Math.Round(v.Z, 2));

    private string NewName() => string.Create(CultureInfo.InvariantCulture, $"o{++_names}");

    private ImmutableHashSet<string> Find(string name) => _used.GetValueOrDefault(name, [name]);

    private IEnumerable<string> NamesIn(ObjectTerm term) => term switch
    {
        ObjectTerm.Named(var name) => Find(name),
        ObjectTerm.AtDepth(var name, _) => Find(name),
        ObjectTerm.Until(var name, _) => Find(name),
        ObjectTerm.Mapped(_, var inner) => NamesIn(inner),
        ObjectTerm.Sum(var terms) => terms.SelectMany(NamesIn),
        ObjectTerm.Choice(var alternatives) => alternatives.SelectMany(one => NamesIn(one.Term)),
        _ => [],
    };
}
