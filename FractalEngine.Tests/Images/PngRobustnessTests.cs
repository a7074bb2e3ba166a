using System.Buffers.Binary;
using System.IO.Compression;
using FractalEngine.Core.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Images;

/// <summary>Damaged files and bombs: one kind of exception, and no more memory than the stated size.</summary>
public class PngRobustnessTests
{
    private const int MaxPixels = 10_000;

    // A block of rows, the decompressor's buffer, an exception.
    private const long Overhead = 128 * 1024;

    // If all pixels are in one row, three rows of the file with 8 bytes a pixel, and a converted one with 4.
    private const long Rows = ((3 * 8) + 4) * MaxPixels;

    [Fact]
    public void Read_OfAFileWithAnyBitFlipped_IsRefusedOrTheSame() => Seeded.Run(8, random =>
    {
        // CRCs find every single bit. It may turn an empty IDAT into a chunk that is not used; were it a tRNS, transparency would be lost.
        var (colourType, _) = PlainSamples.Kinds[random.Next(PlainSamples.Kinds.Length)];
        var samples = PlainSamples.Random(random, colourType, 8, isInterlaced: false, 3, 4) with { Transparency = null };
        var file = PlainPng.Encode(samples, random);
        var read = 0;
        for (var bit = 0; bit < 8 * file.Length; bit++)
        {
            var damaged = (byte[])file.Clone();
            damaged[bit / 8] ^= (byte)(1 << (bit % 8));
            if (Record.Exception(() => Assert.Equal(samples.ToImage().Pixels, Read(damaged).Pixels)) is { } exception)
            {
                Assert.IsType<PngException>(exception);
            }
            else
            {
                read++;
            }
        }

        // One of the 32 bits of the type of each empty chunk, of which there are few.
        Assert.InRange(read, 0, 3);
    });

    [Fact]
    public void Read_OfEachBeginningOfAFile_IsRefused() => Seeded.Run(10, random =>
    {
        var file = SmallFile(random);
        for (var length = 0; length < file.Length; length++)
        {
            var error = Assert.Throws<PngException>(() => Read(file[..length]));
            Assert.InRange(error.Offset, 0, length);
        }
    });

    [Fact]
    public void Read_OfDamagedFiles_GivesAnImageOrThrowsPngException() => Attack(firstSeed: 1, 10_000);

    [Fact]
    [Trait("Category", "Soak")]
    public void Read_OfAMillionDamagedFiles_GivesAnImageOrThrowsPngException() => Attack(firstSeed: 10_001, 1_000_000);

    [Fact]
    public void Read_OfAHugeHeader_AllocatesNothingForIt() => Assert.All((int[])[100_000, 1_000_000, int.MaxValue], side =>
    {
        var file = OfOneChunk(new(side, side, 6, 16, false, []), [1, 2, 3]);
        Assert.InRange(Allocated(() => Assert.Throws<PngException>(() => PngReader.Read(new MemoryStream(file)))), 0, 50_000);
    });

    [Fact]
    public void Read_OfABomb_DecompressesNoMoreThanTheImage()
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
        Assert.InRange(Allocated(() => Assert.Equal([0, 0, 0, 255], Read(file).Pixels)), 0, Overhead);
    }

    [Fact]
    public void Crc32_OfRandomBytesInPieces_IsThatOfTheBitwiseLoop() => Seeded.Run(200, random =>
    {
        var bytes = new byte[random.Next(200)];
        random.NextBytes(bytes);
        var cut = random.Next(bytes.Length + 1);
        Assert.Equal(PlainPng.Crc(bytes), Crc32.Append(Crc32.Append(0, bytes.AsSpan(0, cut)), bytes.AsSpan(cut)));
    });

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
                catch (PngException exception)
                {
                    Assert.InRange(exception.Offset, 0, file.Length);
                    Assert.DoesNotContain('\n', exception.Message);
                }
            });
            Assert.InRange(allocated, 0, (4 * MaxPixels) + Rows + Overhead);
        }));
        // Some repaired files are right: attacks that are all refused at the first checksum would test little.
        Assert.InRange(read, count / 50, count);
    }

    private static byte[] OfOneChunk(PlainSamples samples, byte[] data) =>
        [.. PlainPng.Signature, .. PlainPng.Head(samples), .. PlainPng.Chunk("IDAT", data), .. PlainPng.Chunk("IEND")];

    private static PixelImage Read(byte[] file) => PngReader.Read(new MemoryStream(file), MaxPixels);

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
