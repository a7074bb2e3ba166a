using System.Text;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Sdo;

/// <summary>
/// Writes scenes as text. Lines of an original file whose declarations are unchanged are kept, comments and layout included. Changed
/// declarations replace their lines; new ones are added at the end.
/// </summary>
public static class SceneWriter
{
    /// <summary>Returns the text of a scene that has no original file.</summary>
    public static string Write(Scene scene) => Write(scene, null);

    /// <summary>Returns the text of a scene that was loaded from a file and may have been changed since.</summary>
    /// <param name="scene">Current state of the scene.</param>
    /// <param name="original">Original contents of the file; null for none.</param>
    public static string Write(Scene scene, ParsedScene? original)
    {
        var text = new StringBuilder();
        var written = new HashSet<(SceneDeclarationKind, int)>();
        var lineBreak = original?.Source.LineBreak ?? "\n";
        foreach (var line in original?.Lines ?? [])
        {
            if (line.Kind is not { } kind)
            {
                text.Append(line.Characters);
                continue;
            }

            written.Add((kind, line.Index));
            var originalText = SceneFormatter.Format(original!.Scene, kind, line.Index);
            var currentText = SceneFormatter.Format(scene, kind, line.Index);
            if (originalText == currentText && !DependsOnHandedness(line, original!.Scene, scene))
            {
                text.Append(line.Characters);
            }
            else if (currentText is not null)
            {
                text.Append(currentText).Append(lineBreak);
            }
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

    /// <summary>Tells whether a camera's line means other angles now: those of a target depend on the handedness.</summary>
    private static bool DependsOnHandedness(SceneLine line, Scene original, Scene current) =>
        line.Kind == SceneDeclarationKind.Camera && original.Handedness != current.Handedness
        && line.Characters.Span.Contains(SceneParser.LookAtKeyword, StringComparison.Ordinal);

    private static void EnsureLineBreak(StringBuilder text, string lineBreak)
    {
        if (text.Length > 0 && text[^1] is not ('\n' or '\r'))
        {
            text.Append(lineBreak);
        }
    }
}
