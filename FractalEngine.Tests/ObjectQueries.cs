using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;

namespace FractalEngine.Tests;

/// <summary>Queries that also return what the context says of the object, for tests that compare both.</summary>
internal static class ObjectQueries
{
    public static bool TryFindClosest(
        this SceneCollider scene, Vector position, double maxDistance, QueryContext context, out ClosestPoint closest, out int objectIndex,
        int excludedObject = -1, double epsilon = 0)
    {
        var isFound = scene.TryFindClosest(position, maxDistance, context, out closest, epsilon, excludedObject);
        objectIndex = context.ObjectIndex;
        return isFound;
    }

    public static bool TryFindNearest(
        this RayCaster caster, Ray ray, QueryContext context, out RayHit hit, out int objectIndex, double minDistance = 0,
        double maxDistance = double.PositiveInfinity, RayFootprint footprint = default)
    {
        var isHit = caster.TryFindNearest(ray, context, out hit, minDistance, maxDistance, footprint);
        objectIndex = context.ObjectIndex;
        return isHit;
    }
}
