using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Images;

/// <summary>The same files by SDL2_image, that is by libpng. Left out where the library is missing.</summary>
[Collection(Name)]
public sealed class SdlComparisonTests : IDisposable
{
    /// <summary>Tests that call the library, which loads its own libraries without locks.</summary>
    public const string Name = "SDL2_image";

    private readonly TemporaryFolder _folder = new();

    public static TheoryData<int, int, bool> Kinds => PngReaderTests.Kinds;

    public static TheoryData<string> Images =>
        [.. ((string[])["assets", "docs"])
            .SelectMany(folder => Directory.GetFiles(Repository.Full(folder), "*.png", SearchOption.AllDirectories))
            .Select(file => Path.GetRelativePath(Repository.Root, file)).Order(StringComparer.Ordinal)];

    /// <summary>Skips a test where the library is missing.</summary>
    public static void RequireSdl() => Skip.If(
        Record.Exception(() => SdlImage.Read("no such file")) is DllNotFoundException, "SDL2_image is missing");

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [MemberData(nameof(Kinds))]
    public void Read_OfEachKind_GivesThePixelsOfSdl(int colourType, int depth, bool isInterlaced)
    {
        RequireSdl();
        Seeded.Run(5, random => AssertEqual(random, colourType, depth, isInterlaced));
    }

    [SkippableFact]
    public void Write_OfRandomImages_IsReadBackBySdl()
    {
        RequireSdl();
        Seeded.Run(50, random =>
        {
            var image = PngWriterTests.Image(random, random.Next(1, 70), random.Next(1, 30));
            Assert.Equal(image.Pixels, ReadBySdl(PngWriterTests.Write(image)).Pixels);
        });
    }

    [SkippableTheory]
    [MemberData(nameof(Images))]
    public void Read_OfImagesOfTheProject_GivesThePixelsOfSdl(string file)
    {
        RequireSdl();
        var image = ImageFile.Load(Repository.Full(file));
        var expected = ReadBySdl(File.ReadAllBytes(Repository.Full(file)));
        Assert.Equal((expected.Width, expected.Height), (image.Width, image.Height));
        Assert.True(expected.Pixels.AsSpan().SequenceEqual(image.Pixels));
    }

    private void AssertEqual(Random random, int colourType, int depth, bool isInterlaced)
    {
        var samples = PlainSamples.Random(random, colourType, depth, isInterlaced, random.Next(1, 40), random.Next(1, 20));
        if (colourType == 0 || depth == 16)
        {
            // SDL2_image 2.6.3 gives transparent grey colours that are nowhere in the file, and compares RGB of 16 bits once it is reduced.
            samples = samples with { Transparency = null };
        }

        var file = PlainPng.Encode(samples, random);
        var expected = ReadBySdl(file);
        var actual = PngReader.Read(new MemoryStream(file));
        Assert.Equal((expected.Width, expected.Height), (actual.Width, actual.Height));
        // It cuts samples of 16 bits after the eighth, where the nearest of 8 bits may be one more, or, above the middle, one less.
        var tolerance = depth == 16 ? 1 : 0;
        Assert.All(expected.Pixels.Zip(actual.Pixels), pair => Assert.InRange(pair.Second - pair.First, -tolerance, tolerance));
    }

    private PixelImage ReadBySdl(byte[] file)
    {
        var path = _folder["image.png"];
        File.WriteAllBytes(path, file);
        return SdlImage.Read(path);
    }
}
