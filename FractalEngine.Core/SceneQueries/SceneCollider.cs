using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Regions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.SceneQueries;

/// <summary>
/// Finds closest points on all objects of a scene, in world space. The collider of a model is built when it is first needed, once for all
/// objects that show the model. Each query takes the object's own matrix into account, so that moving an object costs nothing.
/// </summary>
/// <remarks>
/// A skewed matrix (one that is no similarity) does not keep distances in proportion: then the search itself takes it into account, which
/// costs several times more. The approximate colliders can't, so such an object gets one of its own, in world space.
/// A query finds its object in O(log n) for n objects that lie apart: the first one builds a hierarchy over their boxes. Objects are tested
/// in the order of the distances of their boxes, equally close ones in the order of the scene. Of equally close points the first one wins.
/// </remarks>
public sealed class SceneCollider : Collider
{
    private readonly Dictionary<Model, Lazy<Collider>> _sharedColliders;
    private readonly ColliderKind _kind;

    // Differs for the paper's descent, which needs a fractal: meshes beside fractals take the hierarchy.
    private readonly ColliderKind _kindOfMeshes;
    private readonly Lock _hierarchyLock = new();

    // Replaced by the same objects in another hierarchy only.
    private volatile SceneObjects _objects;

    /// <summary>Prepares the colliders of a scene made in code, or loaded from a file. Builds none of them yet.</summary>
    /// <param name="scene">With its models.</param>
    /// <param name="kind">
    /// The collider of all objects, see <see cref="ColliderFactory"/>. Meshes beside fractals take the hierarchy for the paper's descent.
    /// </param>
    /// <exception cref="FractalEngineException">An object names a file that is not loaded.</exception>
    public SceneCollider(Scene scene, ColliderKind kind = ColliderKind.Exact)
        : this(LoadedScene.Of(scene), kind)
    {
    }

    /// <summary>Prepares the colliders of a scene. Builds none of them yet.</summary>
    /// <param name="scene">With its models.</param>
    /// <param name="kind">
    /// The collider of all objects, see <see cref="ColliderFactory"/>. Meshes beside fractals take the hierarchy for the paper's descent.
    /// </param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such kind.</exception>
    public SceneCollider(LoadedScene scene, ColliderKind kind = ColliderKind.Exact)
        : this(scene, kind, null)
    {
    }

