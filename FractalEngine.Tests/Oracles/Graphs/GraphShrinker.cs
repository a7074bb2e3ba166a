using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Makes a model that fails smaller, as long as it fails in the same way.</summary>
internal static class GraphShrinker
{
    /// <summary>Takes one small step after the other, until none is left that keeps the failure.</summary>
    /// <param name="file">A model that fails.</param>
    /// <param name="fails">Whether a model fails in the same way.</param>
    /// <param name="maxTrials">Number of models beyond which the search ends.</param>
    public static GraphFile Shrink(GraphFile file, Func<GraphFile, bool> fails, int maxTrials = 3000)
    {
        var trials = 0;
        for (var current = file; ;)
        {
            var smaller = Variants(current).Select(Prune).Where(_ => trials < maxTrials).FirstOrDefault(variant =>
            {
                trials++;
                return fails(variant);
            });
            if (smaller is null)
            {
                return current;
            }

            current = smaller;
        }
    }

    /// <summary>Removes declarations that the result does not lead to.</summary>
    private static GraphFile Prune(GraphFile file)
    {
        HashSet<string> used = [.. Names(file.Result)];
        foreach (var declaration in file.Declarations.Reverse().Where(declaration => declaration.Names.Any(used.Contains)))
        {
            used.UnionWith(declaration switch
            {
                GraphDeclaration.Alias alias => Names(alias.Body),
                GraphDeclaration.Group group => group.Recursives.SelectMany(static item => Names(item.Body).Append(item.Base)),
                _ => [],
            });
        }

        return file with
        {
            Declarations =
            [
                .. file.Declarations.Where(
                    declaration => declaration is GraphDeclaration.Seed || declaration.Names.Any(used.Contains)),
            ],
        };
    }

    private static IEnumerable<string> Names(ObjectTerm term) => term switch
    {
        ObjectTerm.Named(var name) => [name],
        ObjectTerm.AtDepth(var name, _) => [name],
        ObjectTerm.Until(var name, _) => [name],
        ObjectTerm.Choice(var alternatives) => alternatives.SelectMany(static one => Names(one.Term)),
        ObjectTerm.Mapped(_, var inner) => Names(inner),
        ObjectTerm.Sum(var terms) => terms.SelectMany(Names),
        _ => [],
    };

    private static IEnumerable<GraphFile> Variants(GraphFile file)
    {
        foreach (var result in Variants(file.Result, file))
        {
            yield return file with { Result = result };
        }

        foreach (var smaller in WithSmallerMeshes(file))
        {
            yield return smaller;
        }

        for (var i = 0; i < file.Declarations.Length; i++)
        {
            if (file.Declarations[i] is GraphDeclaration.Seed)
            {
                yield return file with { Declarations = file.Declarations.RemoveAt(i) };
            }

            foreach (var declaration in Variants(file.Declarations[i], file))
            {
                yield return file with { Declarations = file.Declarations.SetItem(i, declaration) };
            }
        }
    }

    private static IEnumerable<GraphDeclaration> Variants(GraphDeclaration declaration, GraphFile file)
    {
        if (declaration is GraphDeclaration.Alias alias)
        {
            foreach (var body in Variants(alias.Body, file))
            {
                yield return alias with { Body = body };
            }
        }
        else if (declaration is GraphDeclaration.Seed(not 1, var isByLevel))
        {
            yield return new GraphDeclaration.Seed(1, isByLevel);
        }
        else if (declaration is GraphDeclaration.Group group)
        {
            for (var i = 0; i < group.Recursives.Length; i++)
            {
                foreach (var body in Variants(group.Recursives[i].Body, file))
                {
                    yield return new GraphDeclaration.Group(
                        group.Recursives.SetItem(i, group.Recursives[i] with { Body = body }));
                }

                if (group.Recursives.Length > 1)
                {
                    yield return new GraphDeclaration.Group(group.Recursives.RemoveAt(i));
                }
            }
        }
    }

