using FractalEngine.Core.Scenes;
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
            Objects = [.. scene.Objects.Select(declared => Relocate(declared, oldFolder, to))],
        };
    }

    private static SceneObject Relocate(SceneObject declared, string oldFolder, string to) =>
        declared.File is not { } file || Path.IsPathRooted(file)
            ? declared
            : declared with { File = FileReference.Create(to, Path.Combine(oldFolder, file)) };
}
