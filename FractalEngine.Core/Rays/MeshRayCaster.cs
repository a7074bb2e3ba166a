using System.Runtime.CompilerServices;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Rays;

/// <summary>Casts rays at a mesh, or at all faces of a fractal that has no levels to search.</summary>
internal sealed class MeshRayCaster(Mesh mesh, Mesh faces) : ShapeRayCaster
{
    // The instances of an expanded fractal, in the order of their faces; none for a mesh.
    private readonly AffineMap[] _instances = [];
    private readonly TriangleBvh _bvh = TriangleBvh.For(faces);

    /// <summary>Prepares a mesh for rays.</summary>
    public MeshRayCaster(Mesh mesh)
        : this(mesh, mesh)
    {
    }

    /// <summary>Expands a fractal, and prepares all its faces for rays.</summary>
    /// <exception cref="FractalLimitException">It has more than <see cref="ColliderFactory.MaxExpandedFaces"/> faces.</exception>
    public MeshRayCaster(Fractal fractal)
        : this(fractal.BaseMesh, ColliderFactory.Expand(fractal, AffineMap.Identity, out var instances)) => _instances = instances;

    /// <inheritdoc/>
    public override long StorageBytes => _bvh.StorageBytes + (_instances.Length * (long)Unsafe.SizeOf<AffineMap>());

    /// <inheritdoc/>
    private protected override double ShapeMagnitude { get; } = QueryScale.Magnitude(faces);

    /// <inheritdoc/>
    internal override Mesh MeshOf(in RaySearch search) => mesh;

    /// <inheritdoc/>
    internal override bool TryIntersect(in LocalRay ray, ref RaySearch search, QueryContext context, ref int pathLength)
    {
        if (!_bvh.Rays.TryIntersect(in ray, ref search))
        {
            return false;
        }

        pathLength = 0;
        if (_instances.Length > 0)
        {
            pathLength = 1;
            (context.BestPathBuffer(1)[0], search.Face) = Math.DivRem(search.Face, mesh.FaceCount);
        }

        return true;
    }

    /// <inheritdoc/>
    internal override SimdAffineMap ResolveInstance(in RaySearch search, int pathLength, in AffineMap map, QueryContext context)
    {
        context.ClearPath();
        return new(pathLength == 0 ? map : map * _instances[context.BestPathBuffer(1)[0]]);
    }
}
