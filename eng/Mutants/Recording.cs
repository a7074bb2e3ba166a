using System.Globalization;

namespace FractalEngine.Mutants;

/// <summary>A test method with all its cases.</summary>
/// <param name="Class">Full name of its class.</param>
/// <param name="Method">Its name.</param>
/// <param name="Milliseconds">Time that it took when it was recorded.</param>
internal sealed record Test(string Class, string Method, double Milliseconds)
{
    /// <summary>Names the class and the method.</summary>
    public string Name => $"{Class}.{Method}";
}

/// <summary>Which tests reach which mutants, and how long they take.</summary>
/// <remarks>
/// What a class reaches outside its tests (its fixtures, or when it is loaded) counts for all its tests. A mutant that was reached while a
/// static value was computed, once for all tests that follow, counts as reached by all tests of the namespace of its folder as well.
/// </remarks>
internal sealed class Recording
{
    private readonly Dictionary<string, HashSet<string>> _reached = [];

    /// <summary>All tests by their names.</summary>
    public Dictionary<string, Test> Tests { get; } = [];

    /// <summary>Tests that fail without any mutant, with what they say.</summary>
    public Dictionary<string, string> LeftOut { get; } = [];

    /// <summary>Runs all tests in a few processes, and writes what they reach.</summary>
    /// <param name="tree">The copy, built.</param>
    /// <param name="folder">Where to write.</param>
    /// <param name="count">Number of mutants.</param>
    /// <param name="workers">Number of processes.</param>
    public static void Make(string tree, string folder, int count, int workers)
    {
        if (Directory.Exists(folder))
        {
            Directory.Delete(folder, true);
        }

        string claims = Path.Combine(folder, "claims");
        Directory.CreateDirectory(claims);
        var threads = Enumerable.Range(0, workers).Select(worker =>
        {
            string own = Path.Combine(folder, worker.ToString(CultureInfo.InvariantCulture));
            Directory.CreateDirectory(own);
            string flags = Path.Combine(own, "flags");
            File.WriteAllBytes(flags, new byte[Math.Max(1, count) * 3]);
            return Task.Run(() =>
            {
                var environment = new Dictionary<string, string> { ["MUTANT_FLAGS"] = flags };
                using var process = TestProcess.Start(
                    tree, own, worker, environment, "record", Path.Combine(own, "tests"), claims, flags);
                if (process.Wait() != 0)
                {
                    throw new InvalidOperationException($"the tests crash without any mutant: see {own}/log");
                }
            });
        }).ToArray();
        Task.WaitAll(threads);
        Confirm(tree, folder, workers);
        File.WriteAllText(Path.Combine(folder, "done"), "");
    }

    /// <summary>Reads what was recorded.</summary>
    /// <param name="folder">Where it was written.</param>
    /// <param name="mutations">The mutants in the order of their numbers.</param>
    public static Recording Read(string folder, IReadOnlyList<Mutation> mutations)
    {
        var recording = new Recording();
        var inStatic = new HashSet<int>();
        foreach (string own in Directory.EnumerateDirectories(folder).Where(own => File.Exists(Path.Combine(own, "tests"))))
        {
            recording.ReadTests(Path.Combine(own, "tests"), mutations);
            byte[] flags = File.ReadAllBytes(Path.Combine(own, "flags"));
            inStatic.UnionWith(Enumerable.Range(0, mutations.Count).Where(id => flags[2 * (flags.Length / 3) + id] != 0));
        }

        foreach (string line in File.ReadLines(Path.Combine(folder, "left-out")))
        {
            string[] parts = line.Split('\t', 2);
            recording.LeftOut[parts[0]] = parts[1];
        }

        foreach (var mutation in inStatic.Select(id => mutations[id]))
        {
            string near = NamespaceOf(mutation.Site.Path);
            recording.Reached(mutation.Id).UnionWith(
                recording.Tests.Values.Where(test => test.Class.StartsWith(near, StringComparison.Ordinal)).Select(test => test.Name));
        }

        return recording;
    }

    /// <summary>Names of the tests that reach a mutant.</summary>
    public HashSet<string> Reached(string id) => _reached.TryGetValue(id, out var tests) ? tests : _reached[id] = [];

    /// <summary>The tests that are to be run on a mutant.</summary>
    public List<Test> Reaching(Mutation mutation)
    {
        var names = Reached(mutation.Id).Where(test => Tests.ContainsKey(test) && !LeftOut.ContainsKey(test));
        return [.. names.Select(test => Tests[test])];
    }

    /// <summary>The namespace of the tests of a file.</summary>
    public static string NamespaceOf(string path)
    {
        string folder = Path.GetDirectoryName(path)!;
        string tests = folder.StartsWith("FractalEngine.Core", StringComparison.Ordinal) ? folder["FractalEngine.Core".Length..]
            : folder["FractalEngine".Length..].Replace('.', '/');
        return "FractalEngine.Tests." + tests.Trim('/').Replace('/', '.');
    }

    private void ReadTests(string file, IReadOnlyList<Mutation> mutations)
    {
        foreach (string[] parts in File.ReadLines(file).Select(line => line.Split('\t')))
        {
            var ids = parts[5].Split(',', StringSplitOptions.RemoveEmptyEntries).Select(id => int.Parse(id, CultureInfo.InvariantCulture));
            if (parts[0] == "test")
            {
                var test = new Test(parts[1], parts[2], double.Parse(parts[3], CultureInfo.InvariantCulture));
                // Overloads are one test.
                double before = Tests.TryGetValue(test.Name, out var other) ? other.Milliseconds : 0;
                Tests[test.Name] = test with { Milliseconds = test.Milliseconds + before };
                foreach (int id in ids)
                {
                    Reached(mutations[id].Id).Add(test.Name);
                }
            }
            else
            {
                foreach (int id in ids)
                {
                    Reached(mutations[id].Id).UnionWith(Tests.Values.Where(test => test.Class == parts[1]).Select(test => test.Name));
                }
            }
        }
    }

    // A test that fails while it is recorded, and then once more without, is of no use against mutants.
    private static void Confirm(string tree, string folder, int workers)
    {
        var failed = Directory.EnumerateDirectories(folder).Where(own => File.Exists(Path.Combine(own, "tests")))
            .SelectMany(own => File.ReadLines(Path.Combine(own, "tests"))).Select(line => line.Split('\t'))
            .Where(parts => parts[4].StartsWith("failed", StringComparison.Ordinal)).ToList();
        var leftOut = new SortedDictionary<string, string>(StringComparer.Ordinal);
        Parallel.ForEach(Enumerable.Range(0, workers), worker =>
        {
            for (int i = worker; i < failed.Count; i += workers)
            {
                string own = Path.Combine(folder, string.Create(CultureInfo.InvariantCulture, $"failed-{i}"));
                Directory.CreateDirectory(own);
                string result = Path.Combine(own, "result");
                string list = Path.Combine(own, "list");
                File.WriteAllText(list, $"{failed[i][1]}\t{failed[i][2]}\t600000\n");
                using var process = TestProcess.Start(tree, own, worker, new Dictionary<string, string>(), "run", result, list);
                process.Wait();
                if (!File.Exists(result) || File.ReadAllText(result).Trim() != "survived")
                {
                    lock (leftOut)
                    {
                        leftOut[$"{failed[i][1]}.{failed[i][2]}"] = failed[i][4];
                    }
                }
            }
        });
        File.WriteAllLines(Path.Combine(folder, "left-out"), leftOut.Select(test => $"{test.Key}\t{test.Value}"));
    }
}
