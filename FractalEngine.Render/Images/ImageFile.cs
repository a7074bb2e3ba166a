using System.Runtime.InteropServices;

namespace FractalEngine.Render.Images;

/// <summary>Reads and writes pictures with SDL2_image.</summary>
public static class ImageFile
{
    private const string InstallHint =
        "pictures need SDL2_image (Debian: libsdl2-image-2.0-0; Windows: SDL2.dll and SDL2_image.dll beside the program; macOS: brew install sdl2_image)";

    /// <summary>Writes a PNG file. An existing file is replaced only once the new one is complete.</summary>
    /// <param name="image">The picture.</param>
    /// <param name="path">Relative to the working directory, or absolute; its directory must exist.</param>
    /// <exception cref="IOException">The file can't be written, or SDL2_image is missing.</exception>
    public static void SavePng(PixelImage image, string path)
    {
        var temporaryPath = $"{path}.{Guid.NewGuid():N}.tmp";
        try
        {
            Write(image, path, temporaryPath);
            File.Move(temporaryPath, path, overwrite: true);
        }
        catch (Exception exception) when (exception is DllNotFoundException or EntryPointNotFoundException)
        {
            throw new IOException($"{path} can't be written: {InstallHint}", exception);
        }
        finally
        {
            // Gone after the move; not there at all where its directory is missing.
            if (File.Exists(temporaryPath))
            {
                File.Delete(temporaryPath);
            }
        }
    }

    /// <summary>Reads a picture of any format that SDL2_image knows.</summary>
    /// <exception cref="IOException">The file can't be read, or SDL2_image is missing.</exception>
    public static PixelImage Load(string path)
    {
        try
        {
            return Read(path);
        }
        catch (Exception exception) when (exception is DllNotFoundException or EntryPointNotFoundException)
        {
            throw new IOException($"{path} can't be read: {InstallHint}", exception);
        }
    }

    private static unsafe void Write(PixelImage image, string path, string temporaryPath)
    {
        fixed (byte* pixels = image.Pixels)
        {
            var surface = SdlImage.CreateSurfaceFrom((IntPtr)pixels, image.Width, image.Height, 32, 4 * image.Width, SdlImage.RgbaFormat);
            if (surface == IntPtr.Zero)
            {
                throw new IOException(
                    $"{path} can't be written: {SdlImage.ErrorText().Replace(temporaryPath, path, StringComparison.Ordinal)}");
            }

            try
            {
                if (SdlImage.SavePng(surface, temporaryPath) != 0)
                {
                    throw new IOException(
                        $"{path} can't be written: {SdlImage.ErrorText().Replace(temporaryPath, path, StringComparison.Ordinal)}");
                }
            }
            finally
            {
                SdlImage.FreeSurface(surface);
            }
        }
    }

    private static unsafe PixelImage Read(string path)
    {
        var loaded = SdlImage.Load(path);
        if (loaded == IntPtr.Zero)
        {
            throw new IOException($"{path} can't be read: {SdlImage.ErrorText()}");
        }

        var surface = SdlImage.ConvertSurface(loaded, SdlImage.RgbaFormat, 0);
        SdlImage.FreeSurface(loaded);
        if (surface == IntPtr.Zero)
        {
            throw new IOException($"{path} can't be read: {SdlImage.ErrorText()}");
        }

        try
        {
            ref readonly var header = ref *(SdlSurface*)surface;
            var pixels = new byte[4 * header.Width * header.Height];
            for (var y = 0; y < header.Height; y++)
            {
                Marshal.Copy(header.Pixels + (y * header.Pitch), pixels, 4 * header.Width * y, 4 * header.Width);
            }

            return new(header.Width, header.Height, pixels);
        }
        finally
        {
            SdlImage.FreeSurface(surface);
        }
    }
}
