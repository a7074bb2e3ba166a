using System.Globalization;
using System.Text;

namespace FractalEngine.Render.Gl;

/// <summary>
/// The text of an embedded shader. GLSL has neither files to include nor a compiler's command line: a line <c>#include "name"</c> is
/// replaced by that file, and symbols are defined behind the line with the version.
/// </summary>
internal static class ShaderSource
{
    private const string IncludeDirective = "#include \"";

    /// <summary>Reads <c>Shaders/file</c>.</summary>
    /// <param name="file">Its first line gives the version.</param>
    /// <param name="symbols">What <c>#ifdef</c> finds.</param>
    public static string Read(string file, IReadOnlyList<string> symbols)
    {
        var text = new StringBuilder();
        var lines = EmbeddedResource.ReadText($"Shaders/{file}").Split('\n');
        for (var i = 0; i < lines.Length; i++)
        {
            if (lines[i].StartsWith(IncludeDirective, StringComparison.Ordinal))
            {
                text.Append(EmbeddedResource.ReadText($"Shaders/{lines[i][IncludeDirective.Length..].TrimEnd('\r', '"')}"));
                AppendLineDirective(text, i + 2);
                continue;
            }

            text.Append(lines[i]).Append('\n');
            if (i == 0 && symbols.Count > 0)
            {
                foreach (var symbol in symbols)
                {
                    text.Append("#define ").Append(symbol).Append('\n');
                }

                AppendLineDirective(text, 2);
            }
        }

        return text.ToString();
    }

    /// <summary>Lets the driver's messages count lines as the file does.</summary>
    private static void AppendLineDirective(StringBuilder text, int line) => text.Append(CultureInfo.InvariantCulture, $"#line {line}\n");
}
