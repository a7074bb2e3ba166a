using System.Globalization;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Paper;

/// <summary>
/// Runs the command <c>paper</c>, which measures the paper's own tables, figures 17 and 18, and writes what the paper prints beside them.
/// </summary>
internal static class PaperCommand
{
    private const string Usage = """
        paper [--output FOLDER]
          Load time, storage and collision cost of the paper's five models. Takes some minutes and 8 GB.
          Writes paper-figure17.csv and paper-figure18.csv, to docs/benchmarks unless stated.
        """;

    private static readonly string[] Columns17 =
    [
        "model", "name", "fractal", "faces", "paper_faces", "load_s", "every_instance_load_s", "paper_load_s", "storage_bytes",
        "paper_storage_bytes", "collision_cost", "paper_collision_cost", "own_collider_cost", "note",
    ];

    private static readonly string[] Columns18 =
    [
        "model", "name", "faces", "simple", "paper_simple", "fractal", "paper_fractal", "boxes", "paper_boxes", "box_depth",
        "own_collider_faces", "own_collider_bounds", "fractal_wrong_percent", "boxes_wrong_percent", "note",
    ];

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        var output = CommandLineParser.DefaultFolder;
        if (!new CommandLineParser(Usage).Option("--output", value => output = value).TryParse(args))
        {
            return 2;
        }

        var folder = Directory.CreateTempSubdirectory("fractalengine");
        try
        {
            var rows = PaperModel.All.Select(model => Measure(model, model.EnsureFile(folder.FullName))).ToArray();
            Write(output, "paper-figure17.csv", Columns17, [.. rows.Select(row => row.Figure17)]);
            Write(output, "paper-figure18.csv", Columns18, [.. rows.Select(row => row.Figure18)]);
        }
        finally
        {
            folder.Delete(recursive: true);
        }

        return 0;
    }

    private static (object?[] Figure17, object?[] Figure18) Measure(PaperModel paper, string file)
    {
        var loaded = PaperModel.Load(file);
        var model = PaperModel.ModelOf(loaded);
        var load = Math.Round(PaperLoading.MeasureSeconds(file), 6);
        var everyInstanceLoad = Math.Round(PaperLoading.MeasureSecondsWithEveryInstance(file), 6);
        var cost = PaperCollision.Measure(model);
        return (
            [
                paper.Id, paper.Name, paper.Shape is null ? "N" : "Y", model.FaceCount, paper.Faces, load, everyInstanceLoad,
                paper.LoadSeconds, loaded.StorageBytes, paper.StorageBytes, cost.FractalFaceTests ?? cost.SimpleFaceTests,
                paper.FractalCost ?? paper.Faces, cost.OwnFaceTests, paper.NoteOnFigure17,
            ],
            [
                paper.Id, paper.Name, model.FaceCount, cost.SimpleFaceTests, paper.Faces, cost.FractalFaceTests, paper.FractalCost,
                cost.BoundingBoxFaceTests, paper.BoxCost, cost.OctreeDepth, cost.OwnFaceTests, cost.OwnBoundTests,
                cost.FractalWrongPercent, cost.BoundingBoxWrongPercent, paper.NoteOnFigure18,
            ]);
    }

    private static void Write(string output, string file, string[] columns, object?[][] rows)
    {
        var table = new CsvTable(Path.Combine(output, file), "paper", columns);
        foreach (var row in rows)
        {
            table.Add(row);
        }

        table.Save();
        // As text a model is a column, as in the paper.
        for (var column = 0; column < columns.Length; column++)
        {
            Console.WriteLine($"{columns[column],-24}{string.Concat(rows.Select(row => $"{FormatCell(row[column]),20}"))}");
        }

        Console.WriteLine();
    }

    private static string FormatCell(object? value) => value switch
    {
        // Too long for a column; the file has it.
        string { Length: > 20 } => "see file",
        _ => Convert.ToString(value, CultureInfo.InvariantCulture) ?? "",
    };
}
