using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Tests.Colliders;

/// <summary>The queries of <see cref="SceneCollider"/> by testing the boxes of all objects, each time for the closest one left.</summary>
internal sealed class LinearSceneSearch(IReadOnlyList<PlacedModel> objects, ColliderKind kind)
{
    private readonly Dictionary<Model, Collider> _colliders =
        objects.Select(placed => placed.Model).Distinct().ToDictionary(model => model, model => model.CreateCollider(kind));

    public bool TryFindClosest(
        Vector position, double maxDistance, QueryContext context, out ClosestPoint closest, out int objectIndex, int excludedObject = -1,
        double epsilon = 0)
    {
        closest = default;
        objectIndex = -1;
        var bounds = objects.Select((placed, index) => index == excludedObject
            ? double.PositiveInfinity : Math.Sqrt(placed.Bounds.DistanceSquared(position))).ToArray();
        var remaining = Enumerable.Range(0, objects.Count).ToList();
        while (remaining.Count > 0)
        {
            var next = remaining.MinBy(index => (bounds[index], index));
            if (!(bounds[next] * (objectIndex < 0 ? 1 : 1 + epsilon) <= maxDistance) || double.IsPositiveInfinity(bounds[next]))
            {
                break;
            }

            remaining.Remove(next);
            if (TestObject(next, position, maxDistance, context, epsilon, out var candidate)
                && (objectIndex < 0 || candidate.Distance < closest.Distance))
            {
                closest = candidate;
                objectIndex = next;
                maxDistance = Math.Min(maxDistance, candidate.Distance);
                context.SaveInstance();
            }
        }

        if (objectIndex < 0)
        {
            context.ClearPath();
        }
        else
        {
            context.RestoreInstance();
        }

        return objectIndex >= 0;
    }

    private bool TestObject(
        int index, Vector position, double maxDistance, QueryContext context, double epsilon, out ClosestPoint closest)
    {
        var placed = objects[index];
        var collider = _colliders[placed.Model];
        if (!Similarity.TryCreate(placed.ObjectToWorld, out var similarity))
        {
            return collider.FindClosestTransformed(position, placed.ObjectToWorld, maxDistance, epsilon, context, out closest);
        }

        var isFound = collider.TryFindClosest(
            similarity.ToLocal(position), maxDistance / similarity.Scale, context, out var local, epsilon);
        closest = isFound ? similarity.ToWorld(local) : default;
        return isFound;
    }
}
