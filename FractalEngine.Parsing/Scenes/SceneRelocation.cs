using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Scenes;

/// <summary>Adapts scenes that move to another folder to the files they name, which stay where they are.</summary>
public static class SceneRelocation
{
    /// <summary>The scene with file names that mean the same files from its new place.</summary>
    /// <param name="scene">Whose names are relative to <paramref name="from"/>.</param>
    /// <param name="from">Full path of the file it was read from.</param>
    /// <param name="to">Full path of the file it will be written to.</param>
    public static Scene Relocate(Scene scene, string from, string to)
    {
        var (oldFolder, newFolder) = (Path.GetDirectoryName(from)!, Path.GetDirectoryName(to)!);
        return oldFolder == newFolder ? scene : scene with
        {
            Objects =
            [
                .. scene.Objects.Select(declared => Path.IsPathRooted(declared.File) ? declared : declared with
                {
                    // Scene files have slashes on every system.
                    File = Path.GetRelativePath(newFolder, Path.Combine(oldFolder, declared.File)).Replace('\\', '/'),
                }),
            ],
        };
    }
}
