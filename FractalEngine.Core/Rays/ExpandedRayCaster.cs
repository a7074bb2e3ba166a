using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>Casts rays at all faces of a fractal that has no levels to search, and tells their instances.</summary>
internal sealed class ExpandedRayCaster : RayCaster
{
    private readonly AffineMap[] _instances;
    private readonly TriangleBvh _bvh;

    /// <summary>Expands a fractal into one mesh, whose faces know their instances by their order.</summary>
    /// <exception cref="FractalLimitException">It has more than <see cref="ColliderFactory.MaxExpandedFaces"/> faces.</exception>
    public ExpandedRayCaster(Fractal fractal)
    {
        Mesh = fractal.BaseMesh;
        var expansion = ColliderFactory.Expand(fractal, AffineMap.Identity, out _instances);
        _bvh = TriangleBvh.For(expansion);
        ShapeMagnitude = BoundingVolume.MaxAbsCoordinate(expansion.Bounds);
    }

    /// <inheritdoc/>
    public override long StorageBytes => _bvh.StorageBytes;

    /// <inheritdoc/>
    internal override Mesh Mesh { get; }

    /// <inheritdoc/>
    private protected override double ShapeMagnitude { get; }

    /// <inheritdoc/>
    internal override bool TryIntersect(in LocalRay ray, ref RaySearch search, QueryContext context, ref int pathLength)
    {
        if (!_bvh.TryIntersect(in ray, ref search))
        {
            return false;
        }

        pathLength = 1;
        (context.BestPathBuffer(1)[0], search.Face) = Math.DivRem(search.Face, Mesh.FaceCount);
        return true;
    }

    /// <inheritdoc/>
    internal override SimdAffineMap ResolveInstance(in RaySearch search, int pathLength, in AffineMap map, QueryContext context)
    {
        context.ClearPath();
        return new(map * _instances[context.BestPathBuffer(1)[0]]);
    }
}
