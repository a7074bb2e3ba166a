using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Simulation;

/// <summary>The bodies and moving objects of a scene at the times of frames, which lie on a step of the physics or between two.</summary>
public sealed class AnimatedBodies
{
    // In steps: times are sums with rounding. A frame at the end of a step shows the bits of that step, as a still image does.
    private const double TimeTolerance = 1e-6;

    private readonly string _path;
    private readonly PhysicsWorld _world;
    private double _alpha = 1;

    /// <summary>Creates the bodies at time 0.</summary>
    /// <param name="path">Path of the scene, for messages.</param>
    /// <param name="file">The file that the scene was loaded from.</param>
    /// <param name="scene">The scene, perhaps with another projection.</param>
    /// <exception cref="SourceException">A body is invalid.</exception>
    public AnimatedBodies(string path, LoadedFile file, LoadedScene scene)
    {
        _path = path;
        _world = SceneWorld.Create(file, scene, new());
        Maps = CurrentMaps();
    }

    /// <summary>Returns a scene as it is after some time, as a frame of an animation shows it.</summary>
    /// <param name="path">Path of the scene, for messages.</param>
    /// <param name="file">The file that the scene was loaded from.</param>
    /// <param name="scene">The scene, perhaps with another projection.</param>
    /// <param name="seconds">Time since the beginning; at 0 the scene stays as it is.</param>
    /// <exception cref="SourceException">A body is invalid, or leaves the range of a double.</exception>
    public static LoadedScene SceneAfter(string path, LoadedFile file, LoadedScene scene, double seconds)
    {
        if (!(seconds > 0))
        {
            return scene;
        }

        var bodies = new AnimatedBodies(path, file, scene);
        bodies.AdvanceTo(seconds, CancellationToken.None);
        return bodies.GetScene();
    }

    /// <summary>Index of each body's object in the scene, and the map from its frame to world space.</summary>
    public IReadOnlyList<(int Index, AffineMap Map)> Maps { get; private set; }

    /// <summary>Lets the bodies move until a time.</summary>
    /// <param name="seconds">Since the beginning; no less than before.</param>
    /// <param name="cancellation">Cancels between two steps.</param>
    /// <returns>Whether anything is elsewhere than before.</returns>
    /// <exception cref="OperationCanceledException">The steps were cancelled.</exception>
    public bool AdvanceTo(double seconds, CancellationToken cancellation)
    {
        var step = _world.Settings.TimeStep;
        while (_world.Time + (TimeTolerance * step) < seconds)
        {
            cancellation.ThrowIfCancellationRequested();
            SceneWorld.Step(_path, _world);
        }

        var stepsAhead = (_world.Time - seconds) / step;
        _alpha = stepsAhead > TimeTolerance ? Math.Clamp(1 - stepsAhead, 0, 1) : 1;
        var before = Maps;
        Maps = CurrentMaps();
        return !Maps.SequenceEqual(before);
    }

    /// <summary>The scene with its objects where they are now.</summary>
    public LoadedScene GetScene() => _world.GetCurrentScene(_alpha);

    private (int Index, AffineMap Map)[] CurrentMaps() =>
    [
        .. _world.Bodies.Where(static body => body.Description.ObjectIndex is >= 0)
            .Select(body => (body.Description.ObjectIndex!.Value, body.InterpolatedMap(_alpha))),
        .. _world.MovingObjects.Where(static moving => moving.ObjectIndex is not null)
            .Select(moving => (moving.ObjectIndex!.Value, moving.InterpolatedMap(_alpha))),
    ];
}
