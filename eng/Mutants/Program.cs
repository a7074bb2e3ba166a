using System.Diagnostics;
using System.Globalization;
using System.Runtime.InteropServices;

namespace FractalEngine.Mutants;

/// <summary>Draws mutants of the product, and reports which of them the tests notice (docs/decisions/0020-mutation-testing.md).</summary>
internal static class Program
{
    private const string MutantFile = "eng/Mutants/Injected/Mutant.cs";
    private const string RunnerFile = "eng/Mutants/Injected/MutantRunner.cs";

    // Packages that no test needs to start fast.
    private const string NotAhead = """
          <ItemGroup>
            <PublishReadyToRunExclude Include="Microsoft.CodeAnalysis.dll;Microsoft.CodeAnalysis.CSharp.dll;BenchmarkDotNet.dll;Iced.dll" />
            <PublishReadyToRunExclude Include="Microsoft.Diagnostics.Tracing.TraceEvent.dll;Microsoft.Diagnostics.Runtime.dll" />
          </ItemGroup>

        """;

    private static readonly Stopwatch Clock = Stopwatch.StartNew();

    private static int Main(string[] arguments)
    {
        SelfCheck.Run();
        if (arguments is ["--check"])
        {
            return 0;
        }

        Options options;
        try
        {
            options = Options.Parse(arguments);
        }
        catch (ArgumentException exception)
        {
            Console.Error.WriteLine($"error: {exception.Message}\n{Options.Usage}");
            return 2;
        }

        // Children inherit it: nothing here is as urgent as what else the machine does.
        using (var self = Process.GetCurrentProcess())
        {
            self.PriorityClass = ProcessPriorityClass.BelowNormal;
        }

        using var interrupt = PosixSignalRegistration.Create(PosixSignal.SIGINT, Stop);
        using var terminate = PosixSignalRegistration.Create(PosixSignal.SIGTERM, Stop);
        try
        {
            return Run(options);
        }
        catch (InvalidDataException exception)
        {
            Console.Error.WriteLine($"error: {exception.Message}");
            return 2;
        }
        finally
        {
            TestProcess.EndAll();
        }
    }

    private static void Stop(PosixSignalContext context)
    {
        TestProcess.EndAll();
        Environment.Exit(130);
    }

    private static int Run(Options options)
    {
        var workspace = new Workspace(options.Root);
        using var single = new FileStream(Path.Combine(workspace.Folder, "lock"), FileMode.OpenOrCreate, FileAccess.Write, FileShare.None);
        var (mutations, state, tree) = Prepare(options, workspace);
        if (!TestProcess.StartDisplays(options.Workers))
        {
            Say("no Xvfb: tests that draw are skipped, and notice nothing");
        }

        var recording = Record(options, workspace, mutations, state, tree);
        foreach (var (test, failure) in recording.LeftOut)
        {
            Say($"left out, since it fails without a mutant: {test}: {failure}");
        }

        var verdicts = Try(options, mutations, state, tree, recording);
        string title = options.Only.Count > 0
            ? $"mutants {string.Join(", ", options.Only)}"
            : $"{mutations.Count} mutants of {options.In ?? "five groups"}, seed {options.Seed}";
        var report = Report.Make(title, mutations, verdicts, Equivalents(workspace), workspace.Sources, options.AllowChance);
        Console.Write(report.Text);
        string file = options.Report ?? Path.Combine(state, "report.txt");
        File.WriteAllText(file, report.Text);
        Say($"took {Clock.Elapsed.TotalMinutes:0.0} minutes; the report is in {file}");
        return report.IsPassed ? 0 : 1;
    }

