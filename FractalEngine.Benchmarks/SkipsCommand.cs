using System.Globalization;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks;

/// <summary>The words after <c>skips</c>: scenes and options.</summary>
internal static class SkipsCommand
{
    private const string Usage = """
        skips [SCENE.sdo ...] [--rounds N]
          What each thing that is skipped saves, switched off alone: for the gallery, a scene of textures and a crowd of 400 objects, or the named files.
        """;

    public static int Run(ReadOnlySpan<string> args)
    {
        var (rounds, files) = (3, new List<string>());
        for (var i = 0; i < args.Length; i++)
        {
            switch (args[i])
            {
                case "--rounds" when i + 1 < args.Length && int.TryParse(args[i + 1], NumberStyles.None, CultureInfo.InvariantCulture, out rounds) && rounds > 0:
                    i++;
                    break;
                case { } file when File.Exists(file):
                    files.Add(file);
                    break;
                default:
                    Console.Error.WriteLine($"error: unexpected '{args[i]}'\n{Usage}");
                    return 2;
            }
        }

        try
        {
            Write(new(rounds, Console.Out), files);
            return 0;
        }
        catch (SourceException exception)
        {
            Console.Error.WriteLine(exception.Diagnostic);
            return 1;
        }
        catch (GraphicsUnavailableException exception)
        {
            Console.Error.WriteLine($"error: {exception.Message}");
            return 3;
        }
    }

    private static void Write(SkipTable table, List<string> files)
    {
        if (files.Count > 0)
        {
            files.ForEach(table.Write);
            return;
        }

        table.Write(Path.Combine(FractalCase.Assets, "scenes", "gallery.sdo"));
        table.Write(Path.Combine(FractalCase.Assets, "scenes", "textured.sdo"));
        using var crowd = new CrowdScene();
        table.Write(crowd.Path);
    }
}
