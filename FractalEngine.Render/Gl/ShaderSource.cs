using System.Globalization;
using System.Text;

namespace FractalEngine.Render.Gl;

/// <summary>
/// Reads embedded shaders. GLSL has neither include files nor a command line, so a line <c>#include "name"</c> is replaced by that file,
/// and symbols are defined after the version line.
/// </summary>
internal static class ShaderSource
{
    private const string IncludeDirective = "#include \"";

    /// <summary>Reads the file <c>Shaders/file</c>.</summary>
    /// <param name="file">Name of the file, whose first line gives the version.</param>
    /// <param name="symbols">Symbols that are defined for <c>#ifdef</c>.</param>
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

    /// <summary>Makes the driver's messages count lines as the file does.</summary>
    private static void AppendLineDirective(StringBuilder text, int line) => text.Append(CultureInfo.InvariantCulture, $"#line {line}\n");
}
