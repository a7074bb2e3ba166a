using System.Globalization;

namespace FractalEngine.Mutants;

/// <summary>What became of a mutant.</summary>
/// <param name="Id">The mutant.</param>
/// <param name="Outcome">One of `noticed`, `survived`, `not reached`.</param>
/// <param name="Tests">Number of tests that reach it.</param>
/// <param name="Note">The test that noticed it and how, or why not all tests ran.</param>
internal sealed record Verdict(string Id, string Outcome, int Tests, string Note)
{
    /// <summary>Writes a line that <see cref="Read"/> reads.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"{Id}\t{Outcome}\t{Tests}\t{Note}");

    /// <summary>Reads a line of verdicts.</summary>
    public static Verdict Read(string line)
    {
        string[] parts = line.Split('\t', 4);
        return new(parts[0], parts[1], int.Parse(parts[2], CultureInfo.InvariantCulture), parts[3]);
    }
}

/// <summary>Runs the tests of one mutant in a process of its own, until one fails.</summary>
internal static class Trial
{
    // A process under test is cold, and the machine busy: what a test takes anyway, before ten times its own time counts.
    private const double StartMilliseconds = 20_000;

    /// <summary>Tests one mutant to its verdict.</summary>
    /// <param name="tree">The copy.</param>
    /// <param name="folder">Folder for what the process writes; made anew.</param>
    /// <param name="worker">Number of the worker.</param>
    /// <param name="mutation">The mutant.</param>
    /// <param name="reaching">The tests that reach it.</param>
    /// <param name="capSeconds">Seconds of recorded time that it gets.</param>
    public static Verdict Run(string tree, string folder, int worker, Mutation mutation, IReadOnlyList<Test> reaching, double capSeconds)
    {
        if (reaching.Count == 0)
        {
            return new(mutation.Id, "not reached", 0, "");
        }

        var tests = Order(mutation, reaching);
        double sum = 0;
        int count = tests.TakeWhile(test => (sum += test.Milliseconds) <= capSeconds * 1000).Count();
        tests = tests[..Math.Max(1, count)];
        var left = tests;
        while (left.Count > 0)
        {
            string outcome = RunTests(tree, folder, worker, mutation, left);
            if (outcome == "survived")
            {
                break;
            }

            // A test that fails by chance, on a busy machine, doesn't fail again.
            int failed = left.FindIndex(test => test.Name == outcome.Split('\t')[1]);
            if (failed < 0 || !outcome.StartsWith("failed", StringComparison.Ordinal)
                || RunTests(tree, folder, worker, mutation, [left[failed]]) != "survived")
            {
                return new(mutation.Id, "noticed", reaching.Count, outcome);
            }

            left = left[(failed + 1)..];
        }

        return new(mutation.Id, "survived", reaching.Count, tests.Count < reaching.Count ? $"tests not exhausted: {tests.Count} ran" : "");
    }

    private static string RunTests(string tree, string folder, int worker, Mutation mutation, IReadOnlyList<Test> tests)
    {
        if (Directory.Exists(folder))
        {
            Directory.Delete(folder, true);
        }

        Directory.CreateDirectory(folder);
        string result = Path.Combine(folder, "result");
        string list = Path.Combine(folder, "list");
        File.WriteAllLines(list, tests.Select(test => string.Create(
            CultureInfo.InvariantCulture, $"{test.Class}\t{test.Method}\t{StartMilliseconds + 10 * test.Milliseconds}")));
        var environment = new Dictionary<string, string> { ["MUTANT"] = mutation.Number.ToString(CultureInfo.InvariantCulture) };
        using (var process = TestProcess.Start(tree, folder, worker, environment, "run", result, list))
        {
            process.Wait();
        }

        string current = File.Exists(result + ".current") ? File.ReadAllText(result + ".current") : "start";
        return File.Exists(result) ? File.ReadAllText(result).Trim() : $"crash\t{current}\t";
    }

    // First what is named after the file, then what is near it and what compares with records, each time the fast ones first.
    private static List<Test> Order(Mutation mutation, IReadOnlyList<Test> reaching)
    {
        string name = Path.GetFileNameWithoutExtension(mutation.Site.Path);
        string near = Recording.NamespaceOf(mutation.Site.Path);
        bool IsNear(Test test) =>
            test.Class.StartsWith(near, StringComparison.Ordinal) || test.Class.Contains("Record", StringComparison.Ordinal);
        double Weight(Test test) => (test.Milliseconds + 20)
            * (test.Class[(test.Class.LastIndexOf('.') + 1)..].StartsWith(name, StringComparison.Ordinal) ? 0.02 : IsNear(test) ? 0.2 : 1);
        return [.. reaching.OrderBy(Weight).ThenBy(test => test.Name, StringComparer.Ordinal)];
    }
}
