using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Makes the fractal of a model in code, as callers of the library do, without its files.</summary>
internal sealed class GraphCode
{
    private static readonly ImmutableDictionary<string, Fractal> NoCalls = ImmutableDictionary<string, Fractal>.Empty;

    private readonly Dictionary<OracleMesh, Fractal> _meshes = new(ReferenceEqualityComparer.Instance);

    /// <summary>Makes a fractal; null for a model with recursives that call each other, for which there is no call.</summary>
    public static Fractal? TryMake(GraphFile file)
    {
        try
        {
            return new GraphCode().Make(file.Result, file, NoCalls);
        }
        catch (NotSupportedException)
        {
            return null;
        }
    }

    private Fractal Make(ObjectTerm term, GraphFile file, ImmutableDictionary<string, Fractal> calls)
    {
        switch (term)
        {
            case ObjectTerm.Mesh(var mesh):
                return Find(mesh);
            case ObjectTerm.File(var other):
                return Make(other.Result, other, NoCalls);
            case ObjectTerm.Named(var name) when calls.TryGetValue(name, out var call):
                return call;
            case ObjectTerm.Named(var name):
                return file.Find(name) is GraphDeclaration.Alias alias ? Make(alias.Body, file, NoCalls) : Find(OracleMesh.Shape(name));
            case ObjectTerm.AtDepth(var name, var depth):
                return file.Find(name) is GraphDeclaration.Group { Recursives: [var recursive] }
                    ? Fractal.Recurse(
                        Make(new ObjectTerm.Named(recursive.Base), file, NoCalls), depth,
                        self => Make(recursive.Body, file, NoCalls.Add(recursive.Base, self)))
                    : throw new NotSupportedException("recursives that call each other");
            case ObjectTerm.Mapped(var set, var inner):
                var maps = set.SelectMany(static product => RowMap.AllOf(product)).Select(static map => map.ToAffineMap());
                return Make(inner, file, calls).Repeat([new TransformationSet([.. maps])], 1);
            case ObjectTerm.Sum(var terms):
                return Fractal.Sum(terms.Select(part => Make(part, file, calls)));
            default:
                throw new InvalidOperationException("a term of another kind");
        }
    }

    private Fractal Find(OracleMesh mesh)
    {
        if (!_meshes.TryGetValue(mesh, out var fractal))
        {
            fractal = Fractal.Of(BaseShapes.TryFind(mesh.Name, out var shape)
                ? shape!
                : new Mesh([.. mesh.Vertices.SelectMany(static v => new[] { v.X, v.Y, v.Z })], mesh.Indices));
            _meshes.Add(mesh, fractal);
        }

        return fractal;
    }
}
