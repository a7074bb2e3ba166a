using FractalEngine.Core.Files;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Sdo;

namespace FractalEngine.Parsing.Editing;

/// <summary>Writes scenes under new names. No other file is ever replaced.</summary>
public static class NewSceneFile
{
    private const string Extension = ".sdo";

    /// <summary>Returns a name for the scene beside a file that no other file has.</summary>
    /// <param name="file">Full path of a scene, mesh or fractal.</param>
    public static string Propose(string file) => NewFile.Propose(
        Path.Combine(Path.GetDirectoryName(file)!, Path.GetFileName(file).Split('.')[0]), Extension, static path => !Path.Exists(path));

    /// <summary>Writes a scene. File names in it become relative to the new place.</summary>
    /// <param name="file">The file that the scene was loaded from.</param>
    /// <param name="scene">The scene to write.</param>
    /// <param name="path">Full path of the new file.</param>
    /// <param name="allowsOutsideFiles">Whether the scene can be opened where its models lie outside its folder.</param>
    /// <exception cref="IOException">
    /// The name is taken or has another ending, the file can't be written, or could not be opened there.
    /// </exception>
    public static void Write(LoadedFile file, Scene scene, string path, bool allowsOutsideFiles)
    {
        NewFile.Require(path, "a scene", Extension);
        var relocated = Relocate(file, scene, path);
        var folder = AssetFolder.ForFile(path);
        if (!allowsOutsideFiles
            && SceneRelocation.FilesOf(relocated).FirstOrDefault(named => !folder.Contains(FullPath(path, named))) is { } outside)
        {
            throw new IOException(
                $"\"{outside}\" lies outside the folder of {Path.GetFileName(path)}: save the scene above its models, "
                + "or allow that with --allow-outside");
        }

        NewFile.Write(path, SceneWriter.Write(relocated, file.ParsedScene));
    }

    /// <summary>Returns a scene as it is written elsewhere: its file names are relative to the new place.</summary>
    /// <param name="file">The file that the scene was loaded from.</param>
    /// <param name="scene">The scene to write.</param>
    /// <param name="path">Full path of the file that it will be written to.</param>
    /// <exception cref="IOException">The path of a file can't be written in a scene.</exception>
    public static Scene Relocate(LoadedFile file, Scene scene, string path)
    {
        var relocated = SceneRelocation.Relocate(scene, file.Path, path);
        return SceneRelocation.FilesOf(relocated).FirstOrDefault(static file => file.IndexOfAny(['"', '\n', '\r']) >= 0) is { } unnamed
            ? throw new IOException($"{unnamed}: a scene can't refer to a file with a quote or a line break in its path")
            : relocated;
    }

    private static string FullPath(string scene, string file) => Path.GetFullPath(Path.Combine(Path.GetDirectoryName(scene)!, file));
}
