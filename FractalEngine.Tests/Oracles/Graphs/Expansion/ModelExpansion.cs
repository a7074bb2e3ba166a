using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Graphs.Expansion;

/// <summary>
/// Spells out a model by the meaning of its terms, one after the other. In the body of a recursive its base is a call, and other names are
/// plain objects. Where the body is sets on one object, a name or a recursive that is such sets on the base leads to a call as well, as it
/// did before there were sums.
/// </summary>
internal sealed class ModelExpansion
{
    private readonly List<PlacedMesh> _instances = [];
    private readonly int _maxInstances;
    private readonly int _maxFaces;
    private readonly int _infiniteDepth;
    private long _stepsLeft = 400_000;
    private int _faces;
    private bool _isTooLarge;

    private ModelExpansion(int maxInstances, int maxFaces, int infiniteDepth)
    {
        _maxInstances = maxInstances;
        _maxFaces = maxFaces;
        _infiniteDepth = infiniteDepth;
    }

    /// <summary>Expands the result of a file into all chains, equal ones too.</summary>
    /// <param name="file">The main file of a model.</param>
    /// <param name="maxInstances">Number of instances beyond which nothing is returned.</param>
    /// <param name="maxFaces">Number of triangles beyond which nothing is returned.</param>
    /// <param name="infiniteDepth">The depth that stands for infinity.</param>
    public static ImmutableArray<PlacedMesh>? TryExpand(
        GraphFile file, int maxInstances = 3000, int maxFaces = 60_000, int infiniteDepth = 12)
    {
        ModelExpansion expansion = new(maxInstances, maxFaces, infiniteDepth);
        expansion.Expand(file.Result, Scope.Of(file), RowMap.Identity, 0);
        return expansion._isTooLarge ? null : [.. expansion._instances];
    }

    private void Expand(ObjectTerm term, Scope scope, RowMap map, double reach)
    {
        _isTooLarge |= --_stepsLeft < 0;
        if (_isTooLarge)
        {
            return;
        }

        switch (term)
        {
            case ObjectTerm.Mesh(var mesh):
                Add(mesh, map, reach);
                break;
            case ObjectTerm.File(var file):
                Expand(file.Result, Scope.Of(file), map, reach);
                break;
            case ObjectTerm.Named(var name):
                ExpandNamed(name, scope, map, reach);
                break;
            case ObjectTerm.AtDepth(var name, var depth):
                var group = (GraphDeclaration.Group)scope.File.Find(name)!;
                var named = group.Recursives.Single(recursive => recursive.Name == name);
                ExpandRecursive(group, named, depth ?? _infiniteDepth, scope.Elsewhere, map, reach);
                break;
            case ObjectTerm.Mapped(var set, var inner):
                foreach (var product in set)
                {
                    ExpandProduct(product.Factors, inner, scope, map, reach);
                }

                break;
            case ObjectTerm.Sum(var terms):
                foreach (var part in terms)
                {
                    Expand(part, scope, map, reach);
                }

                break;
        }
    }

    private void ExpandNamed(string name, Scope scope, RowMap map, double reach)
    {
        if (scope.Calls.TryGetValue(name, out var call))
        {
            ExpandRecursive(call.Group, call.Recursive, call.Depth - 1, call.Outer, map, reach);
        }
        else if (scope.File.Find(name) is GraphDeclaration.Alias alias)
        {
            Expand(alias.Body, scope.Elsewhere, map, reach);
        }
        else if (scope.File.Find(name) is GraphDeclaration.Group group)
        {
            var recursive = group.Recursives.Single(item => item.Name == name);
            ExpandRecursive(group, recursive, _infiniteDepth, scope.Elsewhere, map, reach);
        }
        else
        {
            Add(OracleMesh.Shape(name), map, reach);
        }
    }

    private void ExpandRecursive(
        GraphDeclaration.Group group, GraphDeclaration.Recursive recursive, int depth, Scope scope, RowMap map, double reach)
    {
        if (depth == 0)
        {
            ExpandNamed(recursive.Base, scope, map, reach);
            return;
        }

        var calls = group.Recursives.ToImmutableDictionary(static item => item.Base, item => new Call(group, item, depth, scope));
        Expand(recursive.Body, new(scope.File, calls, IsLinear(scope.File, group)), map, reach);
    }

    private static bool IsLinear(GraphFile file, GraphDeclaration.Group group) =>
        group.Recursives is [var recursive] && IsSetsOn(recursive.Base, recursive.Body, file);

    private static bool IsSetsOn(string name, ObjectTerm term, GraphFile file) => term switch
    {
        ObjectTerm.Mapped(_, var inner) => IsSetsOn(name, inner, file),
        ObjectTerm.Named(var other) => other == name
            || (file.Find(other) is GraphDeclaration.Alias alias && IsSetsOn(name, alias.Body, file)),
        ObjectTerm.AtDepth(var other, _) => file.Find(other) is GraphDeclaration.Group group && IsLinear(file, group)
            && IsSetsOn(name, new ObjectTerm.Named(group.Recursives[0].Base), file),
        _ => false,
    };

    private void ExpandProduct(ImmutableArray<MapPower> factors, ObjectTerm term, Scope scope, RowMap map, double reach)
    {
        if (factors.IsEmpty)
        {
            Expand(term, scope, map, reach);
            return;
        }

        var ((leaf, low, high), rest) = (factors[0], factors[1..]);
        var forward = RowMap.Of(leaf);
        for (var exponent = low; exponent <= high && !_isTooLarge; exponent++)
        {
            var step = exponent < 0 ? forward.Inverse() : forward;
            var (power, farthest) = (map, reach);
            for (var i = 0; i < Math.Abs(exponent); i++)
            {
                power = power.After(step);
                farthest = Math.Max(farthest, Largest(power.Translation));
            }

            ExpandProduct(rest, term, scope, power, farthest);
        }
    }

    private void Add(OracleMesh mesh, RowMap map, double reach)
    {
        _faces += mesh.FaceCount;
        _isTooLarge |= _instances.Count == _maxInstances || _faces > _maxFaces;
        _instances.Add(new(mesh, map, reach));
    }

    private static double Largest(Vector v) => Math.Max(Math.Abs(v.X), Math.Max(Math.Abs(v.Y), Math.Abs(v.Z)));

    /// <summary>A recursive that a name stands for, where the call has no level less yet.</summary>
    private sealed record Call(GraphDeclaration.Group Group, GraphDeclaration.Recursive Recursive, int Depth, Scope Outer);

    /// <summary>What names mean in a term.</summary>
    private sealed record Scope(GraphFile File, ImmutableDictionary<string, Call> Calls, bool IsLinear)
    {
        /// <summary>What they mean in the terms that a name stands for.</summary>
        public Scope Elsewhere => IsLinear ? this : Of(File);

        public static Scope Of(GraphFile file) => new(file, ImmutableDictionary<string, Call>.Empty, false);
    }
}