    /// <summary>Prepares the colliders of a scene, and takes those of known models from a cache.</summary>
    /// <inheritdoc cref="SceneCollider(LoadedScene, ColliderKind)"/>
    /// <param name="scene">With its models.</param>
    /// <param name="kind">The collider of all objects.</param>
    /// <param name="cache">Receives the colliders of new models; null for none.</param>
    internal SceneCollider(LoadedScene scene, ColliderKind kind, ColliderCache? cache)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ColliderFactory.ThrowIfUnknown(kind);
        _kind = kind;
        _kindOfMeshes = kind == ColliderKind.Fractal && scene.Models.Any(static model => model is FractalModel)
            ? ColliderKind.Hierarchy
            : kind;
        _sharedColliders = scene.Models.ToDictionary(
            model => model,
            model => cache?.GetOrAdd(model, KindFor(model), () => CreateCollider(model)) ?? new(() => CreateCollider(model)));
        _objects = SceneObjects.Of([.. scene.Objects.Select((placed, index) => CreateInstance(index, placed))]);
    }

    private SceneCollider(SceneObjects objects, Dictionary<Model, Lazy<Collider>> sharedColliders, SceneCollider kinds)
    {
        _objects = objects;
        _sharedColliders = sharedColliders;
        _kind = kinds._kind;
        _kindOfMeshes = kinds._kindOfMeshes;
    }

    /// <summary>
    /// Makes the collider of the same scene with one of its objects elsewhere. Colliders are shared; only the approximate ones of skewed
    /// objects are built anew. Costs O(log n) for n objects.
    /// </summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="placed">The same model under another matrix.</param>
    /// <exception cref="ArgumentOutOfRangeException">The scene has no such object.</exception>
    /// <exception cref="ArgumentException">No object of the scene shows the model.</exception>
    /// <remarks>
    /// The hierarchy over the objects keeps its shape. Once moves have doubled its boxes, the next query builds another, O(n log n).
    /// </remarks>
    public SceneCollider WithObject(int index, PlacedModel placed)
    {
        var objects = _objects;
        ArgumentOutOfRangeException.ThrowIfNegative(index);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(index, objects.Count);
        ArgumentNullException.ThrowIfNull(placed);
        ArgumentCheck.Require(_sharedColliders.ContainsKey(placed.Model), "expected the model of an object of the scene", nameof(placed));
        return new(objects.With(CreateInstance(index, placed)), _sharedColliders, this);
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

        var objects = _objects;
        var withModel = new SceneCollider(objects, sharedColliders, this);
        return new(objects.Add(withModel.CreateInstance(objects.Count, placed)), sharedColliders, this);
    }

    /// <summary>Makes the collider of the same scene without one of its objects. The indices of the others stay.</summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="removed">Receives the object's own collider.</param>
    internal SceneCollider WithoutObject(int index, out ColliderInstance removed)
    {
        var objects = _objects;
        removed = objects[index];
        // No query comes near an empty box.
        return new(objects.With(new(index, removed.Collider, Similarity.Identity, null, BoundingBox.Empty)), _sharedColliders, this);
    }

    /// <summary>The collider of one object at its place.</summary>
    internal ColliderInstance ColliderOf(int index) => _objects[index];

    private ColliderInstance CreateInstance(int index, PlacedModel placed)
    {
        var isSimilar = Similarity.TryCreate(placed.ObjectToWorld, out var similarity);
        return isSimilar || ColliderFactory.SupportsTransformedQueries(KindFor(placed.Model))
            ? new(index, _sharedColliders[placed.Model], similarity, isSimilar ? null : placed.ObjectToWorld, placed.Bounds)
            : new(index, new(() => CreateCollider(placed)), Similarity.Identity, null, placed.Bounds);
    }

    private ColliderKind KindFor(Model model) => model is FractalModel ? _kind : _kindOfMeshes;

    private Collider CreateCollider(Model model) => NameMismatch(model, () => model.CreateCollider(KindFor(model)));

    private Collider CreateCollider(PlacedModel placed) =>
        NameMismatch(placed.Model, () => placed.CreateCollider(KindFor(placed.Model)));

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

    /// <inheritdoc/>
    public override bool IsExact => ColliderFactory.SupportsTransformedQueries(_kind);

    /// <inheritdoc/>
    private protected override string Noun => "scene";

    /// <inheritdoc/>
    /// <remarks>Counts the colliders built so far, each once.</remarks>
    public override long StorageBytes =>
        _objects.ToArray().Select(instance => instance.Collider).Distinct().Where(collider => collider.IsValueCreated)
        .Sum(collider => collider.Value.StorageBytes);

    /// <summary>Number of colliders that have been built, and of all.</summary>
    public (int Built, int All) ColliderCounts
    {
        get
        {
            var colliders = _objects.ToArray().Select(instance => instance.Collider).Distinct().ToArray();
            return (colliders.Count(static collider => collider.IsValueCreated), colliders.Length);
        }
    }

    /// <summary>Builds all colliders now instead of at their first query.</summary>
    /// <exception cref="ColliderMismatchException">The kind does not fit a model, which the message names.</exception>
    /// <exception cref="FractalLimitException">A fractal is too large for the kind.</exception>
    public void Build() => Build(CancellationToken.None);

    /// <summary>Builds all colliders now, unless it is cancelled between two of them.</summary>
    internal void Build(CancellationToken cancellation)
    {
        foreach (var instance in ReadyObjects().ToArray())
        {
            cancellation.ThrowIfCancellationRequested();
            _ = instance.Collider.Value;
        }
    }

    /// <summary>Finds the point closest to a position of all objects but one, and adds up what that costs.</summary>
    /// <inheritdoc cref="Collider.TryFindClosest(Vector, double, QueryContext, out ClosestPoint, double)"/>
    /// <param name="position">World space, finite.</param>
    /// <param name="maxDistance">Search radius, scene units, not negative; may be infinite.</param>
    /// <param name="context">Receives the costs, the instance and the object; one for each thread.</param>
    /// <param name="closest">The closest point in world space, if there is one.</param>
    /// <param name="epsilon">Allowed relative error, see <see cref="Collider"/>.</param>
    /// <param name="excludedObject">Index of the object that is not tested, such as the querying body's own; −1 for none.</param>
    public bool TryFindClosest(
        Vector position, double maxDistance, QueryContext context, out ClosestPoint closest, double epsilon, int excludedObject)
    {
        ArgumentNullException.ThrowIfNull(context);
        ThrowIfInvalid(position, maxDistance, epsilon);
        var objects = ReadyObjects();
        var search = new ClosestObjectSearch(position, maxDistance, context, excludedObject, epsilon);
        if (objects.Hierarchy is { } hierarchy && !(position.MaxAbsComponent() > MaxCoordinate))
        {
            search.RunAmongMany(hierarchy, objects.Loose.AsSpan());
        }
        else
        {
            // Without a hierarchy all objects are loose. From very far away the boxes of a hierarchy tell nothing.
            search.RunAmongFew(objects);
        }

        return search.TryGetResult(out closest);
    }

    /// <summary>Finds the closest points of two objects, as colliders do for two shapes.</summary>
    /// <param name="objectIndex">Index of the first object in the scene, from 0.</param>
    /// <param name="otherObjectIndex">Index of the second object.</param>
    /// <param name="context">Receives the costs; null where they don't matter.</param>
    /// <returns>Both points in world space.</returns>
    /// <exception cref="ArgumentOutOfRangeException">There is no object with such an index.</exception>
    /// <exception cref="InvalidOperationException">An object has no faces.</exception>
    /// <exception cref="FractalLimitException">The distance is beyond the range of a double.</exception>
    /// <exception cref="NotSupportedException">The colliders are not exact.</exception>
    public ClosestPair FindClosestPair(int objectIndex, int otherObjectIndex, QueryContext? context = null)
    {
        var objects = _objects.ToArray();
        var instance = Instance(objectIndex, nameof(objectIndex));
        var other = Instance(otherObjectIndex, nameof(otherObjectIndex));
        return instance.Collider.Value.FindClosestPair(instance.ObjectToWorld, other.Collider.Value, other.ObjectToWorld, context);

        ColliderInstance Instance(int index, string name)
        {
            ArgumentOutOfRangeException.ThrowIfNegative(index, name);
            ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(index, objects.Length, name);
            return objects[index];
        }
    }

    /// <inheritdoc/>
    protected override bool FindClosestCore(
        Vector position, double maxDistance, double epsilon, QueryContext context, out ClosestPoint closest) =>
        TryFindClosest(position, maxDistance, context, out closest, epsilon, excludedObject: -1);

    /// <inheritdoc/>
    internal override double CompleteErrorBound(Vector position, in ClosestPoint closest, double epsilon) => closest.ErrorBound;

    /// <inheritdoc/>
    private protected override void CollectAllWithin(
        Vector position, double radius, int maxFaces, QueryContext context, List<ClosestHit> hits)
    {
        foreach (var instance in ExactObjects().ToArray())
        {
            if (instance.BoundDistance(position) <= radius)
            {
                RegionQuery.CollectAllWithin(
                    instance.Collider.Value.ShapeTree, instance.ObjectToWorld, instance.Index, position, radius, maxFaces, context, hits);
            }
        }
    }

    /// <inheritdoc/>
    private protected override bool OverlapsCore(Vector centre, double radius, QueryContext context) =>
        double.IsPositiveInfinity(radius)
            ? ExactObjects().ToArray().Any(static instance => !instance.Bounds.IsEmpty)
            : ExactObjects().Count > 0 && TryFindClosest(centre, radius, context, out _);

    /// <inheritdoc/>
    private protected override bool OverlapsCore(BoundingBox box, QueryContext context) =>
        ExactObjects().ToArray().Any(instance => TriangleBoxTest.Meets(instance.Bounds, box, 0)
            && RegionQuery.Overlaps(instance.Collider.Value.ShapeTree, instance.ObjectToWorld, box, context));

    /// <inheritdoc/>
    private protected override ShapeTree CreateShapeTree() => throw new NotSupportedException(
        "a scene is no shape with one frame: expected two of its objects, see SceneCollider.FindClosestPair");

    /// <summary>All objects, for questions about regions: one after the other is asked, O(n) for n objects.</summary>
    /// <exception cref="NotSupportedException">The colliders are not exact.</exception>
    private SceneObjects ExactObjects() => IsExact ? ReadyObjects() : throw new NotSupportedException(
        $"the collider '{ColliderNames.Of(_kind)}' finds closest points of positions only: expected an exact one");

    /// <summary>The objects with a hierarchy that is worth its cost, which the first query builds.</summary>
    private SceneObjects ReadyObjects()
    {
        var objects = _objects;
        return objects.NeedsNewHierarchy ? BuildHierarchy() : objects;
    }

    private SceneObjects BuildHierarchy()
    {
        lock (_hierarchyLock)
        {
            // Another thread may have built it meanwhile.
            if (_objects.NeedsNewHierarchy)
            {
                _objects = _objects.WithNewHierarchy();
            }

            return _objects;
        }
    }
}
