using FractalEngine.Core.Fractals;

namespace FractalEngine.Benchmarks;

/// <summary>The words after <c>front</c>: shapes and options.</summary>
internal static class FrontCommand
{
    private const string Usage = """
        front [NAME[:NUMBER] ...] [--quick] [--output FOLDER]
          Which collider for which error? Writes front.csv, into docs/benchmarks unless stated. A number is a fractal's depth or a mesh's faces.
          --quick: smaller shapes and fewer positions.
        """;

    public static int Run(ReadOnlySpan<string> args)
    {
        var (isQuick, folder, names) = (false, Path.Combine(FractalCase.Assets, "..", "docs", "benchmarks"), new List<string>());
        for (var i = 0; i < args.Length; i++)
        {
            switch (args[i])
            {
                case "--quick":
                    isQuick = true;
                    break;
                case "--output" when i + 1 < args.Length:
                    folder = args[++i];
                    break;
                case { } name when FrontShape.IsName(name):
                    names.Add(name);
                    break;
                default:
                    Console.Error.WriteLine($"error: unexpected '{args[i]}'\n{Usage}");
                    return 2;
            }
        }

        var command = string.Join(' ', (string[])["front", .. names, .. isQuick ? ["--quick"] : Array.Empty<string>()]);
        var csv = new CsvTable(Path.Combine(folder, "front.csv"), command, FrontTable.Columns);
        var table = isQuick ? new FrontTable(400, 10, csv) : new FrontTable(1000, 20, csv);
        try
        {
            foreach (var name in names.Count > 0 ? [.. names] : isQuick ? FrontShape.Quick : FrontShape.Default)
            {
                Console.WriteLine($"front: {name}");
                table.Add(FrontShape.Create(name));
            }

            csv.Save();
            return 0;
        }
        catch (Exception exception) when (exception is FractalLimitException or InvalidDataException or IOException or UnauthorizedAccessException)
        {
            Console.Error.WriteLine($"error: {exception.Message}");
            return 1;
        }
    }
}
