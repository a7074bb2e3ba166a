using System.Globalization;
using System.Text;

namespace FractalEngine.Core;

/// <summary>Makes text from files and from the command line safe to show on a terminal.</summary>
public static class DisplayText
{
    /// <summary>
    /// Replaces control characters other than tabs, characters that turn the direction of writing or can't be seen, and halves of surrogate
    /// pairs by <c>\uXXXX</c>. The names of files may have line breaks, too.
    /// </summary>
    public static string Escape(string text)
    {
        ArgumentNullException.ThrowIfNull(text);
        var escaped = new StringBuilder(text.Length);
        for (var i = 0; i < text.Length; i++)
        {
            if (IsHidden(text, i))
            {
                escaped.Append(CultureInfo.InvariantCulture, $"\\u{(int)text[i]:X4}");
            }
            else
            {
                escaped.Append(text[i]);
            }
        }

        return escaped.ToString();
    }

    /// <summary>Tells whether the character at an index is replaced.</summary>
    public static bool IsHidden(string text, int index)
    {
        ArgumentNullException.ThrowIfNull(text);
        var character = text[index];
        return character is not '\t' && char.GetUnicodeCategory(character) switch
        {
            UnicodeCategory.Control or UnicodeCategory.Format => true,
            UnicodeCategory.LineSeparator or UnicodeCategory.ParagraphSeparator => true,
            UnicodeCategory.Surrogate => !(
                (index + 1 < text.Length && char.IsSurrogatePair(text, index)) || (index > 0 && char.IsSurrogatePair(text, index - 1))),
            _ => false,
        };
    }
}
