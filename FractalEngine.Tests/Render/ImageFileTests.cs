using FractalEngine.Render.Images;

namespace FractalEngine.Tests.Render;

public sealed class ImageFileTests : IDisposable
{
    private readonly DirectoryInfo _directory = Directory.CreateTempSubdirectory("fractalengine-images-");

    public void Dispose() => _directory.Delete(recursive: true);

    [Fact]
    public void SavePng_AnyPixels_LoadsThemBack()
    {
        var image = new PixelImage(7, 5, new byte[7 * 5 * 4]);
        new Random(1).NextBytes(image.Pixels);
        var path = Path.Combine(_directory.FullName, "random ü.png");
        ImageFile.SavePng(image, path);
        var loaded = ImageFile.Load(path);
        Assert.Equal((7, 5), (loaded.Width, loaded.Height));
        Assert.Equal(image.Pixels, loaded.Pixels);
        Assert.Single(_directory.GetFiles());
    }

    [Fact]
    public void SavePng_ExistingFile_IsReplaced()
    {
        var path = Path.Combine(_directory.FullName, "twice.png");
        ImageFile.SavePng(new(1, 1, [1, 2, 3, 255]), path);
        ImageFile.SavePng(new(1, 1, [4, 5, 6, 255]), path);
        Assert.Equal((4, 5, 6, 255), ImageFile.Load(path)[0, 0]);
    }

    [Fact]
    public void SavePng_MissingDirectory_IsAnErrorThatNamesTheFile()
    {
        var path = Path.Combine(_directory.FullName, "missing", "x.png");
        var error = Assert.Throws<IOException>(() => ImageFile.SavePng(new(1, 1, new byte[4]), path));
        Assert.StartsWith($"{path} can't be written: ", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Load_NoImage_IsAnErrorThatNamesTheFile()
    {
        var path = Path.Combine(_directory.FullName, "text.png");
        File.WriteAllText(path, "no picture");
        Assert.StartsWith($"{path} can't be read: ", Assert.Throws<IOException>(() => ImageFile.Load(path)).Message,
            StringComparison.Ordinal);
    }
}
