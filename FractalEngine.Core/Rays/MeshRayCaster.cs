using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>Casts rays at a mesh.</summary>
internal sealed class MeshRayCaster(Mesh mesh) : RayCaster
{
    private readonly TriangleBvh _bvh = TriangleBvh.For(mesh);

    /// <inheritdoc/>
    public override long StorageBytes => _bvh.StorageBytes;

    /// <inheritdoc/>
    internal override Mesh Mesh => mesh;

    /// <inheritdoc/>
    private protected override double ShapeMagnitude { get; } = BoundingVolume.MaxAbsCoordinate(mesh.Bounds);

    /// <inheritdoc/>
    internal override bool TryIntersect(in LocalRay ray, ref RaySearch search, QueryContext context, ref int pathLength)
    {
        if (!_bvh.TryIntersect(in ray, ref search))
        {
            return false;
        }

        pathLength = 0;
        return true;
    }

    /// <inheritdoc/>
    internal override SimdAffineMap ResolveInstance(in RaySearch search, int pathLength, in AffineMap map, QueryContext context)
    {
        context.ClearPath();
        return new(map);
    }
}
