namespace FractalEngine.Mutants;

/// <summary>Faults that a person wrote down, tried like mutants that were drawn.</summary>
internal static class HandFaults
{
    /// <summary>Name of their group, of which the report demands its own share.</summary>
    public const string Group = "by hand";

    /// <summary>Reads a list of faults, each as a mutant of the member around its fragment.</summary>
    /// <param name="file">A line for each: path, fragment that occurs once in that file, and its replacement, with tabs between.</param>
    /// <param name="sources">All C# files of the product by their paths.</param>
    /// <exception cref="InvalidDataException">A line is no fault: the message says why.</exception>
    public static List<Mutation> Read(string file, IReadOnlyDictionary<string, string> sources)
    {
        var faults = new List<Mutation>();
        int number = 0;
        foreach (string line in File.ReadLines(file))
        {
            number++;
            if (line.Length == 0 || line[0] == '#')
            {
                continue;
            }

            string[] parts = line.Split('\t');
            if (parts.Length < 3 || !sources.TryGetValue(parts[0], out string? source))
            {
                throw new InvalidDataException(
                    $"{file}:{number}: expected PATH, ORIGINAL, REPLACEMENT with tabs between, and a path of the product");
            }

            var site = SiteFinder.At(parts[0], source, parts[1])
                ?? throw new InvalidDataException($"{file}:{number}: expected a fragment that occurs once, in a member's body: {parts[1]}");
            string text = parts[1].Length > site.Original.Length ? parts[2].TrimEnd(';', ' ') : parts[2];
            faults.Add(new Mutation(site, new($"fault: {text}", text)) { Group = Group });
        }

        return faults;
    }
}
