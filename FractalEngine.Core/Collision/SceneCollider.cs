using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Queries on all objects of a scene, in world space. The collider of a file is built when it is first asked for, once for all objects that
/// show the file; an object's own matrix is taken into account by each query, so that objects move for nothing.
/// </summary>
/// <remarks>
/// A matrix with a non-uniform scale does not keep distances in proportion: then the search itself takes it into account, which costs some
/// times more. The colliders that only approximate can't: there such an object has one of its own, for the place where the scene has it.
/// </remarks>
public sealed class SceneCollider
{
    private readonly ImmutableArray<ColliderInstance> _instances;
    private readonly Dictionary<Model, Lazy<Collider>> _sharedColliders;
    private readonly ColliderKind _kind;

    /// <summary>For a scene. Builds nothing yet.</summary>
    /// <param name="scene">With its files loaded.</param>
    /// <param name="kind">The collider of every object that it fits, see <see cref="ColliderFactory"/>.</param>
    public SceneCollider(LoadedScene scene, ColliderKind kind = ColliderKind.Exact)
    {
        _kind = kind;
        _sharedColliders =
            scene.Models.ToDictionary(model => model, model => new Lazy<Collider>(() => ColliderFactory.Create(model, kind)));
        _instances = [.. scene.Objects.Select(CreateInstance)];
    }

    private SceneCollider(ImmutableArray<ColliderInstance> instances, Dictionary<Model, Lazy<Collider>> sharedColliders,
        ColliderKind kind) => (_instances, _sharedColliders, _kind) = (instances, sharedColliders, kind);

    /// <summary>
    /// The same scene with one of its objects elsewhere. Colliders are shared; only the approximate ones of skewed objects are built anew.
    /// </summary>
    /// <param name="index">The object's place in the scene.</param>
    /// <param name="placed">The same model under another matrix.</param>
    public SceneCollider WithObject(int index, PlacedModel placed) =>
        new(_instances.SetItem(index, CreateInstance(placed)), _sharedColliders, _kind);

    /// <summary>The same scene with another object behind the others. Colliders that exist are shared.</summary>
    /// <param name="placed">Shares the collider of an object with the same model, if there is one.</param>
    internal SceneCollider WithAddedObject(PlacedModel placed)
    {
        var sharedColliders = _sharedColliders;
        if (!sharedColliders.ContainsKey(placed.Model))
        {
            sharedColliders = new(sharedColliders) { [placed.Model] = new(() => ColliderFactory.Create(placed.Model, _kind)) };
        }

        var withModel = new SceneCollider(_instances, sharedColliders, _kind);
        return new(_instances.Add(withModel.CreateInstance(placed)), sharedColliders, _kind);
    }

    private ColliderInstance CreateInstance(PlacedModel placed) => Similarity.TryCreate(placed.ObjectToWorld, out var similarity)
        ? new(_sharedColliders[placed.Model], similarity, null, placed.Bounds)
        : ColliderFactory.SupportsTransformedQueries(_kind)
            ? new(_sharedColliders[placed.Model], Similarity.Identity, placed.ObjectToWorld, placed.Bounds)
            : new(new(() => ColliderFactory.Create(placed, _kind)), Similarity.Identity, null, placed.Bounds);

    /// <summary>Bytes of the colliders built so far, each once.</summary>
    public long StorageBytes =>
        _instances.Select(instance => instance.Collider).Distinct().Where(collider => collider.IsValueCreated)
        .Sum(collider => collider.Value.StorageBytes);

    /// <summary>How many colliders there are, and how many of them have been built.</summary>
    public (int Built, int All) ColliderCounts
    {
        get
        {
            var colliders = _instances.Select(instance => instance.Collider).Distinct().ToArray();
            return (colliders.Count(static collider => collider.IsValueCreated), colliders.Length);
        }
    }

    /// <summary>Builds all colliders now instead of at their first query.</summary>
    public void Build()
    {
        foreach (var instance in _instances)
        {
            _ = instance.Collider.Value;
        }
    }

    /// <summary>Finds the nearest point of all objects.</summary>
    /// <param name="position">World space, finite.</param>
    /// <param name="maxDistance">Nothing farther away is looked at; may be infinite.</param>
    /// <param name="context">Receives the costs and the instance.</param>
    /// <param name="closest">The answer in world space, if there is one.</param>
    /// <param name="objectIndex">The number of the object in the scene, −1 for none.</param>
    /// <param name="excludedObject">An object that is not looked at, such as the one that asks; −1 for none.</param>
    /// <param name="epsilon">See <see cref="Collider.TryFindClosest"/>.</param>
    /// <returns>False when nothing lies within the distance.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite, or the distance or ε is negative or NaN.</exception>
    public bool TryFindClosest(
        Vector position, double maxDistance, QueryContext context, out ClosestPoint closest, out int objectIndex, int excludedObject = -1,
        double epsilon = 0)
    {
        Collider.ThrowIfInvalid(position, maxDistance, epsilon);
        (closest, objectIndex) = (default, -1);
        var boundDistances = context.ObjectBoundsBuffer(_instances.Length);
        for (var i = 0; i < _instances.Length; i++)
        {
            boundDistances[i] = i == excludedObject ? double.PositiveInfinity : Math.Sqrt(_instances[i].Bounds.DistanceSquared(position));
        }

        context.BoundTests += _instances.Length;
        for (var remaining = _instances.Length; remaining > 0; remaining--)
        {
            var nextObject = 0;
            for (var i = 1; i < boundDistances.Length; i++)
            {
                nextObject = boundDistances[i] < boundDistances[nextObject] ? i : nextObject;
            }

            if (!(boundDistances[nextObject] * (objectIndex < 0 ? 1 : 1 + epsilon) <= maxDistance)
                || double.IsPositiveInfinity(boundDistances[nextObject]))
            {
                break;
            }

            boundDistances[nextObject] = double.PositiveInfinity;
            if (_instances[nextObject].TryFindClosest(position, maxDistance, context, out var candidate, epsilon)
                && (objectIndex < 0 || candidate.Distance < closest.Distance))
            {
                (closest, objectIndex, maxDistance) = (candidate, nextObject, Math.Min(maxDistance, candidate.Distance));
                context.SavePath();
            }
        }

        context.RestorePath();
        return objectIndex >= 0;
    }

    /// <summary>An object.</summary>
    /// <param name="Collider">In the frame of its model.</param>
    /// <param name="Similarity">From that frame to world space.</param>
    /// <param name="GeneralMap">Instead of the similarity, where the object's matrix is none.</param>
    /// <param name="Bounds">In world space.</param>
    private sealed record ColliderInstance(Lazy<Collider> Collider, Similarity Similarity, AffineMap? GeneralMap, BoundingBox Bounds)
    {
        public bool TryFindClosest(Vector position, double maxDistance, QueryContext context, out ClosestPoint closest, double epsilon)
        {
            if (GeneralMap is { } map)
            {
                return Collider.Value.FindClosestTransformed(position, map, maxDistance, epsilon, context, out closest);
            }

            var isFound = Collider.Value.TryFindClosest(Similarity.ToLocal(position), maxDistance / Similarity.Scale, context,
                out var localClosest, epsilon);
            closest = isFound ? Similarity.ToWorld(localClosest) : default;
            return isFound;
        }
    }
}
