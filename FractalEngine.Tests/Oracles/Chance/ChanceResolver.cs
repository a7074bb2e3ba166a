using System.Collections.Immutable;
using System.Globalization;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Finds what the names of a model stand for, and refuses what the oracle has no meaning for.</summary>
internal sealed class ChanceResolver
{
    private readonly Dictionary<string, ChanceNode> _nodes = [];
    private readonly Dictionary<ChanceNode, string> _keys = new(ReferenceEqualityComparer.Instance);
    private readonly Dictionary<(GraphFile, string), (ChanceGroup Group, string Key)> _groups = [];

    private readonly Dictionary<string, GraphFile> _files = [];

    /// <summary>Resolves the result of a file; null for one that is left out.</summary>
    public static ChanceNode? TryResolve(GraphFile file)
    {
        try
        {
            return new ChanceResolver().Resolve(file.Result, Scope.After(file));
        }
        catch (UnclearModelException)
        {
            return null;
        }
    }

    private ChanceNode Resolve(ObjectTerm term, Scope scope) => term switch
    {
        ObjectTerm.Mesh(var mesh) => Intern("mesh " + mesh.Path, new ChanceNode.Base(mesh)),
        ObjectTerm.File(var file) => ResolveFile(file),
        ObjectTerm.Named(var name) => ResolveName(name, scope),
        ObjectTerm.AtDepth(var name, { } depth) => ResolveRecursive(name, depth, null, scope),
        ObjectTerm.Until(var name, var size) => ResolveRecursive(name, 0, size, scope),
        ObjectTerm.Mapped(var set, var inner) => Map(MapsOf(set), Resolve(inner, scope)),
        ObjectTerm.Sum(var terms) => ResolveSum(terms, scope),
        ObjectTerm.Choice choice => ResolveChoice(choice, scope),
        _ => throw new UnclearModelException("an infinite one"),
    };

    private ChanceNode ResolveFile(GraphFile file)
    {
        _files.TryAdd(file.Path, file);
        Require(ReferenceEquals(_files[file.Path], file), "two files of one name");
        return AsOne(Resolve(file.Result, Scope.After(file)));
    }

    private ChanceNode ResolveName(string name, Scope scope)
    {
        if (scope.Calls.IndexOf(name) is >= 0 and var index)
        {
            return Intern($"call {index}", new ChanceNode.Call(index));
        }

        return scope.File.Find(name) switch
        {
            GraphDeclaration.Alias alias => AsOne(Resolve(alias.Body, Scope.At(scope.File, alias))),
            GraphDeclaration.Group => throw new UnclearModelException("an infinite one"),
            _ => Intern("shape " + name, new ChanceNode.Base(OracleMesh.Shape(name))),
        };
    }

    private ChanceNode ResolveRecursive(string name, int depth, double? size, Scope scope)
    {
        var declared = (GraphDeclaration.Group)scope.File.Find(name)!;
        var (group, key) = FindGroup(declared, scope.File);
        var index = declared.Recursives.ToList().FindIndex(recursive => recursive.Name == name);
        if (size is not null)
        {
            ChanceCycles.RequireShrinking(group);
            // The box of what stands there by chance, or of what ends by its size, is not said.
            Require(group.Bases.All(static node => node.IsPlain), "a base by chance of what ends by its size");
        }

        return Intern(
            string.Create(CultureInfo.InvariantCulture, $"recursive {index} {depth} {size:R} of {key}"),
            new ChanceNode.Recursive(group, index, depth, size));
    }

    private (ChanceGroup Group, string Key) FindGroup(GraphDeclaration.Group declared, GraphFile file)
    {
        if (!_groups.TryGetValue((file, declared.Recursives[0].Name), out var found))
        {
            ImmutableArray<string> calls = [.. declared.Recursives.Select(static recursive => recursive.Base)];
            var outer = Scope.At(file, declared);
            ImmutableArray<ChanceNode> bases = [.. calls.Select(name => ResolveName(name, outer))];
            var scope = outer with { Calls = calls, IsInBody = true };
            ImmutableArray<ChanceNode> bodies = [.. declared.Recursives.Select(recursive => Resolve(recursive.Body, scope))];
            foreach (var recursive in declared.Recursives)
            {
                Require(UsesCall(recursive.Body, calls), "a body without a call");
                Require(calls.Length > 1 || recursive.Body is not ObjectTerm.Named, "nothing but its base");
                Require(!IsBuiltOn(recursive.Body, calls, file, 0), "a base by another name");
            }

            var diagonals = bases.Select(static node => node.IsPlain ? ChanceExpansion.Diagonal(node) : double.NaN);
            var key = string.Join(", ", bases.Concat(bodies).Select(node => _keys[node]));
            found = (new(bases, bodies, [.. diagonals]), key);
            _groups[(file, declared.Recursives[0].Name)] = found;
        }

        return found;
    }

    private static IEnumerable<ObjectTerm> PartsOf(ObjectTerm term) => term switch
    {
        ObjectTerm.Mapped(_, var inner) => [inner],
        ObjectTerm.Sum(var terms) => terms,
        ObjectTerm.Choice(var alternatives) => alternatives.Select(static one => one.Term),
        _ => [],
    };

