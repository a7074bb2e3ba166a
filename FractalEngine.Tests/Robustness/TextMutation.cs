using System.Text;

namespace FractalEngine.Tests.Robustness;

/// <summary>Changes the texts of the corpus as a careless or hostile author would: by words, lines and bytes.</summary>
internal static class TextMutation
{
    private static readonly string[] Words =
    [
        "", "0", "-1", "1", "2", "4", "1e308", "-1e308", "1e-308", "1e160", "1e-200", "nan", "inf", "999999999999", "0x10", "1,5",
        "#", "\"", "5", "1e200",
        "(", ")", "[", "]", "<$>.", "z", "x", "\u202E", "\u001B[31m", "é", "\uFEFF", "..", "/dev/zero",
        "\"base.obj\"", "\"scene.sdo\"", "f", "v",
        "1/", "//", "1000000", "100", "40",
    ];

    /// <summary>Makes one to four changes.</summary>
    public static byte[] Mutate(Random random, string text)
    {
        for (var changes = random.Next(1, 5); changes > 0; changes--)
        {
            text = Change(random, text);
        }

        var bytes = Encoding.UTF8.GetBytes(text);
        if (random.Next(10) == 0 && bytes.Length > 0)
        {
            bytes[random.Next(bytes.Length)] = (byte)random.Next(256);
        }

        return bytes;
    }

    private static string Change(Random random, string text)
    {
        var lines = text.Split('\n').ToList();
        var line = random.Next(lines.Count);
        switch (random.Next(7))
        {
            case 0:
                lines.RemoveAt(line);
                break;
            case 1:
                lines.Insert(random.Next(lines.Count), lines[line]);
                break;
            case 2:
                (lines[line], lines[0]) = (lines[0], lines[line]);
                break;
            case 3:
                // A line many times over.
                lines.InsertRange(line, Enumerable.Repeat(lines[line], random.Next(1, 200)));
                break;
            case 4:
                return text[..random.Next(text.Length + 1)];
            default:
                lines[line] = ChangeWord(random, lines[line]);
                break;
        }

        return string.Join(random.Next(20) == 0 ? "\r\n" : "\n", lines);
    }

    private static string ChangeWord(Random random, string line)
    {
        var words = line.Split(' ').ToList();
        var word = random.Next(words.Count);
        var replacement = Words[random.Next(Words.Length)];
        switch (random.Next(4))
        {
            case 0:
                words.Insert(word, replacement);
                break;
            case 1:
                words.InsertRange(word, Enumerable.Repeat(words[word], random.Next(1, 100)));
                break;
            default:
                words[word] = replacement;
                break;
        }

        return string.Join(' ', words);
    }
}
