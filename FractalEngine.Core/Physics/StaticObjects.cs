using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>The objects of a scene that bodies run into, as colliders of one kind see them.</summary>
internal sealed class StaticObjects
{
    private readonly bool?[] _isSolid;
    private PlacedModel[] _objects;

    /// <summary>Nothing is built yet.</summary>
    public StaticObjects(IEnumerable<PlacedModel> objects, Scene scene, ColliderKind kind)
    {
        _objects = [.. objects];
        _isSolid = new bool?[_objects.Length];
        Collider = new(new LoadedScene(scene, [.. _objects]), kind);
    }

    /// <summary>Finds nearest points.</summary>
    public SceneCollider Collider { get; private set; }

    /// <summary>
    /// True for an object that is a closed solid, or made of such: what is behind its faces is within it. Looked at when it is first asked
    /// for.
    /// </summary>
    public bool IsSolid(int index) => _isSolid[index] ??= ClosedSurface.IsSolid(_objects[index].Model.Mesh);

    /// <summary>
    /// 1 where faces look out of an object as they are wound, −1 where its matrix mirrors it, 0 where its instances differ.
    /// </summary>
    public int WindingSign(int index) =>
        _objects[index].Model is FractalModel { Fractal.Description.PreservesOrientation: false }
        ? 0
        : Math.Sign(_objects[index].ObjectToWorld.Linear.Determinant());

    /// <summary>Builds all colliders now, and looks which objects are solids, instead of when they are first asked.</summary>
    public void Build()
    {
        Collider.Build();
        for (var i = 0; i < _objects.Length; i++)
        {
            IsSolid(i);
        }
    }

    /// <summary>Moves an object, and its collider with it.</summary>
    public void Move(int index, PlacedModel placed)
    {
        _objects = [.. _objects];
        _objects[index] = placed;
        Collider = Collider.WithObject(index, placed);
    }
}
