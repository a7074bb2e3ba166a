using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Physics.Kinematics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>The static objects of a world with their colliders, which are built when they are first queried.</summary>
/// <param name="cache">Colliders of other worlds; null for none.</param>
internal sealed class StaticObjectSet(ColliderCache? cache)
{
    private readonly List<StaticObject> _objects = [];
    private readonly Dictionary<ColliderKind, StaticColliders> _colliders = [];
    private readonly Dictionary<object, Model> _models = [];
    private readonly Dictionary<Mesh, bool> _isSolid = new(ReferenceEqualityComparer.Instance);

    /// <summary>All static objects, in the order in which they were added.</summary>
    public IReadOnlyList<StaticObject> Objects => _objects;

    /// <summary>The model of a fractal: the same one for equal fractals, so that they share a collider.</summary>
    public Model ModelOf(Fractal fractal) =>
        _models.TryGetValue(fractal, out var model) ? model : _models[fractal] = new FractalModel(fractal);

    /// <summary>The model of a mesh: the same one for equal meshes, so that they share a collider.</summary>
    public Model ModelOf(Mesh mesh) => _models.TryGetValue(mesh, out var model) ? model : _models[mesh] = new MeshModel(mesh);

    /// <summary>Adds an object. Colliders that exist are kept.</summary>
    /// <param name="added">Its <see cref="StaticObject.Index"/> must be the next one.</param>
    public void Add(StaticObject added)
    {
        _objects.Add(added);
        _models.TryAdd(added.Model is FractalModel { Fractal: var fractal } ? fractal : added.Model.Mesh, added.Model);
        foreach (var colliders in _colliders.Values)
        {
            colliders.Add(added.Placed);
        }
    }

    /// <summary>Tells the colliders that an object has moved.</summary>
    public void Refresh(StaticObject moved)
    {
        foreach (var colliders in _colliders.Values)
        {
            colliders.Replace(moved.Index, moved.Reference);
        }
    }

    /// <summary>Tells the colliders that an object moves by itself from now on.</summary>
    public void AddKinematic(KinematicObject kinematic)
    {
        foreach (var colliders in _colliders.Values)
        {
            colliders.AddKinematic(kinematic);
        }
    }

    /// <summary>Returns all objects to their initial placements.</summary>
    public void Reset()
    {
        foreach (var moved in _objects.Where(static candidate => !candidate.IsAtInitialPlacement))
        {
            moved.ResetPlacement();
            Refresh(moved);
        }
    }

    /// <summary>The colliders of one kind for all objects; null where there are no objects.</summary>
    public StaticColliders? CollidersOf(ColliderKind kind)
    {
        if (_objects.Count == 0)
        {
            return null;
        }

        if (!_colliders.TryGetValue(kind, out var colliders))
        {
            colliders = new(this, kind, cache);
            _colliders[kind] = colliders;
        }

        return colliders;
    }

    /// <summary>Number of colliders of one kind that have been built, and how many there are.</summary>
    public (int Built, int All) CountColliders(ColliderKind kind) => _colliders.TryGetValue(kind, out var colliders)
        ? colliders.Scene.ColliderCounts
        : (0, _objects.Select(static candidate => candidate.Model).Distinct().Count());

    /// <summary>Tells whether a mesh is a closed solid. Found at the first call, in O(faces).</summary>
    public bool IsSolid(Mesh mesh)
    {
        if (!_isSolid.TryGetValue(mesh, out var isSolid))
        {
            isSolid = ClosedSurface.IsSolid(mesh);
            _isSolid[mesh] = isSolid;
        }

        return isSolid;
    }
}
