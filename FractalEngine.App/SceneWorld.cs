using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App;

/// <summary>Makes and steps the physics of a scene file, so that its errors name the file.</summary>
internal static class SceneWorld
{
    /// <summary>Makes the world of a scene.</summary>
    /// <exception cref="SourceException">The scene declares a body that none can be, such as one without size.</exception>
    public static PhysicsWorld Create(string path, LoadedScene scene, PhysicsSettings settings)
    {
        try
        {
            return new(scene, settings);
        }
        catch (ArgumentException exception)
        {
            // The settings have been checked by the command line, so this is about what the scene says of a body.
            throw new SourceException(path, exception.Message);
        }
    }

    /// <summary>Makes one step of a world.</summary>
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
