using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing;

/// <summary>Tests that the limits of the parsers are those of the list, and each value that of its own limit.</summary>
[Collection(ConsoleTests.Name)]
public sealed class ParsingLimitTests
{
    private const long AnyInteger = int.MaxValue;

    [Fact]
    public void All_Limits_HaveTheirNamesValuesSubjectsAndReasons()
    {
        (string Name, long Default, long Maximum, string Subject, string Reason)[] expected =
        [
            ("obj-bytes", 1_073_741_824, 1_099_511_627_776, "bytes of a mesh file", "reading takes up to twice the memory of the mesh"),
            ("description-bytes", 16_777_216, AnyInteger, "bytes of a scene or fractal file", "far beyond what anyone writes"),
            ("scene-lines", 100_000, AnyInteger, "lines of a scene file", "about 70 MB where each is an object"),
            ("points-bytes", 268_435_456, 536_870_912, "bytes of a file of points", "memory: the text is held as a whole"),
            ("maps", 200_000, AnyInteger, "transformations in all sets of a fractal file", "about 50 MB"),
            ("names", 150_000, AnyInteger, "named objects and transformations of a fractal file", "about 70 MB"),
            ("repeated-steps", 1_000_000, AnyInteger, "steps that all recursives and sums of a fractal file repeat", "8 MB"),
            ("expression-terms", 5_000_000, 1_000_000_000, "terms of expressions in all calls of a fractal file", "a second or two"),
            ("base-files", 200, 100_000, "base meshes of a fractal, as often as files name them", "each is drawn by itself"),
            ("material-bytes", 16_777_216, AnyInteger, "bytes of a material file", "far beyond what anyone writes"),
            ("image-bytes", 67_108_864, AnyInteger, "bytes of an image file", "memory"),
            ("image-side", 8_192, 65_536, "pixels along a side of an image", "what every driver of the last fifteen years can hold"),
            ("image-pixels", 134_217_728, 1_099_511_627_776, "pixels of all images of one file", "512 MiB, decoded"),
            ("sky-pixels", 33_554_432, 268_435_456, "pixels of the image of a sky", "800 MB, with what is made of it"),
            ("polygon-corners", 20_000, AnyInteger, "corners of a polygon", "cutting it takes a time of their square at worst"),
            ("gltf-corners", 100_000_000, 500_000_000, "corners of all nodes of a glTF file", "about 6 GB"),
        ];
        Assert.Equal(
            expected,
            ParsingLimits.All.Select(static limit => (limit.Name, limit.Default, limit.Maximum, limit.Subject, limit.Reason)));
    }

    [Fact]
    public void Values_OfChangedLimits_AreThoseOfTheirOwn()
    {
        foreach (var limit in ParsingLimits.All)
        {
            Assert.Equal(limit.Default, limit.Value);
            limit.Value = limit.Default + 7;
            try
            {
                Assert.Equal([limit], ParsingLimits.All.Where(static other => other.Value != other.Default));
                Assert.Equal(limit.Default + 7, limit.Value);
            }
            finally
            {
                limit.Value = limit.Default;
            }
        }
    }
}
