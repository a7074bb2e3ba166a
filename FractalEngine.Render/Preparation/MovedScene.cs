using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Drawables;

namespace FractalEngine.Render.Preparation;

/// <summary>A scene with its bodies and moving objects where they are. It stays the same object until one of them moves.</summary>
/// <param name="scene">The scene as it was loaded.</param>
public sealed class MovedScene(LoadedScene scene)
{
    private const int SphereFaceCount = 1280;

    private LoadedScene? _latest;
    private AffineMap[] _latestMaps = [];
    private MeshModel? _sphere;

    /// <summary>Returns the scene, with the spheres that were dropped into it.</summary>
    /// <param name="world">The bodies of the scene; null where there are none yet.</param>
    public LoadedScene With(PhysicsWorld? world)
    {
        AffineMap[] maps = world is null
            ? []
            :
            [
                .. world.Bodies.Select(static body => body.InterpolatedMap(1)),
                .. world.MovingObjects.Select(static moving => moving.InterpolatedMap(1)),
            ];
        if (_latest is null || !maps.SequenceEqual(_latestMaps))
        {
            _latestMaps = maps;
            _latest = maps.Length == 0 ? scene : Move(world!);
        }

        return _latest;
    }

    private LoadedScene Move(PhysicsWorld world)
    {
        var moved = world.GetCurrentScene();
        var spheres = world.Bodies
            .Where(static body => body.Description.ObjectIndex is null or < 0)
            .SelectMany(static body => Enumerable.Range(0, body.BallCount)
                .Select(ball => Transformation.At(body.BallCentre(ball), body.BallRadius(ball))))
            .Select(placement => new PlacedModel(new(_sphere ??= new(MeshGenerators.Create("icosphere", 0, SphereFaceCount)))
            {
                Name = "ball",
                Placement = placement,
                Colour = SphereInstance.Colour,
            }));
        return moved with { Objects = [.. moved.Objects, .. spheres] };
    }
}
