using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Adapts scenes that move to another folder to the files they name, which stay where they are.</summary>
public static class SceneRelocation
{
    /// <summary>Returns the scene with file names that mean the same files from its new place.</summary>
    /// <param name="scene">Scene whose file names are relative to <paramref name="from"/>.</param>
    /// <param name="from">Full path of the file that the scene was read from.</param>
    /// <param name="to">Full path of the file that the scene will be written to.</param>
    public static Scene Relocate(Scene scene, string from, string to)
    {
        var oldFolder = Path.GetDirectoryName(from)!;
        return oldFolder == Path.GetDirectoryName(to) ? scene : scene with
        {
            Objects = [.. scene.Objects.Select(declared => Path.IsPathRooted(declared.File ?? "/") ? declared : declared with
            {
                File = Relocate(declared.File!),
            })],
            Sky = scene.Sky is ImageSky sky ? sky with { File = Relocate(sky.File) } : scene.Sky,
        };

        string Relocate(string file) => Path.IsPathRooted(file) ? file : FileReference.Create(to, Path.Combine(oldFolder, file));
    }

    /// <summary>All files that a scene names: those of its objects, in their order, and that of its sky.</summary>
    /// <param name="scene">A scene.</param>
    internal static IEnumerable<string> FilesOf(Scene scene) =>
        scene.Objects.Select(static declared => declared.File).Append((scene.Sky as ImageSky)?.File).OfType<string>();
}
