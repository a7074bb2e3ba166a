using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Scenes;

/// <summary>Scenes that move to another folder while the files they name stay.</summary>
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
                .. scene.Objects.Select(declared => declared.File is not { } file || Path.IsPathRooted(file) ? declared : declared with
                {
                    // Scene files have slashes on every system.
                    File = Path.GetRelativePath(newFolder, Path.Combine(oldFolder, file)).Replace('\\', '/'),
                }),
            ],
        };
    }
}
