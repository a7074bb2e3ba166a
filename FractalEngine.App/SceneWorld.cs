using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App;

/// <summary>Creates and steps the physics of a scene file, with errors that name the file.</summary>
internal static class SceneWorld
{
    /// <summary>Creates the world of a scene.</summary>
    /// <exception cref="SourceException">The scene declares an invalid body, such as one without size.</exception>
    public static PhysicsWorld Create(string path, LoadedScene scene, PhysicsSettings settings)
    {
        try
        {
            return new(scene, settings);
        }
        catch (ArgumentException exception)
        {
            // The command line has checked the settings, so the scene declares an invalid body.
            throw new SourceException(path, exception.Message);
        }
    }

    /// <summary>Advances a world by one step.</summary>
    /// <exception cref="SourceException">A body leaves the range of a double.</exception>
    public static void Step(string path, PhysicsWorld world)
    {
        try
        {
            world.Step();
        }
        catch (InvalidOperationException exception)
        {
            throw new SourceException(path, exception.Message);
        }
    }
}