    private static IEnumerable<ObjectTerm> Variants(ObjectTerm term, GraphFile file)
    {
        switch (term)
        {
            case ObjectTerm.Named(var name) when file.Find(name) is GraphDeclaration.Alias alias:
                yield return alias.Body;
                break;
            case ObjectTerm.File(var other):
                yield return other.Result is ObjectTerm.Mesh ? other.Result : new ObjectTerm.Named("plate");
                foreach (var smaller in Variants(other))
                {
                    yield return new ObjectTerm.File(Prune(smaller));
                }

                break;
            case ObjectTerm.AtDepth(var name, > 0 and var depth):
                yield return new ObjectTerm.AtDepth(name, 0);
                yield return new ObjectTerm.AtDepth(name, depth - 1);
                break;
            case ObjectTerm.Until(var name, var size):
                yield return new ObjectTerm.AtDepth(name, 0);
                yield return new ObjectTerm.AtDepth(name, 1);
                yield return new ObjectTerm.AtDepth(name, 2);
                foreach (var larger in (double[])[2 * size, Math.Round(size, 1), Math.Round(size)])
                {
                    if (larger > 0 && larger != size && larger < 1e6)
                    {
                        yield return new ObjectTerm.Until(name, larger);
                    }
                }

                break;
            case ObjectTerm.Choice(var alternatives):
                foreach (var (_, alternative) in alternatives)
                {
                    yield return alternative;
                }

                for (var i = 0; i < alternatives.Length; i++)
                {
                    if (alternatives.Length > 1)
                    {
                        yield return new ObjectTerm.Choice(alternatives.RemoveAt(i));
                    }

                    var (weight, alternative) = alternatives[i];
                    if (weight is not 0 and not 1)
                    {
                        yield return new ObjectTerm.Choice(alternatives.SetItem(i, (1, alternative)));
                    }

                    foreach (var smaller in Variants(alternative, file))
                    {
                        yield return new ObjectTerm.Choice(alternatives.SetItem(i, (weight, smaller)));
                    }
                }

                break;
            case ObjectTerm.Mapped(var set, var inner):
                yield return inner;
                foreach (var smaller in set.Length > 1 ? set.Select((_, i) => set.RemoveAt(i)) : [])
                {
                    yield return new ObjectTerm.Mapped(smaller, inner);
                }

                foreach (var (smaller, i) in set.SelectMany((product, i) => Variants(product).Select(smaller => (smaller, i))))
                {
                    yield return new ObjectTerm.Mapped(set.SetItem(i, smaller), inner);
                }

                foreach (var smaller in Variants(inner, file))
                {
                    yield return new ObjectTerm.Mapped(set, smaller);
                }

                break;
            case ObjectTerm.Sum(var terms):
                foreach (var part in terms)
                {
                    yield return part;
                }

                for (var i = 0; i < terms.Length; i++)
                {
                    if (terms.Length > 2)
                    {
                        yield return new ObjectTerm.Sum(terms.RemoveAt(i));
                    }

                    foreach (var smaller in Variants(terms[i], file))
                    {
                        yield return new ObjectTerm.Sum(terms.SetItem(i, smaller));
                    }
                }

                break;
        }
    }

    /// <summary>Meshes with fewer triangles, wherever they are used.</summary>
    private static IEnumerable<GraphFile> WithSmallerMeshes(GraphFile file)
    {
        foreach (var mesh in MeshesIn(file).Distinct().Where(static mesh => mesh.FaceCount > 1))
        {
            var middle = 3 * (mesh.FaceCount / 2);
            yield return Replace(file, mesh, mesh with { Indices = mesh.Indices[..middle] });
            yield return Replace(file, mesh, mesh with { Indices = mesh.Indices[middle..] });
        }
    }

    private static IEnumerable<OracleMesh> MeshesIn(GraphFile file) => file.Declarations.SelectMany(static declaration => declaration switch
    {
        GraphDeclaration.Alias alias => MeshesIn(alias.Body),
        GraphDeclaration.Group group => group.Recursives.SelectMany(static item => MeshesIn(item.Body)),
        _ => [],
    }).Concat(MeshesIn(file.Result));

