using FractalEngine.App.Commands;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Images;

namespace FractalEngine.App.Window;

/// <summary>The files that a window writes. Each method returns a sentence for the user, also where it fails.</summary>
internal static class WindowFiles
{
    /// <summary>Saves a picture into <c>out/</c>, with the next free number.</summary>
    /// <param name="image">The scene alone.</param>
    /// <param name="path">The file that is shown.</param>
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
    /// Saves the scene with the present camera: into its own file, or beside a mesh or fractal, where it overwrites no other scene.
    /// </summary>
    public static string SaveScene(Document document) => Try(() =>
    {
        var output = Path.ChangeExtension(document.File.Path, ".sdo");
        if (document.File.Kind != FileKind.Scene && File.Exists(output))
        {
            throw new IOException($"{Path.GetFileName(output)} exists already and is another scene: it is not overwritten");
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
