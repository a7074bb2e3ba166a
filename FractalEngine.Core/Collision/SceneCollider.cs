using System.Collections.Immutable;
using System.Diagnostics.CodeAnalysis;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Finds closest points on all objects of a scene, in world space. The collider of a model is built when it is first needed, once for all
/// objects that show the model. Each query takes the object's own matrix into account, so that moving an object costs nothing.
/// </summary>
/// <remarks>
/// A skewed matrix (one that is no similarity) does not keep distances in proportion: then the search itself takes it into account, which
/// costs several times more. The approximate colliders can't, so such an object gets one of its own, in world space.
/// </remarks>
public sealed class SceneCollider
{
    private readonly ImmutableArray<ColliderInstance> _instances;
    private readonly Dictionary<Model, Lazy<Collider>> _sharedColliders;
    private readonly ColliderKind _kind;
    private readonly SpareContext _spareContext = new();

    /// <summary>Prepares the colliders of a scene made in code, or loaded from a file. Builds none of them yet.</summary>
    /// <param name="scene">With its models.</param>
    /// <param name="kind">The collider of all objects, see <see cref="ColliderFactory"/>.</param>
    /// <exception cref="FractalEngineException">An object names a file that is not loaded.</exception>
    public SceneCollider(Scene scene, ColliderKind kind = ColliderKind.Exact)
        : this(LoadedScene.Of(scene), kind)
    {
    }

