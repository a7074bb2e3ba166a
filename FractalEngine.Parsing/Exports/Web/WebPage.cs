using System.IO.Compression;
using System.Net;
using System.Text;
using System.Text.Json;

namespace FractalEngine.Parsing.Exports.Web;

/// <summary>Puts a page together: its viewer, and the data that it shows.</summary>
internal static class WebPage
{
    private static readonly string[] Scripts = ["maths.js", "levels.js", "occlusion.js", "walk.js", "gpu.js", "camera.js", "viewer.js"];
    private static readonly string[] Shaders =
    [
        "scene.vert", "scene.frag", "sky.vert", "sky.frag", "shadow.frag", "gather.frag", "show.frag", "lit.glsl", "tone.glsl",
    ];

    /// <summary>Writes the shaders of the viewer, as a JSON object of their names.</summary>
    public static void WriteShaders(Utf8JsonWriter json) =>
        json.WriteObject("shaders", () => Array.ForEach(Shaders, shader => json.WriteString(shader, Read(shader))));

    /// <summary>Makes the text of a page.</summary>
    /// <param name="title">Its title, plain text.</param>
    /// <param name="data">JSON, UTF-8, with the shaders. It is deflated, since numbers as text take three times the room.</param>
    public static byte[] Assemble(string title, byte[] data)
    {
        var page = new StringBuilder("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n")
            .Append("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>")
            .Append(WebUtility.HtmlEncode(title)).Append("</title>\n<style>\n").Append(Read("viewer.css")).Append("</style>\n</head>\n")
            .Append(Read("viewer.html"));
        page.Append("<script type=\"text/plain\" id=\"data\">").Append(Convert.ToBase64String(Deflate(data)))
            .Append("</script>\n<script>\n\"use strict\";\n").AppendJoin("", Scripts.Select(Read)).Append("</script>\n</html>\n");
        return Encoding.UTF8.GetBytes(page.ToString());
    }

    private static byte[] Deflate(byte[] data)
    {
        using var target = new MemoryStream();
        using (var deflate = new DeflateStream(target, CompressionLevel.SmallestSize))
        {
            deflate.Write(data);
        }

        return target.ToArray();
    }

    /// <summary>Reads a part of the viewer, without the lines that are comments, empty lines and indentation.</summary>
    private static string Read(string name)
    {
        using var stream = typeof(WebPage).Assembly.GetManifestResourceStream("Web/" + name)
            ?? throw new InvalidOperationException($"the assembly lacks the resource {name}");
        using var reader = new StreamReader(stream, Encoding.UTF8);
        var text = new StringBuilder();
        while (reader.ReadLine() is { } line)
        {
            var trimmed = line.AsSpan().Trim();
            if (!trimmed.IsEmpty && !trimmed.StartsWith("//"))
            {
                text.Append(trimmed).Append('\n');
            }
        }

        return text.ToString();
    }
}
