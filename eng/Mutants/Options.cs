using System.Globalization;

namespace FractalEngine.Mutants;

/// <summary>What the command line asks for.</summary>
/// <param name="Root">The checkout.</param>
/// <param name="Sample">Number of mutants to draw.</param>
/// <param name="Seed">Seed of the draw.</param>
/// <param name="In">Folder to draw all mutants from, relative to the checkout; null for the five groups.</param>
/// <param name="Only">Mutants to test, in place of a draw.</param>
/// <param name="Faults">A list of faults to test beside the draw, or null.</param>
/// <param name="Report">A further file for the report, or null.</param>
/// <param name="Workers">Number of mutants that are tested at the same time.</param>
/// <param name="Cap">Seconds of tests, as recorded, that one mutant gets.</param>
/// <param name="AllowChance">Whether a share that may be due to the small sample passes.</param>
/// <param name="Fresh">Whether results of earlier runs are thrown away.</param>
internal sealed record Options(
    string Root, int Sample, string Seed, string? In, IReadOnlyList<string> Only, string? Faults, string? Report, int Workers, double Cap,
    bool AllowChance, bool Fresh)
{
    /// <summary>What is printed with a wrong command line.</summary>
    public const string Usage = """
        usage: ./test.sh mutants [--sample N] [--seed S] [--in FOLDER] [--only ID[,ID]] [--faults FILE]
               [--report FILE] [--workers N] [--cap SECONDS] [--allow-chance] [--fresh]
        """;

    /// <summary>Reads the command line.</summary>
    /// <exception cref="ArgumentException">An option is unknown, or its value can't be used.</exception>
    public static Options Parse(string[] arguments)
    {
        var options = new Options(FindRoot(), 500, "1", null, [], null, null, 2, 120, false, false);
        for (int i = 0; i < arguments.Length; i++)
        {
            string name = arguments[i];
            string Value() => ++i < arguments.Length ? arguments[i] : throw new ArgumentException($"{name} needs a value");
            options = name switch
            {
                "--sample" => options with { Sample = Number(name, Value()) },
                "--seed" => options with { Seed = Value() },
                "--in" => options with { In = Value().Trim('/') },
                "--only" => options with { Only = Value().Split(',', StringSplitOptions.RemoveEmptyEntries) },
                // No draw but where one is asked for as well.
                "--faults" => options with
                {
                    Faults = Path.GetFullPath(Value()),
                    Sample = arguments.Contains("--sample") ? options.Sample : 0,
                },
                "--report" => options with { Report = Path.GetFullPath(Value()) },
                "--workers" => options with { Workers = Number(name, Value()) },
                "--cap" => options with { Cap = Number(name, Value()) },
                "--allow-chance" => options with { AllowChance = true },
                "--fresh" => options with { Fresh = true },
                _ => throw new ArgumentException($"unknown option {name}"),
            };
        }

        return options;
    }

    private static int Number(string name, string text) =>
        int.TryParse(text, NumberStyles.None, CultureInfo.InvariantCulture, out int number) && number > 0
            ? number
            : throw new ArgumentException($"{name} needs a positive whole number, not '{text}'");

    private static string FindRoot()
    {
        foreach (string start in (string[])[AppContext.BaseDirectory, Environment.CurrentDirectory])
        {
            for (var folder = new DirectoryInfo(start); folder is not null; folder = folder.Parent)
            {
                if (File.Exists(Path.Combine(folder.FullName, "FractalEngine.sln")))
                {
                    return folder.FullName;
                }
            }
        }

        throw new ArgumentException("expected FractalEngine.sln in a folder above the tool, or above the working directory");
    }
}