    /// <summary>Prepares the colliders of a scene. Builds none of them yet.</summary>
    /// <param name="scene">With its models.</param>
    /// <param name="kind">The collider of all objects, see <see cref="ColliderFactory"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such kind.</exception>
    public SceneCollider(LoadedScene scene, ColliderKind kind = ColliderKind.Exact)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ColliderFactory.ThrowIfUnknown(kind);
        _kind = kind;
        _sharedColliders =
            scene.Models.ToDictionary(model => model, model => new Lazy<Collider>(() => CreateCollider(model)));
        _instances = [.. scene.Objects.Select(CreateInstance)];
    }

    private SceneCollider(
        ImmutableArray<ColliderInstance> instances, Dictionary<Model, Lazy<Collider>> sharedColliders, ColliderKind kind)
    {
        _instances = instances;
        _sharedColliders = sharedColliders;
        _kind = kind;
    }

    /// <summary>
    /// Makes the collider of the same scene with one of its objects elsewhere. Colliders are shared; only the approximate ones of skewed
    /// objects are built anew.
    /// </summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="placed">The same model under another matrix.</param>
    /// <exception cref="ArgumentOutOfRangeException">The scene has no such object.</exception>
    /// <exception cref="ArgumentException">No object of the scene shows the model.</exception>
    public SceneCollider WithObject(int index, PlacedModel placed)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(index);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(index, _instances.Length);
        ArgumentNullException.ThrowIfNull(placed);
        if (!_sharedColliders.ContainsKey(placed.Model))
        {
            throw new ArgumentException("expected the model of an object of the scene", nameof(placed));
        }

        return new(_instances.SetItem(index, CreateInstance(placed)), _sharedColliders, _kind);
    }

    /// <summary>Makes the collider of the same scene with another object behind the others. Colliders that exist are shared.</summary>
    /// <param name="placed">Shares the collider of an object with the same model, if there is one.</param>
    internal SceneCollider WithAddedObject(PlacedModel placed)
    {
        var sharedColliders = _sharedColliders;
        if (!sharedColliders.ContainsKey(placed.Model))
        {
            sharedColliders = new(sharedColliders) { [placed.Model] = new(() => CreateCollider(placed.Model)) };
        }

        var withModel = new SceneCollider(_instances, sharedColliders, _kind);
        return new(_instances.Add(withModel.CreateInstance(placed)), sharedColliders, _kind);
    }

    private ColliderInstance CreateInstance(PlacedModel placed) => Similarity.TryCreate(placed.ObjectToWorld, out var similarity)
        ? new(_sharedColliders[placed.Model], similarity, null, placed.Bounds)
        : ColliderFactory.SupportsTransformedQueries(_kind)
            ? new(_sharedColliders[placed.Model], Similarity.Identity, placed.ObjectToWorld, placed.Bounds)
            : new(new(() => CreateCollider(placed)), Similarity.Identity, null, placed.Bounds);

    private Collider CreateCollider(Model model) => NameMismatch(model, () => ColliderFactory.Create(model, _kind));

    private Collider CreateCollider(PlacedModel placed) => NameMismatch(placed.Model, () => ColliderFactory.Create(placed, _kind));

    /// <summary>Says which model a collider does not fit.</summary>
    private static Collider NameMismatch(Model model, Func<Collider> create)
    {
        try
        {
            return create();
        }
        catch (ColliderMismatchException exception)
        {
            throw new ColliderMismatchException($"{model.Name}: {exception.Message}", exception);
        }
    }

    /// <summary>Bytes of the colliders built so far, each once.</summary>
    public long StorageBytes =>
        _instances.Select(instance => instance.Collider).Distinct().Where(collider => collider.IsValueCreated)
        .Sum(collider => collider.Value.StorageBytes);

    /// <summary>Number of colliders that have been built, and of all.</summary>
    public (int Built, int All) ColliderCounts
    {
        get
        {
            var colliders = _instances.Select(instance => instance.Collider).Distinct().ToArray();
            return (colliders.Count(static collider => collider.IsValueCreated), colliders.Length);
        }
    }

    /// <summary>Builds all colliders now instead of at their first query.</summary>
    /// <exception cref="ColliderMismatchException">The kind does not fit a model, which the message names.</exception>
    /// <exception cref="FractalLimitException">A fractal is too large for the kind.</exception>
    public void Build()
    {
        foreach (var instance in _instances)
        {
            _ = instance.Collider.Value;
        }
    }

    /// <summary>Finds the point of the scene closest to a position.</summary>
    /// <param name="position">World space, finite.</param>
    /// <returns>The closest point with its normal, face, instance and object.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite.</exception>
    /// <exception cref="InvalidOperationException">
    /// The scene has no faces, or none at a distance within the range of a double.
    /// </exception>
    public ClosestHit FindClosest(Vector position) => TryFindClosest(position, double.PositiveInfinity, out var hit)
        ? hit
        : throw new InvalidOperationException(
            $"no point of the scene is closest to {position}: it has no faces, or the distance is beyond the range of a double");

    /// <summary>Finds the point of the scene closest to a position, if one is near enough.</summary>
    /// <param name="position">World space, finite.</param>
    /// <param name="maxDistance">Search radius, scene units, not negative; may be infinite.</param>
    /// <param name="hit">The closest point with its normal, face, instance and object; null where there is none.</param>
    /// <returns>False when no face lies within the radius.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite, or the radius is negative or NaN.</exception>
    public bool TryFindClosest(Vector position, double maxDistance, [NotNullWhen(true)] out ClosestHit? hit)
    {
        var context = _spareContext.Take();
        hit = TryFindClosest(position, maxDistance, context, out var closest, out var objectIndex)
            ? ClosestHit.Of(closest, context, objectIndex)
            : null;
        _spareContext.Return(context);
        return hit is not null;
    }

    /// <summary>Finds the point of the scene closest to a position, and adds up what that costs.</summary>
    /// <param name="position">World space, finite.</param>
    /// <param name="maxDistance">Search radius, scene units, not negative; may be infinite.</param>
    /// <param name="context">Receives the costs and the instance; one for each thread.</param>
    /// <param name="closest">The closest point in world space, if there is one.</param>
    /// <param name="objectIndex">Index of the object in the scene, −1 for none.</param>
    /// <param name="excludedObject">Index of an object that is not tested, such as the querying body's own; −1 for none.</param>
    /// <param name="epsilon">Allowed relative error, see <see cref="Collider"/>.</param>
    /// <returns>False when no face lies within the radius.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite, or the radius or ε is negative or NaN.</exception>
    public bool TryFindClosest(
        Vector position, double maxDistance, QueryContext context, out ClosestPoint closest, out int objectIndex, int excludedObject = -1,
        double epsilon = 0)
    {
        ArgumentNullException.ThrowIfNull(context);
        Collider.ThrowIfInvalid(position, maxDistance, epsilon);
        closest = default;
        objectIndex = -1;
        var boundDistances = context.ObjectBoundsBuffer(_instances.Length);
        for (var i = 0; i < _instances.Length; i++)
        {
            boundDistances[i] = i == excludedObject ? double.PositiveInfinity : Math.Sqrt(_instances[i].Bounds.DistanceSquared(position));
        }

        context.Statistics.BoundTests += _instances.Length;
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
                closest = candidate;
                objectIndex = nextObject;
                maxDistance = Math.Min(maxDistance, candidate.Distance);
                context.SavePath();
            }
        }

        context.RestorePath();
        return objectIndex >= 0;
    }

    /// <summary>The collider of one object, with its place in the world.</summary>
    /// <param name="Collider">In the frame of its model, shared by all objects that show it.</param>
    /// <param name="Similarity">Maps that frame to world space.</param>
    /// <param name="GeneralMap">Used instead of the similarity where the object's matrix is none; else null.</param>
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
