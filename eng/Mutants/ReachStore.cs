using System.Globalization;

namespace FractalEngine.Mutants;

/// <summary>
/// Keeps which tests reach a mutant beyond the run that recorded it, for all checkouts of the user. So a mutant can be tried again at
/// once after a test was added: by the tests that reached it, and those that did not exist.
/// </summary>
internal sealed class ReachStore
{
    private readonly string _folder;

    /// <summary>Opens the store, or makes it.</summary>
    public ReachStore(string common)
    {
        _folder = Path.Combine(common, "reached");
        Directory.CreateDirectory(_folder);
    }

    /// <summary>Tells whether a mutant was recorded.</summary>
    public bool Knows(Mutation mutation) => File.Exists(PathOf(mutation.Id));

    /// <summary>Keeps what a recording found.</summary>
    public void Write(IEnumerable<Mutation> mutations, Recording recording)
    {
        string[] all = [.. recording.Tests.Values.OrderBy(test => test.Name, StringComparer.Ordinal).Select(test => string.Create(
            CultureInfo.InvariantCulture,
            $"{test.Class}\t{test.Method}\t{test.Milliseconds}\t{recording.LeftOut.GetValueOrDefault(test.Name)}"))];
        string name = "tests-" + Hashing.Hex(string.Join('\n', all), 16);
        File.WriteAllLines(PathOf(name), all);
        foreach (var mutation in mutations)
        {
            File.WriteAllLines(PathOf(mutation.Id), [name, .. recording.Reached(mutation.Id).Order(StringComparer.Ordinal)]);
        }
    }

    /// <summary>Reads what is known of some mutants; tests that weren't known then count as reaching each.</summary>
    /// <param name="mutations">The mutants.</param>
    /// <param name="tests">All tests that exist now.</param>
    public Recording Read(IEnumerable<Mutation> mutations, IReadOnlyList<Test> tests)
    {
        var recording = new Recording();
        foreach (var test in tests)
        {
            recording.Tests[test.Name] = test;
        }

        foreach (var mutation in mutations)
        {
            string[] lines = File.ReadAllLines(PathOf(mutation.Id));
            var known = new HashSet<string>();
            foreach (string[] parts in File.ReadLines(PathOf(lines[0])).Select(line => line.Split('\t', 4)))
            {
                var test = new Test(parts[0], parts[1], double.Parse(parts[2], CultureInfo.InvariantCulture));
                known.Add(test.Name);
                if (recording.Tests.ContainsKey(test.Name))
                {
                    recording.Tests[test.Name] = test;
                }

                if (parts[3].Length > 0)
                {
                    recording.LeftOut[test.Name] = parts[3];
                }
            }

            recording.Reached(mutation.Id).UnionWith(lines.Skip(1));
            recording.Reached(mutation.Id).UnionWith(tests.Select(test => test.Name).Where(test => !known.Contains(test)));
        }

        return recording;
    }

    private string PathOf(string name) => Path.Combine(_folder, name);
}
