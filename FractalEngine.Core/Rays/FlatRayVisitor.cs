using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>
/// Finds the nearest hit of a ray in the frame of the whole fractal, to which bounds and triangles are mapped. For sub-fractals that maps
/// have flattened: in their own frames, the rounding of the ray would be larger than they are.
/// </summary>
/// <param name="ray">In the frame of the fractal.</param>
/// <param name="search">The state of the search so far.</param>
internal struct FlatRayVisitor(LocalRay ray, RaySearch search) : IShapeVisitor
{
    private readonly double _error = ray.InverseScale * search.Error;

    /// <summary>The state of the search.</summary>
    public RaySearch Search = search;

    /// <summary>The path to the nearest hit from where the walk began; null for none.</summary>
    public int[]? Path;

    /// <inheritdoc/>
    public readonly long MaxBoundTests => FractalRayCaster.MaxBoundTests;

    /// <inheritdoc/>
    public readonly double Measure(in ShapeNode node)
    {
        var margin = (node.Slack + _error) * Vector.One;
        var entry = RayBox.FindEntry(new BoundingBox(node.Box.Minimum - margin, node.Box.Maximum + margin), in ray);
        return entry + ray.Start <= Search.MaxDistance ? entry : double.PositiveInfinity;
    }

    /// <inheritdoc/>
    public bool Visit(int face, Vector a, Vector b, Vector c, in ShapeNode leaf, ReadOnlySpan<int> path)
    {
        Span<Vector256<double>> quad =
        [
            Vector256.Create(a.X), Vector256.Create(a.Y), Vector256.Create(a.Z),
            Vector256.Create(b.X), Vector256.Create(b.Y), Vector256.Create(b.Z),
            Vector256.Create(c.X), Vector256.Create(c.Y), Vector256.Create(c.Z),
        ];
        var before = Search.Face;
        if (!new TriangleRay(in ray, Search.Error + (leaf.Slack * ray.Scale)).TryIntersect(ref quad[0], ref Search))
        {
            Search.Face = before;
            return true;
        }

        Search.Face = face;
        Search.Proxy = null;
        Path = path.ToArray();
        return !Search.StopsAtFirst;
    }
}
