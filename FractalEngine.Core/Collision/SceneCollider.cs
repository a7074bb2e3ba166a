using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Queries on all objects of a scene, in world space. The collider of a file is built when it is first asked for, once for all objects that show the
/// file; an object's own matrix is taken into account by each query, so that objects move for nothing.
/// </summary>
/// <remarks>
/// A matrix with a non-uniform scale does not keep distances in proportion: then the search itself takes it into account, which costs some
/// times more. The colliders that only approximate can't: there such an object has one of its own, for the place where the scene has it.
/// </remarks>
public sealed class SceneCollider
{
    private readonly ImmutableArray<Item> _items;
    private readonly Dictionary<Model, Lazy<Collider>> _shared;
    private readonly ColliderKind _kind;

    /// <summary>For a scene. Builds nothing yet.</summary>
    /// <param name="scene">With its files loaded.</param>
    /// <param name="kind">The collider of every object that it fits, see <see cref="ColliderFactory"/>.</param>
    public SceneCollider(LoadedScene scene, ColliderKind kind = ColliderKind.Exact)
    {
        _kind = kind;
        _shared = scene.Models.ToDictionary(model => model, model => new Lazy<Collider>(() => ColliderFactory.Create(model, kind)));
        _items = [.. scene.Objects.Select(ItemOf)];
    }

    private SceneCollider(ImmutableArray<Item> items, Dictionary<Model, Lazy<Collider>> shared, ColliderKind kind) => (_items, _shared, _kind) = (items, shared, kind);

    /// <summary>The same scene with one of its objects elsewhere. Colliders are shared; only the approximate ones of skewed objects are built anew.</summary>
    /// <param name="index">The object's place in the scene.</param>
    /// <param name="placed">The same model under another matrix.</param>
    public SceneCollider WithObject(int index, PlacedModel placed) => new(_items.SetItem(index, ItemOf(placed)), _shared, _kind);

    private Item ItemOf(PlacedModel placed) => Similarity.TryMake(placed.Map, out var similarity)
        ? new(_shared[placed.Model], similarity, null, placed.Bounds)
        : ColliderFactory.FindsImages(_kind)
            ? new(_shared[placed.Model], Similarity.Identity, placed.Map, placed.Bounds)
            : new(new(() => ColliderFactory.Create(placed, _kind)), Similarity.Identity, null, placed.Bounds);

    /// <summary>Bytes of the colliders built so far, each once.</summary>
    public long StorageBytes => _items.Select(item => item.Collider).Distinct().Where(collider => collider.IsValueCreated).Sum(collider => collider.Value.StorageBytes);

    /// <summary>How many colliders there are, and how many of them have been built.</summary>
    public (int Built, int All) Counts
    {
        get
        {
            var colliders = _items.Select(item => item.Collider).Distinct().ToArray();
            return (colliders.Count(static collider => collider.IsValueCreated), colliders.Length);
        }
    }

    /// <summary>Builds all colliders now instead of at their first query.</summary>
    public void Build()
    {
        foreach (var item in _items)
        {
            _ = item.Collider.Value;
        }
    }

    /// <summary>Finds the nearest point of all objects.</summary>
    /// <param name="position">World space, finite.</param>
    /// <param name="within">Nothing farther away is looked at; may be infinite.</param>
    /// <param name="record">Receives the costs and the instance.</param>
    /// <param name="closest">The answer in world space, if there is one.</param>
    /// <param name="objectIndex">The number of the object in the scene, −1 for none.</param>
    /// <param name="except">An object that is not looked at, such as the one that asks; −1 for none.</param>
    /// <param name="epsilon">See <see cref="Collider.TryFindClosest"/>.</param>
    /// <returns>False when nothing lies within the distance.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite, or the distance or ε is negative or NaN.</exception>
    public bool TryFindClosest(
        Vector position, double within, QueryRecord record, out ClosestPoint closest, out int objectIndex, int except = -1, double epsilon = 0)
    {
        Collider.Check(position, within, epsilon);
        (closest, objectIndex) = (default, -1);
        var bounds = record.ObjectBounds(_items.Length);
        for (var i = 0; i < _items.Length; i++)
        {
            bounds[i] = i == except ? double.PositiveInfinity : Math.Sqrt(_items[i].Bounds.DistanceSquared(position));
        }

        record.BoundTests += _items.Length;
        for (var left = _items.Length; left > 0; left--)
        {
            var nearest = 0;
            for (var i = 1; i < bounds.Length; i++)
            {
                nearest = bounds[i] < bounds[nearest] ? i : nearest;
            }

            if (!(bounds[nearest] * (objectIndex < 0 ? 1 : 1 + epsilon) <= within) || double.IsPositiveInfinity(bounds[nearest]))
            {
                break;
            }

            bounds[nearest] = double.PositiveInfinity;
            if (_items[nearest].TryFind(position, within, record, out var found, epsilon) && (objectIndex < 0 || found.Distance < closest.Distance))
            {
                (closest, objectIndex, within) = (found, nearest, Math.Min(within, found.Distance));
                record.KeepPath();
            }
        }

        record.RestorePath();
        return objectIndex >= 0;
    }

    /// <summary>An object.</summary>
    /// <param name="Collider">In the frame of its model.</param>
    /// <param name="Similarity">From that frame to world space.</param>
    /// <param name="Skewing">Instead of the similarity, where the object's matrix is none.</param>
    /// <param name="Bounds">In world space.</param>
    private sealed record Item(Lazy<Collider> Collider, Similarity Similarity, AffineMap? Skewing, BoundingBox Bounds)
    {
        public bool TryFind(Vector position, double within, QueryRecord record, out ClosestPoint found, double epsilon)
        {
            if (Skewing is { } map)
            {
                return Collider.Value.FindImage(position, map, within, epsilon, record, out found);
            }

            var isFound = Collider.Value.TryFindClosest(Similarity.ToLocal(position), within / Similarity.Scale, record, out var local, epsilon);
            found = isFound ? Similarity.ToWorld(local) : default;
            return isFound;
        }
    }
}
