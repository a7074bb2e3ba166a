using FractalEngine.App.Commands;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Images;

namespace FractalEngine.App.Window;

/// <summary>Writes the files of a window. Each method returns a message for the user, in case of an error too.</summary>
internal static class WindowFiles
{
    /// <summary>Saves an image into the folder <c>out</c>, under the next free number.</summary>
    /// <param name="image">The frame without its overlay.</param>
    /// <param name="path">Path of the file that the window shows.</param>
    public static string SaveScreenshot(PixelImage image, string path) => Try(() =>
    {
        Directory.CreateDirectory("out");
        var name = Path.GetFileNameWithoutExtension(path);
        var output = Enumerable.Range(1, int.MaxValue)
            .Select(number => Path.Combine("out", $"{name}-{number:D3}.png"))
            .First(candidate => !File.Exists(candidate));
        ImageFile.SavePng(image, output);
        return $"saved {output}";
    });

    /// <summary>
    /// Saves the scene with the present camera into its own file. For a mesh or fractal, a new scene file is created beside it.
    /// </summary>
    public static string SaveScene(Document document) => Try(() =>
    {
        var output = Path.ChangeExtension(document.File.Path, ".sdo");
        if (document.File.Kind != FileKind.Scene && File.Exists(output))
        {
            throw new IOException($"{Path.GetFileName(output)} is another scene, and is not overwritten");
        }

        SaveCommand.Save(document.File, document.GetCurrentScene(), output);
        return $"saved {Path.GetFileName(output)}";
    });

    private static string Try(Func<string> save)
    {
        try
        {
            return save();
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            return $"error: {exception.Message}";
        }
    }
}
