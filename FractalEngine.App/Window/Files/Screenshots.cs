using FractalEngine.Core.Images;
using FractalEngine.Render.Images;

namespace FractalEngine.App.Window.Files;

/// <summary>Writes screenshots of a window.</summary>
internal static class Screenshots
{
    /// <summary>Saves an image into the folder <c>out</c>, under the next free number.</summary>
    /// <param name="image">The frame without its overlay.</param>
    /// <param name="path">Path of the file that the window shows.</param>
    /// <returns>A message for the user, in case of an error too.</returns>
    public static string Save(PixelImage image, string path)
    {
        try
        {
            Directory.CreateDirectory("out");
            var name = Path.GetFileNameWithoutExtension(path);
            var output = Enumerable.Range(1, int.MaxValue)
                .Select(number => Path.Combine("out", $"{name}-{number:D3}.png"))
                .First(candidate => !File.Exists(candidate));
            ImageFile.SavePng(image, output);
            return $"saved {output}";
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            return $"error: {exception.Message}";
        }
    }
}
