using System.Buffers.Binary;
using System.IO.Compression;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Images;

/// <summary>Damaged files and bombs: one kind of exception, and memory for no more pixels than the file can hold.</summary>
public class ImageRobustnessTests
{
    // The buffer of the check, the decompressor's, an exception.
    private const long Overhead = 256 * 1024;

    // A byte holds at most 1032 bytes of pixels, of which eight may share one, and each has four once it is decoded.
    private const long MaxExpansion = 1032 * 8 * 4;

    [Fact]
    public void Read_OfAFileWithAnyBitFlipped_IsRefusedOrTheSame() => Seeded.Run(8, random =>
    {
        // CRCs find every single bit, but those that make a chunk one that is not used: were it a tRNS, transparency would be lost.
        var (colourType, _) = PlainSamples.Kinds[random.Next(PlainSamples.Kinds.Length)];
        var samples = PlainSamples.Random(random, colourType, 8, isInterlaced: false, 3, 4) with { Transparency = null };
        var file = PlainPng.Encode(samples, random);
        for (var bit = 0; bit < 8 * file.Length; bit++)
        {
            var damaged = (byte[])file.Clone();
            damaged[bit / 8] ^= (byte)(1 << (bit % 8));
            if (Record.Exception(() => Assert.Equal(samples.ToImage().Pixels, Read(damaged).Pixels)) is { } exception)
            {
                Assert.IsType<IOException>(exception);
            }
        }
    });

    [Fact]
    public void Read_OfEachBeginningOfAFile_IsRefused() => Seeded.Run(10, random =>
    {
        var file = SmallFile(random);
        for (var length = 0; length < file.Length; length++)
        {
            Assert.Throws<IOException>(() => Read(file[..length]));
        }
    });

    [Fact]
    public void Read_OfEachBeginningOfAJpeg_IsRefused()
    {
        // Where it ends within a segment that is skipped, the library alone would wait for its end for ever.
        byte[] file = [.. ImageDecoderTests.Jpeg[..2], 0xFF, 0xE1, 0, 40, .. new byte[38], .. ImageDecoderTests.Jpeg[2..]];
        Assert.Equal(8, Read(file).Width);
        for (var length = 0; length < file.Length; length++)
        {
            Assert.Throws<IOException>(() => Read(file[..length]));
        }
    }

    [Fact]
    public void Read_OfDamagedFiles_GivesAnImageOrThrowsIOException() => Attack(firstSeed: 1, 10_000);

    [Fact]
    [Trait("Category", "Soak")]
    public void Read_OfAMillionDamagedFiles_GivesAnImageOrThrowsIOException() => Attack(firstSeed: 10_001, 1_000_000);

    [Fact]
    public void Read_OfAHugeHeader_AllocatesNothingForIt() => Assert.All((int[])[100_000, 1_000_000, int.MaxValue], side =>
    {
        var file = OfOneChunk(new(side, side, 6, 16, false, []), [1, 2, 3]);
        Assert.InRange(Allocated(() => Assert.Throws<IOException>(() => Read(file))), 0, 50_000);
    });

    [Fact]
    public void Read_OfABomb_StopsSoon()
    {
        // 100 MB of zeros in 100 kB, as the data of one pixel.
        using var zeros = new MemoryStream();
        using (var stream = new ZLibStream(zeros, CompressionLevel.Fastest, leaveOpen: true))
        {
            var block = new byte[1_000_000];
            for (var i = 0; i < 100; i++)
            {
                stream.Write(block);
            }
        }

        var file = OfOneChunk(new(1, 1, 0, 8, false, []), zeros.ToArray());
        var error = default(IOException);
        // The file, and its compressed pixels in a buffer that doubles.
        Assert.InRange(Allocated(() => error = Assert.Throws<IOException>(() => Read(file))), 0, Overhead + (6 * file.Length));
        Assert.Equal("there are more compressed pixels than the image has", error!.Message);
    }

    private static void Attack(int firstSeed, int count)
    {
        var read = 0;
        Parallel.For(firstSeed, firstSeed + count, new() { MaxDegreeOfParallelism = 2 }, seed => Seeded.RunOne(seed, random =>
        {
            var file = Mutate(SmallFile(random), random);
            var allocated = Allocated(() =>
            {
                try
                {
                    var image = Read(file);
                    Assert.Equal(4 * image.Width * image.Height, image.Pixels.Length);
                    Interlocked.Increment(ref read);
                }
                catch (IOException exception)
                {
                    Assert.DoesNotContain(exception.Message, char.IsControl);
                }
            });
            Assert.InRange(allocated, 0, (MaxExpansion * file.Length) + Overhead);
        }));
        // Some repaired files are right: attacks that are all refused at the first checksum would test little.
        Assert.InRange(read, count / 50, count);
    }

    private static byte[] OfOneChunk(PlainSamples samples, byte[] data) =>
        [.. PlainPng.Signature, .. PlainPng.Head(samples), .. PlainPng.Chunk("IDAT", data), .. PlainPng.Chunk("IEND")];

    private static PixelImage Read(byte[] file) => ImageFile.Load(new MemoryStream(file), isTga: false);

    private static long Allocated(Action action)
    {
        var before = GC.GetAllocatedBytesForCurrentThread();
        action();
        return GC.GetAllocatedBytesForCurrentThread() - before;
    }

    private static byte[] SmallFile(Random random)
    {
        var (colourType, depth) = PlainSamples.Kinds[random.Next(PlainSamples.Kinds.Length)];
        var samples = PlainSamples.Random(random, colourType, depth, random.Next(2) == 0, random.Next(1, 12), random.Next(1, 12));
        return PlainPng.Encode(samples, random);
    }

    /// <summary>Flips bits, cuts and repeats pieces; then, mostly, repairs the CRCs, so that the damage reaches what lies behind.</summary>
    private static byte[] Mutate(byte[] file, Random random)
    {
        var bytes = file.ToList();
        for (var i = random.Next(1, 4); i > 0; i--)
        {
            var at = random.Next(bytes.Count);
            var count = random.Next(1, Math.Min(30, bytes.Count - at + 1));
            switch (random.Next(8))
            {
                case 0:
                    bytes.RemoveRange(at, count);
                    break;
                case 1:
                    bytes.InsertRange(random.Next(bytes.Count), bytes.GetRange(at, count));
                    break;
                case 2:
                    bytes.RemoveRange(at, random.Next(4) == 0 ? bytes.Count - at : 0);
                    break;
                case 3:
                    bytes[at] = (byte)random.Next(256);
                    break;
                case 4:
                    // A byte of the header.
                    bytes[Math.Min(bytes.Count - 1, random.Next(16, 29))] = (byte)random.Next(17);
                    break;
                default:
                    bytes[at] ^= (byte)(1 << random.Next(8));
                    break;
            }

            if (bytes.Count == 0)
            {
                return [];
            }
        }

        var damaged = bytes.ToArray();
        if (random.Next(5) != 0)
        {
            Repair(damaged);
        }

        return damaged;
    }

    private static void Repair(byte[] file)
    {
        var start = 8L;
        while (start + 12 <= file.Length)
        {
            var end = start + 8 + BinaryPrimitives.ReadUInt32BigEndian(file.AsSpan((int)start));
            if (end + 4 > file.Length)
            {
                return;
            }

            PlainPng.BigEndian((int)PlainPng.Crc(file.AsSpan((int)start + 4, (int)(end - start) - 4))).CopyTo(file, end);
            start = end + 4;
        }
    }
}
