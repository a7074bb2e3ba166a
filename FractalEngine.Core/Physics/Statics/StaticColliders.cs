using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Statics;

/// <summary>The static objects of a world as colliders of one kind see them.</summary>
internal sealed class StaticColliders
{
    private readonly StaticObjectSet _set;

    /// <summary>Creates the view of a set. No collider is built yet.</summary>
    /// <param name="set">The objects, at least one.</param>
    /// <param name="kind">Kind of all their colliders.</param>
    /// <param name="cache">Colliders of other worlds; null for none.</param>
    public StaticColliders(StaticObjectSet set, ColliderKind kind, ColliderCache? cache)
    {
        _set = set;
        Scene = new(new LoadedScene(new(), [.. set.Objects.Select(static placed => placed.Reference)]), kind, cache);
        foreach (var kinematic in set.Objects.Select(static candidate => candidate.Kinematic).OfType<KinematicObject>())
        {
            AddKinematic(kinematic);
        }
    }

    private StaticColliders(StaticColliders all, Func<StaticObject, bool> condition)
    {
        _set = all._set;
        Scene = all.Scene;
        foreach (var hidden in _set.Objects.Where(candidate => candidate.Kinematic is null && !condition(candidate)))
        {
            Scene = Scene.WithoutObject(hidden.Index, out _);
        }

        Kinematics.AddRange(all.Kinematics.Where(pair => condition(pair.Object.Target)));
    }

    /// <summary>The same colliders without those of some objects.</summary>
    public StaticColliders Where(Func<StaticObject, bool> condition) => new(this, condition);

    /// <summary>Finds the closest point of one object.</summary>
    public bool TryFindClosestOf(
        StaticObject target, Vector position, double maxDistance, QueryContext context, out ClosestPoint closest)
    {
        var collider = FindCollider(target);
        if (target.Kinematic is not { } kinematic)
        {
            return collider.TryFindClosest(position, maxDistance, context, out closest, epsilon: 0);
        }

        var isFound = collider.TryFindClosest(kinematic.ToReference(position), maxDistance, context, out closest, epsilon: 0);
        closest = closest with { Point = kinematic.ToWorld(closest.Point), Normal = kinematic.Rotate(closest.Normal) };
        return isFound;
    }

    private ColliderInstance FindCollider(StaticObject target)
    {
        foreach (var (kinematic, collider) in Kinematics)
        {
            if (kinematic.Target == target)
            {
                return collider;
            }
        }

        return Scene.ColliderOf(target.Index);
    }

    /// <summary>Answers queries for the closest point, in world space.</summary>
    public SceneCollider Scene { get; private set; }

    /// <summary>The kinematic objects, which <see cref="Scene"/> has not, each with its collider at the reference placement.</summary>
    public List<(KinematicObject Object, ColliderInstance Collider)> Kinematics { get; } = [];

    /// <summary>
    /// Tells whether an object is a closed solid, or consists of such. What is behind its faces is then inside it.
    /// </summary>
    public bool IsSolid(int index) => _set.IsSolid(_set.Objects[index].Model.Mesh);

    /// <summary>Sign of an object's winding, see <see cref="StaticObject.WindingSign"/>.</summary>
    public int WindingSign(int index) => _set.Objects[index].WindingSign;

    /// <summary>Builds all colliders now, and finds which objects are solid, instead of at their first queries.</summary>
    public void Build(CancellationToken cancellation)
    {
        Scene.Build(cancellation);
        for (var i = 0; i < _set.Objects.Count; i++)
        {
            cancellation.ThrowIfCancellationRequested();
            IsSolid(i);
        }
    }

    /// <summary>Adds an object. The colliders of the others are kept.</summary>
    public void Add(PlacedModel placed) => Scene = Scene.WithAddedObject(placed);

    /// <summary>Takes an object out of the scene that moves by itself from now on.</summary>
    public void AddKinematic(KinematicObject kinematic)
    {
        Scene = Scene.WithoutObject(kinematic.Target.Index, out var collider);
        Kinematics.Add((kinematic, collider));
    }

    /// <summary>Replaces an object by the same one at another placement.</summary>
    public void Replace(int index, PlacedModel placed)
    {
        Scene = Scene.WithObject(index, placed);
        var place = Kinematics.FindIndex(pair => pair.Object.Target.Index == index);
        if (place >= 0)
        {
            Scene = Scene.WithoutObject(index, out var collider);
            Kinematics[place] = (Kinematics[place].Object, collider);
        }
    }
}