    /// <summary>Whether a body has one of some calls.</summary>
    public static bool UsesCall(ObjectTerm term, ImmutableArray<string> calls) =>
        (term is ObjectTerm.Named(var name) && calls.Contains(name)) || PartsOf(term).Any(part => UsesCall(part, calls));

    // Names of other objects, and of recursives, that are made of a base.
    private static bool IsBuiltOn(ObjectTerm term, ImmutableArray<string> calls, GraphFile file, int depth) => term switch
    {
        ObjectTerm.Named(var name) when calls.Contains(name) => depth > 0,
        ObjectTerm.Named(var name) => file.Find(name) is GraphDeclaration.Alias alias && IsBuiltOn(alias.Body, calls, file, depth + 1),
        ObjectTerm.AtDepth(var name, _) => IsGroupBuiltOn(name, calls, file),
        ObjectTerm.Until(var name, _) => IsGroupBuiltOn(name, calls, file),
        _ => PartsOf(term).Any(part => IsBuiltOn(part, calls, file, depth)),
    };

    private static bool IsGroupBuiltOn(string name, ImmutableArray<string> calls, GraphFile file) =>
        ((GraphDeclaration.Group)file.Find(name)!).Recursives.Any(recursive =>
            IsBuiltOn(new ObjectTerm.Named(recursive.Base), calls, file, 1) || IsBuiltOn(recursive.Body, calls, file, 1));

    private ChanceNode ResolveSum(ImmutableArray<ObjectTerm> terms, Scope scope)
    {
        List<(List<SetMap> Maps, ChanceNode Inner)> found = [];
        foreach (var term in terms)
        {
            var (maps, inner) = Resolve(term, scope) is var node && node is ChanceNode.Mapped mapped
                ? (mapped.Maps, mapped.Inner)
                : ([SetMap.Identity], node);
            if (found.Count > 0 && ReferenceEquals(found[^1].Inner, inner))
            {
                found[^1].Maps.AddRange(maps);
            }
            else
            {
                found.Add(([.. maps], inner));
            }
        }

        ImmutableArray<ChanceNode.Mapped> mappedTerms = [.. found.Select(term => Map([.. term.Maps], term.Inner))];
        return Intern(
            "sum (" + string.Join(" + ", mappedTerms.Select(term => _keys[term])) + ")", new ChanceNode.Sum(mappedTerms));
    }

    private ChanceNode ResolveChoice(ObjectTerm.Choice choice, Scope scope)
    {
        var (seed, isByLevel) = scope.Seed;
        ImmutableArray<(double, ChanceNode)> alternatives =
            [.. choice.Alternatives.Select(one => (one.Weight, Resolve(one.Term, scope)))];
        Require(choice.Alternatives.Any(static one => one.Weight > 0), "weights that are all 0");
        var key = string.Join(" | ", alternatives.Select(
            one => string.Create(CultureInfo.InvariantCulture, $"{one.Item1:R}: {_keys[one.Item2]}")));
        var place = !isByLevel ? "" : scope.IsInBody ? " by level" : " at level 1";
        return Intern($"choice {seed}{place} ({key})", new ChanceNode.Choice(alternatives, seed, isByLevel, scope.IsInBody));
    }

    private ChanceNode.Mapped Map(ImmutableArray<SetMap> maps, ChanceNode inner) => (ChanceNode.Mapped)Intern(
        $"[{string.Join(", ", maps.Select(static map => map.ToString()))}] ({_keys[inner]})", new ChanceNode.Mapped(maps, AsOne(inner)));

    private ChanceNode AsOne(ChanceNode node) =>
        node is ChanceNode.Mapped mapped ? Intern("one " + _keys[node], new ChanceNode.Whole(mapped)) : node;

    private static ImmutableArray<SetMap> MapsOf(ImmutableArray<MapProduct> set)
    {
        ImmutableArray<SetMap> maps = [.. set.SelectMany(SetMap.AllOf)];
        Require(maps.Any(static map => !map.IsIdentity), "a set that changes nothing");
        return maps;
    }

    private ChanceNode Intern(string key, ChanceNode node)
    {
        if (!_nodes.TryGetValue(key, out var known))
        {
            known = node;
            _nodes[key] = node;
            _keys[node] = string.Create(CultureInfo.InvariantCulture, $"#{_nodes.Count}");
        }

        return known;
    }

    public static void Require(bool condition, string reason)
    {
        if (!condition)
        {
            throw new UnclearModelException(reason);
        }
    }

    /// <summary>What names mean in a term, and the seed of its choices.</summary>
    private sealed record Scope(
        GraphFile File, ImmutableArray<string> Calls, bool IsInBody, (int Value, bool IsByLevel) Seed)
    {
        public static Scope After(GraphFile file) => Of(file, file.Declarations.Length);

        public static Scope At(GraphFile file, GraphDeclaration declaration) => Of(file, file.Declarations.IndexOf(declaration));

        private static Scope Of(GraphFile file, int count)
        {
            var seed = file.Declarations.Take(count).OfType<GraphDeclaration.Seed>().LastOrDefault() ?? new(0, false);
            return new(file, [], false, (seed.Value, seed.IsByLevel));
        }
    }
}
