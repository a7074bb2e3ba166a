namespace FractalEngine.Mutants;

/// <summary>Checks the draw on a tiny source. Runs at each start: a wrong draw makes all that follows worthless.</summary>
internal static class SelfCheck
{
    private const string Source = """
        namespace Sample;
        [System.Obsolete("not a site")]
        class Counter
        {
            const int Limit = 3;
            int _count = 1;
            int Next(int step, int other = 7)
            {
                if (step > 0 && _count != Limit)
                {
                    _count += step;
                }
                return _count is 5 ? -step : Math.Max(step, other);
            }
            void Reset() => Apply(_count, 2.5);
            void Apply(int a, double b) { }
        }
        """;

    /// <summary>Runs all checks of the tool.</summary>
    /// <exception cref="InvalidOperationException">One fails.</exception>
    public static void Run()
    {
        var sites = SiteFinder.Find("FractalEngine.Parsing/Counter.cs", Source);
        var found = sites.SelectMany(site => site.Changes.Select(change => $"{site.Original} | {change.Operator} | {change.Text}"));
        string[] expected =
        [
            "1 | 1 to 0 | 0",
            "1 | number + 1 | 2",
            "step > 0 && _count != Limit | && to || | step > 0 || _count != Limit",
            "step > 0 && _count != Limit | negated | !(step > 0 && _count != Limit)",
            "step > 0 | > to >= | step >= 0",
            "step > 0 | > to <= | step <= 0",
            "0 | 0 to 1 | 1",
            "_count != Limit | != to == | _count == Limit",
            "_count += step; | statement removed | ;",
            "_count += step; | += to -= | _count -= step;",
            "_count is 5 ? -step : Math.Max(step, other) | ?: swapped | _count is 5 ? Math.Max(step, other) : -step",
            "_count is 5 ? -step : Math.Max(step, other) | negated | !(_count is 5 ? -step : Math.Max(step, other))",
            "_count is 5 ? -step : Math.Max(step, other) | default returned | default",
            "_count is 5 | negated | !(_count is 5)",
            "-step | - dropped | step",
            "Math.Max(step, other) | Max to Min | Math.Min(step, other)",
            "Apply(_count, 2.5) | arguments 1 and 2 swapped | Apply(2.5, _count)",
            "Apply(_count, 2.5) | statement removed | ",
            "2.5 | number + 1 | (2.5 + 1)",
            "2.5 | number doubled | (2 * 2.5)",
        ];
        Expect(string.Join('\n', expected), string.Join('\n', found));

        string DrawOf(string seed, string source) => string.Join(' ', new Draw(
            SiteFinder.Find("FractalEngine.Parsing/Counter.cs", source), Group.All, 20, seed).Drawn.Select(one => one.Id).Order());
        Expect(DrawOf("1", Source), DrawOf("1", Source));
        Expect(DrawOf("1", Source), DrawOf("1", "// A line more.\n" + Source));
        Expect("True", (DrawOf("1", Source) != DrawOf("2", Source)).ToString());
        var all = new Draw(sites, Group.All, 1000, "1").Drawn;
        Expect(sites.Count.ToString(), all.Select(one => one.Site).Distinct().Count().ToString());
        Expect(all.Count.ToString(), sites.Count.ToString());

        CheckFaultsByHand();
        var form = new Mutation(sites.Find(site => site.Original == "-step")!, new("- dropped", "step")) { Number = 7 };
        string text = Instrumenter.Write(Source, [form]).Text;
        ExpectPart("(global::FractalEngineMutants.Mutant.Is(7) ? (step) : (-step))", text);
        form.Form = Form.Body;
        text = Instrumenter.Write(Source, [form]).Text;
        ExpectPart("{ if (global::FractalEngineMutants.Mutant.Is(7)) {", text);
    }

    private static void CheckFaultsByHand()
    {
        const string Path = "FractalEngine.Parsing/Counter.cs";
        string file = System.IO.Path.GetTempFileName();
        try
        {
            File.WriteAllText(file, $"{Path}\t_count += step;\t\n{Path}\tApply(_count, 2.5);\tApply(_count, 2);\tRounded.\n");
            var faults = HandFaults.Read(file, new Dictionary<string, string> { [Path] = Source });
            faults[1].Number = 1;
            string text = Instrumenter.Write(Source, faults).Text;
            ExpectPart("Mutant.Is(1)) { Apply(_count, 2); } else { Apply(_count, 2.5); } }", text);
            Expect("True", (SiteFinder.At(Path, Source, "int _count") is null).ToString());
            Expect("True", (SiteFinder.At(Path, Source, "step") is null).ToString());
        }
        finally
        {
            File.Delete(file);
        }
    }

    private static void ExpectPart(string part, string text) => Expect(part, text.Contains(part, StringComparison.Ordinal) ? part : text);

    private static void Expect(string expected, string found)
    {
        if (expected != found)
        {
            throw new InvalidOperationException($"the mutation tool is wrong: expected\n{expected}\nand found\n{found}");
        }
    }
}
