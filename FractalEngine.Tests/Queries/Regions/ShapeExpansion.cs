using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Queries.Regions;

/// <summary>All triangles of a small fractal or mesh, chain by chain. Queries are compared with it; it searches nothing.</summary>
internal sealed class ShapeExpansion
{
    private readonly Fractal _fractal;

    public ShapeExpansion(Fractal fractal)
    {
        _fractal = fractal;
        List<(AffineMap Map, double Reach)> chains = [(AffineMap.Identity, 0)];
        for (var level = 0L; level < fractal.LevelCount; level++)
        {
            var maps = fractal.LevelAt(level).Maps;
            HasEqualInstances |= maps.Contains(AffineMap.Identity) || maps.Distinct().Count() < maps.Length;
            chains = [.. from chain in chains from map in maps select Compose(chain, map)];
        }

        Triangles = [.. from chain in chains from face in Enumerable.Range(0, fractal.BaseMesh.FaceCount) select Create(chain, face)];
        Magnitude = Triangles.Select(triangle => triangle.Reach).DefaultIfEmpty(1).Max();
    }

    public ExpandedTriangle[] Triangles { get; }

    /// <summary>The largest reach of a triangle.</summary>
    public double Magnitude { get; }

    /// <summary>Number of levels.</summary>
    public long Levels => _fractal.LevelCount!.Value;

    /// <summary>True where chains differ only in their identities or in equal maps, so that a query finds one of them.</summary>
    public bool HasEqualInstances { get; }

    /// <summary>
    /// The face of an instance. A path that is too short goes on with identities, or the levels below are too small to matter.
    /// </summary>
    public ExpandedTriangle Resolve(ReadOnlySpan<int> path, int face)
    {
        var chain = (AffineMap.Identity, 0.0);
        for (var level = 0; level < path.Length; level++)
        {
            chain = Compose(chain, _fractal.LevelAt(level).Maps[path[level]]);
        }

        return Create(chain, face);
    }

    private static (AffineMap Map, double Reach) Compose((AffineMap Map, double Reach) chain, AffineMap map)
    {
        var composed = chain.Map * map;
        return (composed, Math.Max(chain.Reach, composed.Translation.MaxAbsComponent()));
    }

    private ExpandedTriangle Create((AffineMap Map, double Reach) chain, int face)
    {
        var (a, b, c) = _fractal.BaseMesh.Face(face);
        var reach = Math.Max(a.MaxAbsComponent(), Math.Max(b.MaxAbsComponent(), c.MaxAbsComponent()));
        (a, b, c) = (chain.Map * a, chain.Map * b, chain.Map * c);
        reach = Math.Max(reach, Math.Max(a.MaxAbsComponent(), Math.Max(b.MaxAbsComponent(), c.MaxAbsComponent())));
        return new(face, a, b, c, Math.Max(chain.Reach, reach));
    }
}
