using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Movement;

/// <summary>The surfaces of bodies that have the shape of their meshes, as the character and casts meet them.</summary>
internal sealed class BodySurfaces(List<Body> bodies, StaticObjectSet statics)
{
    private readonly List<(Body Body, KinematicObject Object, ColliderInstance Collider)> _surfaces = [];
    private int _layer;
    private uint _mask = Layers.All;

    /// <summary>True where no body has the shape of its mesh.</summary>
    public bool IsEmpty => _surfaces.Count == 0;

    /// <summary>Number of surfaces in all.</summary>
    public int Count => _surfaces.Count;

    /// <summary>Lists the surfaces of all bodies. Those of bodies that were there stay.</summary>
    public void Place()
    {
        var before = _surfaces.ToDictionary(static surface => surface.Body);
        _surfaces.Clear();
        foreach (var body in bodies)
        {
            if (body.Description.Mesh is { } mesh)
            {
                _surfaces.Add(before.TryGetValue(body, out var surface) ? surface : Create(body, mesh));
            }
        }
    }

    /// <summary>Tells whether a surface is met by what has the layer and mask that have been set.</summary>
    /// <param name="index">From 0.</param>
    /// <param name="body">Its body.</param>
    /// <param name="target">The surface.</param>
    public bool IsMet(int index, out Body body, out StaticObject target)
    {
        (body, target) = (_surfaces[index].Body, _surfaces[index].Object.Target);
        return CanMeet(body);
    }

    /// <summary>Sets what meets the surfaces from now on.</summary>
    public void SetMover(int layer, uint mask) => (_layer, _mask) = (layer, mask);

    /// <summary>Puts the surfaces where their bodies are.</summary>
    public void Follow()
    {
        foreach (var (body, surface, _) in _surfaces)
        {
            surface.Follow(PoseOf(body));
        }
    }

    /// <summary>Lets the surfaces go to where their bodies have got in a part of a step.</summary>
    /// <param name="seconds">Length of the part.</param>
    public void Follow(double seconds)
    {
        foreach (var (body, surface, _) in _surfaces)
        {
            surface.Follow(PoseOf(body), seconds);
        }
    }

    /// <summary>Finds the surface with the closest point.</summary>
    /// <returns>Null where none is within the distance; then the point stays as it is.</returns>
    public KinematicObject? FindCloser(Vector point, double maxDistance, QueryContext context, ref ClosestPoint closest)
    {
        KinematicObject? found = null;
        foreach (var (body, surface, collider) in _surfaces)
        {
            if (CanMeet(body) && surface.TryFindClosest(collider, point, maxDistance, context, out var candidate)
                && (found is null || candidate.Distance < maxDistance))
            {
                closest = candidate;
                maxDistance = candidate.Distance;
                found = surface;
            }
        }

        return found;
    }

    /// <summary>The body with a surface; null for what is no body.</summary>
    public Body? BodyOf(StaticObject? target)
    {
        foreach (var (body, surface, _) in _surfaces)
        {
            if (surface.Target == target)
            {
                return body;
            }
        }

        return null;
    }

    private bool CanMeet(Body body) => Layers.CanMeet(_layer, _mask, body.Description.Layer, body.Description.Mask);

    private (Body Body, KinematicObject Object, ColliderInstance Collider) Create(Body body, MeshShape mesh)
    {
        var placed = new PlacedModel(new SceneObject(mesh.Model), mesh.Model) { ObjectToWorld = new(mesh.Linear, Vector.Zero) };
        var target = new StaticObject(statics, placed, -1, null);
        target.Kinematic = new(statics.Kinematics, target);
        _ = new SceneCollider(new LoadedScene(new(), [placed])).WithoutObject(0, out var collider);
        return (body, target.Kinematic, collider);
    }

    /// <summary>Where the origin of the model is, about which a surface turns.</summary>
    private static RigidPose PoseOf(Body body) =>
        new(body.Position - body.Orientation.Rotate(body.Description.Mesh!.Centre), body.Orientation);
}
