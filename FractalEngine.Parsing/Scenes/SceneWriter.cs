using System.Text;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Scenes;

/// <summary>
/// Writes scenes. Lines of the original file whose declarations are unchanged are kept as they stand, comments and layout too;
/// changed ones are written anew in their place, new ones at the end.
/// </summary>
public static class SceneWriter
{
    /// <summary>The text of a scene without an original.</summary>
    public static string Write(Scene scene) => Write(scene, null);

    /// <summary>The text of a scene that was loaded from a file, and may have been changed since.</summary>
    /// <param name="scene">As it is now.</param>
    /// <param name="original">As it was read; null for none.</param>
    public static string Write(Scene scene, SceneFile? original)
    {
        var text = new StringBuilder();
        var written = new HashSet<(SceneDeclarationKind, int)>();
        var lineBreak = original?.Source.Text.Contains("\r\n", StringComparison.Ordinal) == true ? "\r\n" : "\n";
        foreach (var line in original?.Lines ?? [])
        {
            if (line.Kind is not { } kind)
            {
                text.Append(line.Text);
                continue;
            }

            written.Add((kind, line.Index));
            var (originalText, currentText) =
                (SceneFormatter.Format(original!.Scene, kind, line.Index), SceneFormatter.Format(scene, kind, line.Index));
            text.Append(originalText == currentText ? line.Text : currentText is null ? "" : currentText + lineBreak);
        }

        foreach (var kind in SceneFormatter.Kinds)
        {
            for (var index = 0; index < SceneFormatter.DeclarationCount(scene, kind); index++)
            {
                if (written.Add((kind, index)))
                {
                    EnsureLineBreak(text, lineBreak);
                    text.Append(SceneFormatter.Format(scene, kind, index)).Append(lineBreak);
                }
            }
        }

        return text.ToString();
    }

    private static void EnsureLineBreak(StringBuilder text, string lineBreak)
    {
        if (text.Length > 0 && text[^1] is not ('\n' or '\r'))
        {
            text.Append(lineBreak);
        }
    }
}
