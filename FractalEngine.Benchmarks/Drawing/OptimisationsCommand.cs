using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>The words after <c>skips</c>: scenes and options.</summary>
internal static class OptimisationsCommand
{
    private const string Usage = """
        skips [SCENE.sdo ...] [--rounds N] [--output FOLDER]
          What each thing that is skipped saves, switched off alone: for the gallery, a scene of textures and a crowd of 400 objects, or the named files.
          --output: also as skips.csv.
        """;

    public static int Run(ReadOnlySpan<string> args)
    {
        var (rounds, folder, files) = (3, (string?)null, new List<string>());
        if (!new CommandLineParser(Usage).Count("--rounds", count => rounds = count).Option("--output", value => folder = value)
            .Names(File.Exists, files).TryParse(args))
        {
            return 2;
        }

        var csv = folder is null
            ? null
            : new CsvTable(Path.Combine(folder, "skips.csv"),
            FormattableString.Invariant($"skips{string.Concat(files.Select(file => " " + file))} --rounds {rounds}"),
            OptimisationTable.Columns);
        Write(new(rounds, Console.Out, csv), files);
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