    // Draws, copies and builds; only what an earlier run of the same draw on the same sources didn't do.
    private static (List<Mutation> Mutations, string State, string Tree) Prepare(Options options, Workspace workspace)
    {
        string what = options.Only.Count > 0
            ? $"only {string.Join(',', options.Only)}"
            : string.Create(CultureInfo.InvariantCulture, $"{options.Sample} {options.Seed} {options.In}");
        var faults = options.Faults is null ? [] : HandFaults.Read(options.Faults, workspace.Sources);
        what += options.Faults is null ? "" : $" {Hashing.Hex(File.ReadAllText(options.Faults), 16)}";
        string tree = Path.Combine(workspace.Folder, options.Only.Count > 0 ? "only" : "tree");
        string state = Path.Combine(workspace.Folder, "states", Hashing.Hex($"{what}|{workspace.TestedHash}", 16));
        if (options.Fresh && Directory.Exists(state))
        {
            Directory.Delete(state, true);
        }

        Directory.CreateDirectory(state);
        var sites = workspace.Sources.AsParallel().SelectMany(file => SiteFinder.Find(file.Key, file.Value)).ToList();
        sites.Sort((a, b) => (string.CompareOrdinal(a.Path, b.Path), a.Span.Start).CompareTo((0, b.Span.Start)));
        Say($"{sites.Count} places with {sites.Sum(site => site.Changes.Count)} mutants in the product");
        string drawn = Path.Combine(state, "drawn.tsv");
        List<Mutation> mutations;
        if (File.Exists(drawn))
        {
            mutations = ReadDrawn(drawn, sites, faults);
        }
        else
        {
            workspace.Copy(tree, new Dictionary<string, string>());
            TestProcess.Dotnet(tree, "restore", "FractalEngine.Tests", "-v", "quiet", "-nodeReuse:false");
            mutations = DrawMutations(options, workspace, sites, faults, tree);
            File.WriteAllLines(drawn, mutations.Select(one => $"{one.Id}\t{one.Form}\t{one.Group}"));
        }

        Build(workspace, mutations, tree, $"{state}|{workspace.Hash}");
        return (mutations, state, tree);
    }

    private static List<Mutation> DrawMutations(
        Options options, Workspace workspace, List<Site> sites, List<Mutation> faults, string tree)
    {
        Draw draw;
        if (options.Only.Count > 0)
        {
            var wanted = options.Only.ToHashSet();
            draw = new Draw(sites.SelectMany(site => site.Changes.Select(change => new Mutation(site, change)))
                .Where(mutation => wanted.Contains(mutation.Id)));
            var missing = wanted.Except(draw.Drawn.Select(mutation => mutation.Id)).ToList();
            if (missing.Count > 0)
            {
                throw new InvalidDataException($"no mutant is called {string.Join(", ", missing)}: its place has changed, or is gone");
            }
        }
        else
        {
            draw = new Draw(sites, options.In is null ? Group.All : [Group.Of(options.In)], options.Sample, options.Seed);
        }

        draw.Add(faults);
        int replaced = new Checker(workspace.Sources, workspace.Text(MutantFile), tree).Settle(draw);
        Say($"drew {draw.Drawn.Count} mutants; {replaced} that don't compile were replaced");
        foreach (var fault in faults.Except(draw.Drawn))
        {
            Say($"doesn't compile, and is left out: {fault.Site.Path}: {fault.Site.OneLine} -> {fault.Change.Text}");
        }

        var mutations = draw.Drawn.OrderBy(one => one.Site.Path, StringComparer.Ordinal).ThenBy(one => one.Site.Span.Start)
            .ThenBy(one => one.Id, StringComparer.Ordinal).ToList();
        for (int i = 0; i < mutations.Count; i++)
        {
            mutations[i].Number = i;
        }

        return mutations;
    }

    private static List<Mutation> ReadDrawn(string file, List<Site> sites, List<Mutation> faults)
    {
        var byId = sites.SelectMany(site => site.Changes.Select(change => new Mutation(site, change))).Concat(faults)
            .DistinctBy(one => one.Id).ToDictionary(one => one.Id);
        var mutations = new List<Mutation>();
        foreach (string[] parts in File.ReadLines(file).Select(line => line.Split('\t')))
        {
            var mutation = byId[parts[0]];
            mutation.Form = Enum.Parse<Form>(parts[1]);
            mutation.Group = parts[2];
            mutation.Number = mutations.Count;
            mutations.Add(mutation);
        }

        return mutations;
    }

