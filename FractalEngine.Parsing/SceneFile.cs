using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Files;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing;

/// <summary>Reads and writes scenes as files (<c>.sdo</c>) with the models of their objects.</summary>
public static class SceneFile
{
    /// <summary>Reads a scene with the models of all its objects.</summary>
    /// <param name="path">Path of a file that ends in <c>.sdo</c>.</param>
    /// <param name="options">Options for loading; null for the defaults.</param>
    /// <exception cref="ArgumentException">The path does not end in <c>.sdo</c>.</exception>
    /// <exception cref="SourceException">The file, or one that it refers to, can't be loaded.</exception>
    public static Scene Read(string path, LoadOptions? options = null)
    {
        FileKinds.Require(path, FileKind.Scene);
        return AssetLoader.Load(path, options).Scene.Scene;
    }

    /// <summary>Creates or replaces the file of a scene, numbers bit for bit.</summary>
    /// <param name="path">Path that ends in <c>.sdo</c>; its folder is created if it is missing.</param>
    /// <param name="scene">Scene made in code or read from a file.</param>
    /// <exception cref="ArgumentException">The path does not end in <c>.sdo</c>.</exception>
    /// <exception cref="FractalEngineException">The scene or a model can't be expressed in the files.</exception>
    /// <exception cref="IOException">A file can't be written. No new file is left then, and old ones are unchanged.</exception>
    /// <remarks>
    /// Models that were loaded from files keep their files, which are named relative to the new one. Reading needs
    /// <see cref="LoadOptions.AllowOutsideFiles"/> if they lie outside its <see cref="AssetFolder"/>. Other models are written beside the
    /// scene, each once, under the names of the scene and the object; files with other contents are never replaced. An object without a
    /// model keeps the name of its file. Comments of an original file are lost; <see cref="SceneWriter"/> keeps them.
    /// </remarks>
    public static void Write(string path, Scene scene)
    {
        FileKinds.Require(path, FileKind.Scene);
        ArgumentNullException.ThrowIfNull(scene);
        using var companions = new NewFiles();
        var models = new SceneModelWriter(Path.GetFullPath(path), companions);
        var named = scene with
        {
            Objects = [.. scene.Objects.Select(declared => declared with { File = models.FileOf(declared) })],
            Sky = scene.Sky is ImageSky { Image.SourcePath: { } image } sky
                ? sky with { File = FileReference.Create(Path.GetFullPath(path), image) }
                : scene.Sky,
        };
        var text = WriteText(named);
        AtomicFile.Write(path, stream => stream.Write(text));
        companions.Keep();
    }

    private static byte[] WriteText(Scene scene)
    {
        foreach (var name in SceneRelocation.FilesOf(scene).Concat(scene.Objects.Select(static declared => declared.Name ?? "")))
        {
            FileReference.RequireQuotable(name);
        }

        var text = SceneWriter.Write(scene);
        var bytes = Encoding.UTF8.GetBytes(text);
        if (bytes.Length > ParsingLimits.DescriptionBytes.Value)
        {
            throw Fault(ErrorKind.Limit, $"its text has more than the limit of {ParsingLimits.DescriptionBytes.Value} bytes");
        }

        RequireReadable(text, scene);
        return bytes;
    }

    /// <summary>The parser decides about all values, so that both never disagree.</summary>
    private static void RequireReadable(string text, Scene scene)
    {
        try
        {
            if (!SceneParser.Parse(new SourceText("scene.sdo", text)).Scene.Equals(scene))
            {
                throw Fault(ErrorKind.Input, "a value does not read back as it is");
            }
        }
        catch (SourceException exception)
        {
            throw Fault(exception.Kind, exception.Diagnostic.Message, exception);
        }
    }

    private static FractalEngineException Fault(ErrorKind kind, string fault, Exception? innerException = null) =>
        new(kind, $"the scene can't be written as a file: {fault}", innerException);
}
