using FractalEngine.Core;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Simulation;

/// <summary>Creates and steps the physics of a scene file, with errors that name the file.</summary>
public static class SceneWorld
{
    /// <summary>Creates the world of a scene.</summary>
    /// <param name="file">The file that the scene was loaded from.</param>
    /// <param name="scene">The scene, perhaps with another projection.</param>
    /// <param name="settings">Time step and the like.</param>
    /// <exception cref="SourceException">The scene declares an invalid body, such as one without size.</exception>
    /// <exception cref="FractalEngineException">A limit is exceeded: of bodies that overlap, or of coordinates.</exception>
    public static PhysicsWorld Create(LoadedFile file, LoadedScene scene, PhysicsSettings settings)
    {
        try
        {
            PhysicsLimits.RequireRange(scene);
            var world = new PhysicsWorld(scene, settings);
            PhysicsLimits.Require(world.Bodies);
            PhysicsLimits.RequireRange(world);
            return world;
        }
        catch (SceneObjectException exception) when (file.ParsedScene is { } parsed)
        {
            throw parsed.Source.Error(
                parsed.DeclarationOffset(exception.ObjectIndex), exception.Message, exception.Kind == ErrorKind.Limit);
        }
    }

    /// <summary>Advances a world by one step.</summary>
    /// <exception cref="SourceException">A body leaves the range of a double, or goes beyond the limit of physics.</exception>
    public static void Step(string path, PhysicsWorld world)
    {
        try
        {
            world.Step();
            PhysicsLimits.RequireRange(world);
        }
        catch (InvalidOperationException exception)
        {
            throw new SourceException(path, exception.Message);
        }
        catch (FractalEngineException exception) when (exception.Kind == ErrorKind.Limit)
        {
            throw new SourceException(path, exception.Message, isLimitExceeded: true);
        }
    }
}
