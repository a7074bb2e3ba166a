using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry;

/// <summary>Reads mutated PLY and STL files: each gives a mesh, or one error with its place.</summary>
internal static class MeshMutation
{
    public static void Check(string name, int cases, byte[][] originals, Action<MeshBytes> read)
    {
        var parsedCount = 0;
        Seeded.Run(cases, random =>
        {
            var bytes = originals[random.Next(originals.Length)].ToList();
            for (var change = random.Next(1, 4); change > 0; change--)
            {
                var offset = random.Next(bytes.Count);
                bytes[offset] = (byte)(random.Next(2) == 0 ? random.Next(256) : "0123456789 -\n"[random.Next(13)]);
                bytes.RemoveRange(offset, random.Next(5) == 0 ? Math.Min(random.Next(6), bytes.Count - offset - 1) : 0);
            }

            try
            {
                read(new(name, bytes.ToArray()));
                parsedCount++;
            }
            catch (SourceException error)
            {
                Assert.Matches($@"^{name.Replace(".", @"\.", StringComparison.Ordinal)}:[1-9]\d*:[1-9]\d*: error: \S", error.Message);
            }
        });
        Assert.InRange(parsedCount, 100, cases - 100);
    }
}
