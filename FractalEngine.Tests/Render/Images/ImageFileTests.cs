using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Images;

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
    public void SavePng_MissingFolder_IsCreated()
    {
        var path = Path.Combine(_directory.FullName, "missing", "folders", "x.png");
        new PixelImage(1, 1, [1, 2, 3, 4]).SavePng(path);
        Assert.Equal((1, 2, 3, 4), ImageFile.Load(path)[0, 0]);
    }

    [Fact]
    public void SavePng_BelowAFile_IsAnErrorThatNamesTheFile()
    {
        File.WriteAllText(Path.Combine(_directory.FullName, "file"), "");
        var path = Path.Combine(_directory.FullName, "file", "x.png");
        var error = Assert.Throws<IOException>(() => ImageFile.SavePng(new(1, 1, new byte[4]), path));
        Assert.StartsWith($"{path} can't be written: ", error.Message, StringComparison.Ordinal);
        // The temporary file, which is written first, is not mentioned.
        Assert.DoesNotContain(".tmp", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Load_NoImage_IsAnErrorThatNamesTheFile()
    {
        var path = Path.Combine(_directory.FullName, "text.png");
        File.WriteAllText(path, "no image");
        Assert.StartsWith($"{path} can't be read: ", ErrorOf(path), StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("P6 30000 30000 255\n")]
    [InlineData("/* XPM */\nstatic char*a[]={\"60000 60000 1 1\",\"a c #000000\"};")]
    [InlineData("GIF89a")]
    public void Load_OfAnotherFormat_IsRefusedBeforeADecoderSeesIt(string contents)
    {
        var path = Path.Combine(_directory.FullName, "image.ppm");
        File.WriteAllText(path, contents);
        Assert.Equal($"{path} can't be read: it is not a PNG, JPEG, BMP or TGA image", ErrorOf(path));
    }

    [Fact]
    public void Load_OfAPngByAnotherName_KnowsItByItsFirstBytes()
    {
        var path = Path.Combine(_directory.FullName, "image.jpg");
        ImageFile.SavePng(new(1, 1, [1, 2, 3, 4]), path);
        Assert.Equal((1, 2, 3, 4), ImageFile.Load(path)[0, 0]);
    }

    [Fact]
    public void Load_OfADamagedPng_SaysWhere()
    {
        var path = Path.Combine(_directory.FullName, "cut.png");
        ImageFile.SavePng(new(1, 1, [1, 2, 3, 4]), path);
        File.WriteAllBytes(path, File.ReadAllBytes(path)[..30]);
        Assert.Equal($"{path} can't be read: byte 30: the file ends before the chunk IEND", ErrorOf(path));
    }

    [Fact]
    public void Load_OfAnImageThatItsFileCantHold_IsRefusedBeforeADecoderSeesIt()
    {
        var path = Path.Combine(_directory.FullName, "image.tga");
        File.WriteAllBytes(path, [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 32, 0, 32, 24, 0]);
        Assert.Equal($"{path} can't be read: it is cut off: 8192×8192 pixels need at least 201326610 bytes, and it has 18", ErrorOf(path));
    }

    [Fact]
    public void Load_OfATgaByAnotherName_IsRefused()
    {
        var path = Path.Combine(_directory.FullName, "image.bin");
        byte[] tga = [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 24, 0, 10, 20, 30];
        File.WriteAllBytes(path, tga);
        Assert.Equal($"{path} can't be read: it is not a PNG, JPEG, BMP or TGA image", ErrorOf(path));
        File.WriteAllBytes(Path.ChangeExtension(path, "TGA"), tga);
        Assert.Equal((30, 20, 10, 255), ImageFile.Load(Path.ChangeExtension(path, "TGA"))[0, 0]);
    }

    [SkippableFact]
    public void Load_OfAHugeFile_IsRefusedBeforeItIsRead()
    {
        Elsewhere.SkipOnWindows("files have no holes");
        var path = Path.Combine(_directory.FullName, "huge.png");
        new PixelImage(1, 1, [1, 2, 3, 4]).SavePng(path);
        using (var stream = File.OpenWrite(path))
        {
            stream.SetLength((1L << 30) + 1);
        }

        Assert.Equal($"{path} can't be read: the file has 1073741825 bytes, more than the limit of 1073741824", ErrorOf(path));
    }

    [Fact]
    public void Load_OfABmp_GivesItsPixel()
    {
        var path = Path.Combine(_directory.FullName, "image.bmp");
        File.WriteAllBytes(path, Bmp);
        Assert.Equal((30, 20, 10, 255), ImageFile.Load(path)[0, 0]);
    }

    [Fact]
    public void Load_OfAMissingFile_IsAnErrorThatNamesIt()
    {
        var path = Path.Combine(_directory.FullName, "missing.png");
        Assert.StartsWith($"{path} can't be read: ", ErrorOf(path), StringComparison.Ordinal);
    }

    [SkippableFact]
    public void Load_OfAPipe_IsAnErrorAtOnce()
    {
        Elsewhere.SkipOnWindows("there are no named pipes in folders");
        var path = Path.Combine(_directory.FullName, "pipe.png");
        System.Diagnostics.Process.Start("mkfifo", path).WaitForExit();
        // On a thread of its own: those of the pool may all be taken by other tests.
        var load = Task.Factory.StartNew(() => ErrorOf(path), default, TaskCreationOptions.LongRunning, TaskScheduler.Default);
        Assert.True(load.Wait(Polling.Deadline), "opening the pipe waits");
        Assert.Equal($"{path} can't be read: it is a pipe or a device", load.Result);
    }

    private static string ErrorOf(string path) => Assert.Throws<IOException>(() => ImageFile.Load(path)).Message;

    /// <summary>One pixel of 24 bits: blue, green, red.</summary>
    private static byte[] Bmp =>
    [
        .. "BM"u8, 58, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 24, 0, .. new byte[24], 10, 20, 30, 0,
    ];
}
