using FractalEngine.Core.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Images;

public class Crc32Tests
{
    [Fact]
    public void Append_OfRandomBytesInPieces_IsThatOfTheBitwiseLoop() => Seeded.Run(200, random =>
    {
        var bytes = new byte[random.Next(200)];
        random.NextBytes(bytes);
        var cut = random.Next(bytes.Length + 1);
        Assert.Equal(PlainPng.Crc(bytes), Crc32.Append(Crc32.Append(0, bytes.AsSpan(0, cut)), bytes.AsSpan(cut)));
    });
}