    private static void Build(Workspace workspace, List<Mutation> mutations, string tree, string stamp)
    {
        string stampFile = tree + ".stamp";
        if (File.Exists(stampFile) && File.ReadAllText(stampFile) == stamp)
        {
            return;
        }

        File.Delete(stampFile);
        var instrumented = mutations.GroupBy(one => one.Site.Path)
            .ToDictionary(file => file.Key, file => Instrumenter.Write(workspace.Sources[file.Key], file).Text);
        foreach (string project in (string[])["Core", "Parsing", "Render", "App"])
        {
            instrumented[$"FractalEngine.{project}/Mutant.cs"] = workspace.Text(MutantFile);
        }

        instrumented["FractalEngine.Tests/MutantRunner.cs"] = workspace.Text(RunnerFile);
        instrumented["Directory.Build.targets"] = workspace.Text("Directory.Build.targets").Replace("</Project>", NotAhead + "</Project>");
        workspace.Copy(tree, instrumented);
        string[] command =
        [
            "publish", "FractalEngine.Tests", "-c", "Release", "-v", "quiet", "-nodeReuse:false", "--disable-build-servers",
            "-o", Path.Combine(tree, "FractalEngine.Tests/bin/ready"), "--use-current-runtime", "--no-self-contained",
            "-p:TreatWarningsAsErrors=false", "-p:RunAnalyzers=false", "-p:EnforceCodeStyleInBuild=false", "-p:AllowUnsafeBlocks=true",
            "-p:GenerateProgramFile=false", "-p:NoWarn=CS0436%3BCS1591%3BCS0162%3BCS8602%3BCS8603%3BCS8604",
        ];
        // Compiled ahead, since a process for each mutant, and for each command in it, would mostly wait for the compiler otherwise.
        // The package for that can't be had everywhere.
        if (!TestProcess.TryDotnet(
            tree, out _, [.. command, "-p:PublishReadyToRun=true",
                "-p:PublishReadyToRunCrossgen2ExtraArgs=--opt-cross-module:*%3B--non-local-generics-module:*"]))
        {
            TestProcess.Dotnet(tree, command);
        }

        File.WriteAllText(stampFile, stamp);
        Say("built the copy");
    }

    private static Recording Record(Options options, Workspace workspace, List<Mutation> mutations, string state, string tree)
    {
        string folder = Path.Combine(state, "recording");
        var store = new ReachStore(workspace.Common);
        if (options.Only.Count > 0 && mutations.TrueForAll(store.Knows))
        {
            return store.Read(mutations, ListTests(tree, state));
        }

        if (!File.Exists(Path.Combine(folder, "done")))
        {
            Recording.Make(tree, folder, mutations.Count, options.Workers);
            store.Write(mutations, Recording.Read(folder, mutations));
            Say("recorded which tests reach which mutants");
        }

        return Recording.Read(folder, mutations);
    }

    private static List<Test> ListTests(string tree, string state)
    {
        string folder = Path.Combine(state, "list");
        Directory.CreateDirectory(folder);
        string result = Path.Combine(folder, "tests");
        using var process = TestProcess.Start(tree, folder, 0, new Dictionary<string, string>(), "list", result);
        process.Wait();
        return [.. File.ReadLines(result).Select(line => line.Split('\t')).Select(parts => new Test(parts[0], parts[1], 0))];
    }

    private static Dictionary<string, Verdict> Try(
        Options options, List<Mutation> mutations, string state, string tree, Recording recording)
    {
        string file = Path.Combine(state, "verdicts.tsv");
        var verdicts = options.Only.Count == 0 && File.Exists(file)
            ? File.ReadLines(file).Select(Verdict.Read).ToDictionary(verdict => verdict.Id)
            : [];
        var left = new Queue<Mutation>(mutations.Where(mutation => !verdicts.ContainsKey(mutation.Id)));
        var workers = Enumerable.Range(0, options.Workers).Select(worker => Task.Factory.StartNew(
            () =>
            {
                string folder = Path.Combine(state, string.Create(CultureInfo.InvariantCulture, $"worker-{worker}"));
                while (true)
                {
                    Mutation mutation;
                    lock (left)
                    {
                        if (!left.TryDequeue(out mutation!))
                        {
                            return;
                        }
                    }

                    var tests = recording.Reaching(mutation);
                    var watch = Stopwatch.StartNew();
                    var verdict = Trial.Run(tree, folder, worker, mutation, tests, options.Cap);
                    lock (left)
                    {
                        verdicts[mutation.Id] = verdict;
                        File.AppendAllText(file, verdict + "\n");
                        Say($"{verdicts.Count}/{mutations.Count} {watch.Elapsed.TotalSeconds:0.0} s {mutation.Site.Path}: {verdict}");
                    }
                }
            },
            CancellationToken.None, TaskCreationOptions.LongRunning, TaskScheduler.Default)).ToArray();
        Task.WaitAll(workers);
        return verdicts;
    }

    private static Dictionary<string, string> Equivalents(Workspace workspace) =>
        workspace.Text("eng/Mutants/equivalent.tsv").Split('\n').Where(line => line.Length > 0 && line[0] != '#')
            .Select(line => line.Split('\t', 2)).ToDictionary(parts => parts[0], parts => parts[1]);

    private static void Say(FormattableString text) => Say(text.ToString(CultureInfo.InvariantCulture));

    private static void Say(string text) => Console.Error.WriteLine($"[{Clock.Elapsed:h\\:mm\\:ss}] {text}");
}
