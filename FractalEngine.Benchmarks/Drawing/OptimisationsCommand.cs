using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>Runs the command <c>skips</c>, whose arguments are scenes and options.</summary>
internal static class OptimisationsCommand
{
    private const string Usage = """
        skips [SCENE.sdo ...] [--rounds N] [--images FOLDER] [--output FOLDER]
          What each optimisation saves, switched off alone.
          For the gallery, a scene of textures and a crowd of 400 objects, or the named files.
          --images: also the image of each scene, and those that differ from it, with eight times the difference.
          --output: also as skips.csv.
        """;

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        var rounds = 3;
        string? folder = null;
        string? images = null;
        var files = new List<string>();
        var parser = new CommandLineParser(Usage)
            .Count("--rounds", count => rounds = count)
            .Option("--output", value => folder = value)
            .Option("--images", value => images = Directory.CreateDirectory(value).FullName)
            .Names(File.Exists, files);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        var command = FormattableString.Invariant($"skips{string.Concat(files.Select(file => " " + file))} --rounds {rounds}");
        var csv = folder is null ? null : new CsvTable(Path.Combine(folder, "skips.csv"), command, OptimisationTable.Columns);
        Write(new(rounds, Console.Out, csv, images), files);
        csv?.Save();
        return 0;
    }

    private static void Write(OptimisationTable table, List<string> files)
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
