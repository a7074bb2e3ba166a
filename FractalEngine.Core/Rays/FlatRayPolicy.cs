using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Regions;

namespace FractalEngine.Core.Rays;

/// <summary>
/// Finds the nearest hit of a ray in the frame of the whole fractal, to which bounds and triangles are mapped. For sub-fractals that maps
/// have flattened: in their own frames, the rounding of the ray would be larger than they are.
/// </summary>
/// <param name="ray">In the frame of the fractal.</param>
/// <param name="search">The state of the search so far.</param>
internal struct FlatRayPolicy(LocalRay ray, RaySearch search) : ITraversalPolicy
{
    private readonly double _error = ray.InverseScale * search.Error;

    /// <summary>The state of the search.</summary>
    public RaySearch Search = search;

    /// <summary>The path to the nearest hit from where the traversal began; null for none.</summary>
    public int[]? Path;

    /// <inheritdoc/>
    /// <remarks>Less by the faces that were tested.</remarks>
    public readonly long MaxBoundTests => FractalRayCaster.MaxTests - Search.FaceTests;

    /// <inheritdoc/>
    /// <remarks>Flattened parts are so few that their own bounds suffice.</remarks>
    public readonly Vector256<double> MayCountX4(VectorX4 centres, VectorX4 extents, double slack) => Vector256<double>.AllBitsSet;

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
        // From near the triangle: with the way to it grows what rounding hides of a triangle seen nearly edge on.
        var entry = Measure(in leaf);
        var near = double.IsFinite(entry) ? ray.Advance(entry) : ray;
        if (!new TriangleRay(in near, Search.Error + (leaf.Slack * ray.Scale)).TryIntersect(ref quad[0], ref Search))
        {
            Search.Face = before;
            return true;
        }

        Search.Face = face;
        Search.MeshIndex = leaf.BaseIndex;
        Search.Proxy = null;
        Path = path.ToArray();
        return !Search.StopsAtFirst;
    }
}
