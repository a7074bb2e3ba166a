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
    private readonly List<StaticObject> _objects;

    /// <summary>Creates the view of a set. No collider is built yet.</summary>
    /// <param name="set">The objects, at least one.</param>
    /// <param name="kind">Kind of all their colliders.</param>
    /// <param name="cache">Colliders of other worlds; null for none.</param>
    public StaticColliders(StaticObjectSet set, ColliderKind kind, ColliderCache? cache)
    {
        _objects = set.Objects;
        Scene = new(new LoadedScene(new(), [.. _objects.Select(static placed => placed.Reference)]), kind, cache);
        foreach (var kinematic in _objects.Select(static candidate => candidate.Kinematic).OfType<KinematicObject>())
        {
            AddKinematic(kinematic);
        }
    }

    /// <summary>Creates the view of the objects that stop what has a layer and a mask.</summary>
    public StaticColliders(StaticColliders all, int layer, uint mask)
    {
        _objects = all._objects;
        Scene = all.Scene;
        foreach (var hidden in _objects.Where(one => one.Kinematic is null && !StaticObjectSet.CanMeet(one, layer, mask)))
        {
            Scene = Scene.WithoutObject(hidden.Index, out _);
        }

        Kinematics.AddRange(all.Kinematics.Where(pair => StaticObjectSet.CanMeet(pair.Object.Target, layer, mask)));
    }

    /// <summary>Finds the closest point of one object.</summary>
    public bool TryFindClosestOf(
        StaticObject target, Vector position, double maxDistance, QueryContext context, out ClosestPoint closest)
    {
        foreach (var (kinematic, collider) in Kinematics)
        {
            if (kinematic.Target == target)
            {
                var isFound = collider.TryFindClosest(kinematic.ToReference(position), maxDistance, context, out closest, epsilon: 0);
                closest = kinematic.ToWorld(in closest);
                return isFound;
            }
        }

        return Scene.ColliderOf(target.Index).TryFindClosest(position, maxDistance, context, out closest, epsilon: 0);
    }

    /// <summary>Finds the object with the closest point, where all of them are now.</summary>
    /// <returns>Null where none is within the distance.</returns>
    public StaticObject? FindClosest(Vector point, double maxDistance, QueryContext context, out ClosestPoint closest)
    {
        var found = Scene.TryFindClosest(point, maxDistance, context, out closest) ? _objects[context.ObjectIndex] : null;
        return FindCloserKinematic(point, found is null ? maxDistance : closest.Distance, context, ref closest)?.Target ?? found;
    }

    /// <summary>Finds the kinematic object with the closest point.</summary>
    /// <returns>Null where none is within the distance; then the point stays as it is.</returns>
    public KinematicObject? FindCloserKinematic(Vector point, double maxDistance, QueryContext context, ref ClosestPoint closest)
    {
        KinematicObject? found = null;
        foreach (var (kinematic, collider) in Kinematics)
        {
            if (kinematic.TryFindClosest(collider, point, maxDistance, context, out var candidate)
                && (found is null || candidate.Distance < maxDistance))
            {
                closest = candidate;
                maxDistance = candidate.Distance;
                found = kinematic;
            }
        }

        return found;
    }

    /// <summary>Answers queries for the closest point, in world space.</summary>
    public SceneCollider Scene { get; private set; }

    /// <summary>The kinematic objects, which <see cref="Scene"/> has not, each with its collider at the reference placement.</summary>
    public List<(KinematicObject Object, ColliderInstance Collider)> Kinematics { get; } = [];

    /// <summary>Builds all colliders now, and finds which objects are solid, instead of at their first queries.</summary>
    public void Build(CancellationToken cancellation)
    {
        Scene.Build(cancellation);
        foreach (var target in _objects)
        {
            cancellation.ThrowIfCancellationRequested();
            _ = target.IsSolid;
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
