using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Statics;

/// <summary>The static objects of a world with their colliders, which are built when they are first queried.</summary>
/// <param name="invalidateSurroundings">Is called when surfaces have changed, with whether bodies may overlap them now.</param>
/// <param name="cache">Colliders of other worlds; null for none.</param>
internal sealed class StaticObjectSet(Action<bool> invalidateSurroundings, ColliderCache? cache)
{
    private readonly Dictionary<ColliderKind, StaticColliders> _colliders = [];
    private readonly Dictionary<(ColliderKind Kind, int Layer, uint Mask), StaticColliders> _filtered = [];
    private readonly Dictionary<object, Model> _models = [];
    private readonly Dictionary<Mesh, bool> _isSolid = new(ReferenceEqualityComparer.Instance);

    /// <summary>The world's time, which says where objects are that move by themselves.</summary>
    public StepClock Clock;

    /// <summary>All static objects, in the order in which they were added.</summary>
    public List<StaticObject> Objects { get; } = [];

    /// <summary>The objects that move by themselves.</summary>
    public KinematicSet Kinematics { get; } = new();

    /// <summary>Collider of all bodies instead of their own; null for their own.</summary>
    public ColliderKind? ColliderOverride { get; set; }

    /// <summary>Kind of collider that the character meets.</summary>
    public ColliderKind CharacterKind => ColliderOverride ?? ColliderKind.Exact;

    /// <summary>True once an object has another layer or mask than others.</summary>
    public bool HasFilters { get; private set; }

    /// <summary>The model of a fractal: the same one for equal fractals, so that they share a collider.</summary>
    public Model ModelOf(Fractal fractal) =>
        _models.TryGetValue(fractal, out var model) ? model : _models[fractal] = new FractalModel(fractal);

    /// <summary>The model of a mesh: the same one for equal meshes, so that they share a collider.</summary>
    public Model ModelOf(Mesh mesh) => _models.TryGetValue(mesh, out var model) ? model : _models[mesh] = new MeshModel(mesh);

    /// <summary>Adds an object. Colliders that exist are kept.</summary>
    /// <param name="added">Its <see cref="StaticObject.Index"/> must be the next one.</param>
    public void Add(StaticObject added)
    {
        Objects.Add(added);
        _models.TryAdd(added.Model is FractalModel { Fractal: var fractal } ? fractal : added.Model.Mesh, added.Model);
        TellColliders(colliders => colliders.Add(added.Placed));
    }

    /// <summary>Tells the colliders that an object has moved.</summary>
    public void Refresh(StaticObject moved) => TellColliders(colliders => colliders.Replace(moved.Index, moved.Reference));

    /// <summary>Lets an object move by itself from now on.</summary>
    public KinematicObject AddKinematic(StaticObject target)
    {
        var kinematic = new KinematicObject(Kinematics, target);
        Kinematics.Objects.Add(kinematic);
        TellColliders(colliders => colliders.AddKinematic(kinematic));
        return kinematic;
    }

    private void TellColliders(Action<StaticColliders> change)
    {
        foreach (var colliders in _colliders.Values)
        {
            change(colliders);
        }

        _filtered.Clear();
    }

    /// <summary>True where an object stops what has a layer and a mask.</summary>
    public static bool CanMeet(StaticObject target, int layer, uint mask) =>
        !target.IsTrigger && Layers.CanMeet(target.Layer, target.Mask, layer, mask);

    /// <summary>Tells bodies that surfaces have changed.</summary>
    /// <param name="mayOverlap">True where bodies may overlap them now.</param>
    public void InvalidateSurroundings(bool mayOverlap) => invalidateSurroundings(mayOverlap);

    /// <summary>Tells that an object has another layer, mask or trigger.</summary>
    public void ChangeFilters()
    {
        _filtered.Clear();
        HasFilters = Objects.Exists(static candidate => candidate.IsTrigger || candidate.Layer != 0 || candidate.Mask != Layers.All);
        InvalidateSurroundings(mayOverlap: true);
    }

    /// <summary>Tells whether a ball reaches into an object: touches its surface, or is inside where that is closed.</summary>
    /// <param name="target">One of the objects.</param>
    /// <param name="centre">World space.</param>
    /// <param name="radius">Scene units.</param>
    /// <param name="context">Receives the cost.</param>
    /// <param name="point">Receives the closest point of the surface.</param>
    public bool TryEnter(StaticObject target, Vector centre, double radius, QueryContext context, out Vector point)
    {
        var isSolid = target.IsSolid && target.WindingSign != 0;
        var colliders = AllCollidersOf(ColliderKind.Exact)!;
        var isNear = colliders.TryFindClosestOf(target, centre, isSolid ? double.PositiveInfinity : radius, context, out var closest);
        point = closest.Point;
        return isNear && (closest.Distance <= radius || (isSolid && closest.Feature == TriangleFeature.Interior
            && target.WindingSign * Vector.Dot(centre - closest.Point, closest.Normal) < 0));
    }

    /// <summary>Kind of the colliders that a body meets.</summary>
    public ColliderKind KindFor(BodyDescription body) => ColliderOverride ?? body.Collider;

    /// <summary>The colliders that a body meets; null where there are no objects.</summary>
    public StaticColliders? CollidersOf(BodyDescription body) => CollidersOf(KindFor(body), body.Layer, body.Mask);

    /// <summary>The colliders of one kind for what has a layer and a mask; null where there are no objects.</summary>
    public StaticColliders? CollidersOf(ColliderKind kind, int layer = 0, uint mask = Layers.All)
    {
        var all = AllCollidersOf(kind);
        return all is null || (!HasFilters && mask == Layers.All) ? all
            : _filtered.TryGetValue((kind, layer, mask), out var colliders) ? colliders
            : _filtered[(kind, layer, mask)] = new(all, layer, mask);
    }

    /// <summary>The colliders of one kind for all objects; null where there are no objects.</summary>
    public StaticColliders? AllCollidersOf(ColliderKind kind) => Objects.Count == 0 ? null
        : _colliders.TryGetValue(kind, out var colliders) ? colliders
        : _colliders[kind] = new(this, kind, cache);

    /// <summary>Number of colliders of one kind that have been built, and how many there are.</summary>
    public (int Built, int All) CountColliders(ColliderKind kind) => _colliders.TryGetValue(kind, out var colliders)
        ? colliders.Scene.ColliderCounts
        : (0, Objects.Select(static candidate => candidate.Model).Distinct().Count());

    /// <summary>Tells whether a mesh is a closed solid. Found at the first call, in O(faces).</summary>
    public bool IsSolid(Mesh mesh) => _isSolid.TryGetValue(mesh, out var isSolid) ? isSolid : _isSolid[mesh] = ClosedSurface.IsSolid(mesh);
}
