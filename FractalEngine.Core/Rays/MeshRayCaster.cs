using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
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
    internal override bool FindNearestCore(
        Vector origin, Vector unitDirection, double minDistance, double maxDistance, QueryContext context, out RayHit hit)
    {
        var search = Search(origin, unitDirection, minDistance, maxDistance, stopsAtFirst: false, context);
        hit = search.Face < 0
            ? default
            : RayHitFactory.Create(
                origin, unitDirection, search.MaxDistance, minDistance, maxDistance, mesh.Face(search.Face), search.Face);
        return search.Face >= 0;
    }

    /// <inheritdoc/>
    internal override bool HitsAnyCore(
        Vector origin, Vector unitDirection, double minDistance, double maxDistance, QueryContext context) =>
        Search(origin, unitDirection, minDistance, maxDistance, stopsAtFirst: true, context).Face >= 0;

    private RaySearch Search(
        Vector origin, Vector unitDirection, double minDistance, double maxDistance, bool stopsAtFirst, QueryContext context)
    {
        context.ClearPath();
        var ray = LocalRay.Of(origin, unitDirection, minDistance);
        var search = new RaySearch(minDistance, maxDistance, stopsAtFirst, RoundingError(origin, minDistance, mesh.Bounds));
        _bvh.TryHit(in ray, ref search);
        context.Statistics.FaceTests += search.FaceTests;
        context.Statistics.BoundTests += search.BoundTests;
        return search;
    }
}
