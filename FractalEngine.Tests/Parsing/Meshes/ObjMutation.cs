using System.Text;

namespace FractalEngine.Tests.Parsing.Meshes;

/// <summary>Makes OBJ files of all kinds of lines, and changes files a little: half of the results are still valid.</summary>
internal static class ObjMutation
{
    private static readonly string[] Lines =
    [
        "v 1 2 3", "v 0.5 -1.25 1e-3 0.5 0.5 0.5", "v .5 +2. 3 # comment", "v 1 2 3 nan -inf 0", "v 1 2 3 1",
        "v 1 2 3 1 0.25 .5 1", "v 1 2 3 0.1 0.2 0.3 # red", "v 1 2 3 4 5", "v 1 2 3 1 2 3 4 5",
        "v 123456789.123456789 12345678 0.00000001", "vt 0.5",
        "vt 0.5 1 0",
        "vn 0 0 1", "vn 0.1234567890123456789012 1 0", "f 1 2 3", "f -1 -2 -3", "f 1 2 3 4", "f 1 2", "f", "f 1// 2/ 3/1/",
        "f 1/1 2/1 3/1", "f 1//1 2//1 3//1",
        "f 1/1/1 -2/-1/-1 3/1/1 2/1/1", "f 1 2 3 4 5 6", "f 1/9 2 3//9", "o name", "g a b", "g", "usemtl red", "usemtl blue # c", "s 1",
        "s off", "mtllib a.mtl", "mtllib b c.mtl", "l 1 2", "p 1", "curv 0 1", "# comment \\", "#", "", "  \t",
        "v 1 \\\n2 3", "f 1 2 \\\r\n 3", "o \u00FC",
    ];

    private static readonly string[] Fragments =
    [
        "\\\n", "\\\r\n", "\\", "\r", "\n", "\r\n", "#", " # x\\\n", "/", "//", "-", "-1", "0", "999999999999", "nan", "1e400", "e5", ".",
        "\t", " ",
        "123456789012345678901234567890", "1.7976931348623159e308", "+", "\0", "\u00FC", "\uFEFF", "f 1 2 0", "v 1 2", "s x", "$ 1", "_x",
    ];

    /// <summary>Creates a valid file of 10 to 600 lines.</summary>
    public static byte[] CreateFile(Random random)
    {
        var text = new StringBuilder("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\nv 2 2 2\nvt 0 0\nvn 0 0 1\n");
        for (var count = random.Next(10, 600); count > 0; count--)
        {
            text.Append(Lines[random.Next(Lines.Length)]).Append(random.Next(20) == 0 ? "\r\n" : "\n");
        }

        return Encoding.UTF8.GetBytes(text.ToString());
    }

    /// <summary>Changes lines, which mostly leaves a file valid, and sometimes characters, which mostly does not.</summary>
    public static byte[] Mutate(byte[] original, Random random)
    {
        // Shared files are large. Few lines are enough for some blocks.
        var start = Math.Max(0, random.Next(-2000, original.Length));
        List<byte> bytes =
            [.. original.AsSpan(0, Math.Min(original.Length, 4000)), .. original.AsSpan(start, Math.Min(original.Length - start, 8000))];
        for (var change = random.Next(1, 4); change > 0; change--)
        {
            var offset = random.Next(bytes.Count + 1);
            var line = bytes.IndexOf((byte)'\n', offset) + 1;
            switch (random.Next(12))
            {
                case 0:
                    bytes.InsertRange(offset, Encoding.UTF8.GetBytes(Fragments[random.Next(Fragments.Length)]));
                    break;
                case 1:
                    bytes.RemoveRange(offset, Math.Min(random.Next(1, 10), bytes.Count - offset));
                    break;
                case 2:
                    bytes.InsertRange(line, Encoding.Latin1.GetBytes("# \u00FC\n"));
                    break;
                case 3 when line < bytes.Count:
                    bytes[line] = (byte)random.Next(256);
                    break;
                default:
                    bytes.InsertRange(line, Encoding.UTF8.GetBytes(Lines[random.Next(Lines.Length)] + "\n"));
                    break;
            }
        }

        return [.. bytes];
    }
}