    private static IEnumerable<OracleMesh> MeshesIn(ObjectTerm term) => term switch
    {
        ObjectTerm.Mesh(var mesh) => [mesh],
        ObjectTerm.File(var other) => MeshesIn(other),
        ObjectTerm.Choice(var alternatives) => alternatives.SelectMany(static one => MeshesIn(one.Term)),
        ObjectTerm.Mapped(_, var inner) => MeshesIn(inner),
        ObjectTerm.Sum(var terms) => terms.SelectMany(MeshesIn),
        _ => [],
    };

    private static GraphFile Replace(GraphFile file, OracleMesh mesh, OracleMesh other)
    {
        return file with { Declarations = [.. file.Declarations.Select(ReplaceInDeclaration)], Result = ReplaceInTerm(file.Result) };

        GraphDeclaration ReplaceInDeclaration(GraphDeclaration declaration) => declaration switch
        {
            GraphDeclaration.Alias alias => alias with { Body = ReplaceInTerm(alias.Body) },
            GraphDeclaration.Group group => new GraphDeclaration.Group(
                [.. group.Recursives.Select(item => item with { Body = ReplaceInTerm(item.Body) })]),
            _ => declaration,
        };

        ObjectTerm ReplaceInTerm(ObjectTerm term) => term switch
        {
            ObjectTerm.Mesh(var found) when ReferenceEquals(found, mesh) => new ObjectTerm.Mesh(other),
            ObjectTerm.File(var inner) => new ObjectTerm.File(Replace(inner, mesh, other)),
            ObjectTerm.Mapped(var set, var inner) => new ObjectTerm.Mapped(set, ReplaceInTerm(inner)),
            ObjectTerm.Choice(var alternatives) => new ObjectTerm.Choice(
                [.. alternatives.Select(one => (one.Weight, ReplaceInTerm(one.Term)))]),
            ObjectTerm.Sum(var terms) => new ObjectTerm.Sum([.. terms.Select(ReplaceInTerm)]),
            _ => term,
        };
    }

    private static IEnumerable<MapProduct> Variants(MapProduct product)
    {
        for (var i = 0; i < product.Factors.Length; i++)
        {
            if (product.Factors.Length > 1)
            {
                yield return new(product.Factors.RemoveAt(i));
            }

            foreach (var smaller in Variants(product.Factors[i]))
            {
                yield return new(product.Factors.SetItem(i, smaller));
            }
        }
    }

    private static IEnumerable<MapPower> Variants(MapPower power)
    {
        if (power.Leaf is MapLeaf.Identity)
        {
            yield break;
        }

        yield return new(new MapLeaf.Identity());
        if ((power.Low, power.High) != (1, 1))
        {
            yield return power with { Low = 1, High = 1 };
        }

        if (power.Low < power.High)
        {
            yield return power with { High = power.High - 1 };
            yield return power with { Low = power.Low + 1 };
        }

        foreach (var leaf in power.Leaf is MapLeaf.Placement placement ? Variants(placement) : [])
        {
            yield return power with { Leaf = leaf };
        }
    }

    private static IEnumerable<MapLeaf> Variants(MapLeaf.Placement placement)
    {
        foreach (var (vector, with) in (ImmutableArray<(Vector?, Func<Vector?, MapLeaf>)>)
            [
                (placement.Position, v => placement with { Position = v }),
                (placement.Rotation, v => placement with { Rotation = v }),
                (placement.Scale, v => placement with { Scale = v }),
            ])
        {
            if (vector is { } v)
            {
                yield return with(null);
                Vector rounded = new(Math.Round(v.X, 1), Math.Round(v.Y, 1), Math.Round(v.Z, 1));
                if (rounded != v && rounded is { X: not 0, Y: not 0, Z: not 0 })
                {
                    yield return with(rounded);
                }
            }
        }
    }
}
