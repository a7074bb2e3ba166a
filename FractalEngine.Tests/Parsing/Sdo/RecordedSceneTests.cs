using FractalEngine.Core;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Sdo.Merging;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;
using FractalEngine.Tests.Recorded;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Sdo;

/// <summary>Compares what the parser makes of scenes, right and faulty, with what is recorded.</summary>
[Collection(ConsoleTests.Name)]
public class RecordedSceneTests
{
    private static readonly string[] Lines =
    [
        "c (1, 2, -5) (0.1, 0.2, 0) 50", "c # # 60", "c (1 2 -5), look-at (0, 1, 0) up (0, 0, 1), 50", "c (1, 2, -5) look-at (0, 1, 0) 50",
        "o \"a.obj\" ((1, 2, 3), (10, 20, 30), (2, 2, 2)) name \"n\" colour (1, 0.5, 0) gradient level (0, 1, 0)",
        "o \"a.fdo\" # color (1, 1, 1) gradient path (0, 0, 1)",
        "o \"a.ply\", ((0, 0, 0), #, #) moving velocity (1, 0, 0) spin (0, 1, 0) from (-1, 0, 0) to (2, 0, 0) belt (0, 0, 1)",
        "o \"a.obj.gz\" # moving spin (0, 1, 0) name \"b\"",
        "p \"a.obj\" ((1, 2, 3), #, #), 0.5 name \"n\" velocity (1, 2, 3) mass 2 friction 0.5 damping 0.1 rolling 0.2 spinning 0.3 "
            + "inertia 0.4",
        "p \"a.stl\" # 0.5 shape balls 5 rotation locked shrink 0.1 0.5 collider hierarchy", "p \"a.obj\" # 1 shape capsule shrink 0.1",
        "p \"a.obj\" # 1 shrink 0.1 mass 3 collider bounding-box", "handed right", "handed left", "projection perspective",
        "projection orthographic 4", "projection orthographic", "aspect 16:9", "aspect 1.5", "clip 0.1 100", "background (0, 0.5, 1)",
        "light ambient (1, 1, 1) 0.5", "light ambient (1, 1, 1)", "light directional (0, -1, 0), (1, 1, 1), 0.5",
        "light point (0, 1, 0) (1, 1, 1) 2 30", "light spot (0, 1, 0) (0, -1, 0) 40, (1, 1, 1) 2 30", "sun (0, -1, 0) (1, 1, 1) 2 0.75",
        "light ball (0, 1, 0) 0.5, (1, 1, 1) 2 30", "light quad (0, 1, 0) (0, -1, 0) 2 1 (1, 1, 1) 2 30 45",
        "sun (0, -1, 0), (1, 1, 1), 2", "sky (0, 0, 1) (1, 1, 1) (0.5, 0.4, 0.3)", "sky (0, 0, 1), (1, 1, 1)", "exposure 2", "tone none",
        "tone filmic", "fog 0.1 (1, 1, 1)", "fog 0.1", "probe (0, 1, 2)", "gravity (0, -9, 0)", "gravity #",
        "player (0, 1, 0) 0.3 1.8 speed 4 jump 5 slope 45 step 0.4", "player (0, 1, 0), 0.3, 1.8", "# comment\n\n \tfog 1",
        "fog 1\r\nexposure 2\rtone none", "handed right\nc (1, 2, -5) look-at (0, 1, 0) 50",
    ];

    [Fact]
    public void Scenes_WithEverySmallFault_AreAsRecorded()
    {
        var sweep = new FaultSweep();
        foreach (string line in Lines)
        {
            sweep.Run(line, static text =>
            {
                var parsed = Parse(text);
                return ((parsed.Scene, parsed.FileNameOffsets, SceneWriter.Write(parsed.Scene)), parsed.Warnings);
            });
        }

        RecordedText.Check("scenes-faults.txt", sweep.Lines());
    }

    [Fact]
    public void Scenes_AtTheirLimits_AreAsRecorded()
    {
        (string Line, string[] Values)[] cases =
        [
            ("exposure {0}", ["1e-9", "9.9e-10", "1e9", "1.1e9", "0", "-1"]),
            ("light ambient (1, 1, 1) {0}", ["0", "1e9", "1.1e9", "-0.1"]),
            ("light point (0, 1, 0) (1, 1, 1) 1 {0}", ["0", "-1", "1e-300"]),
            ("light spot (0, 1, 0) (0, -1, 0) {0} (1, 1, 1) 2 30", ["0", "179.9", "180"]),
            ("light ball (0, 1, 0) {0} (1, 1, 1) 1 10", ["0", "-1", "1e-5", "9.9e-6", "1e7", "1.1e7"]),
            ("light quad (0, 1, 0) (0, -1, 0) {0} (1, 1, 1) 1 10", ["0 1", "1 0", "1e-5 1e7", "9e-6 1", "1 1.1e7"]),
            ("light directional {0} (1, 1, 1)", ["(0, 0, 0)", "(0, 0, 1e-300)"]),
            ("sun (0, -1, 0) (1, 1, 1) 2 {0}", ["0", "89.9", "90", "-1"]), ("c # # {0}", ["0", "1e-9", "179.9", "180"]),
            ("aspect {0}", ["0.01", "0.0099", "100", "100.1", "1:100", "1:101", "0", "-1", "1:0", "1:-1", "100:1", "101:1"]),
            ("clip {0}", ["1e-30 1e30", "9e-31 1", "1 1.1e30", "1 1", "0 1", "2 1", "-1 1"]), ("fog {0}", ["0", "-0.1", "1e300"]),
            ("background {0}", ["(0, 0, 0)", "(1, 1, 1)", "(1.1, 0, 0)", "(0, 0, -0.1)", "(0, 2, 0)"]),
            ("p \"a.obj\" # {0}", ["0", "1", "1.01", "-0.01", "1 mass 0", "1 mass 1e-300", "1 inertia 0", "1 inertia 0.6666666666666666",
                "1 inertia 0.67", "1 shape balls 0", "1 shape balls 1", "1 shape balls 1.5", "1 shape balls 100000", "1 shrink -1",
                "1 shrink 0", "1 shrink 1 0", "1 shrink 1 1", "1 shrink 1 1.1", "1 friction -1", "1 damping -1", "1 rolling -1",
                "1 spinning -1", "1 moving spin (0, 0, 0)", "1 belt (0, 0, 0)"]),
            ("o \"a.obj\" {0}", ["((0, 0, 0), #, (0, 1, 1))", "((0, 0, 0), #, (1, 1, 1e-300))", "((0, 0, 0), (0.5, 0.1, 0), #)", "# mass 1",
                "# velocity (1, 1, 1)", "# moving velocity (0, 0, 0) from (0, 0, 0) to (1, 0, 0)",
                "# moving velocity (1, 0, 0) from (1, 0, 0) to (2, 0, 0)",
                "# moving velocity (1, 0, 0) from (0, 0, 0) to (0, 1, 0)", "# moving velocity (1, 0, 0) from (0, 0, 0) to (0, 0, 0)"]),
            ("player (0, 1, 0) {0}", ["0 1", "1 2", "1 1.9", "0.1 100", "0.1 1000", "1 2 slope 89", "1 2 slope 89.1", "1 2 slope -1",
                "1 2 step 0", "1 2 step 2", "1 2 step 1.9", "1 2 step -0.1", "1 2 speed -1", "1 2 speed 0", "1 2 jump -1"]),
            ("c (1, 2, 3) look-at {0} 50", ["(1, 2, 3)", "(1, 2, 4) up (0, 0, 0)"]), ("c # {0} 50", ["(90, 0, 0)", "(3.2, 0, 0)",
            "(7, 0, 0)"]),
            ("projection orthographic {0}", ["0", "-1", "1e-300"]), ("{0}", ["", "#", "\n\n", "fog 1\nfog 2", "light", "sun",
            "camera # # 60", "object \"a.obj\" #",
                "physics \"a.obj\" # 1", "MESH \"a.obj\" #", "c (0, 0, -5) #", "p \"a.obj\" #", "o \"a.obj\"", "o \"a.obj\" (0, 1, 0)",
                "o \"a.obj\" 0 1 0",
                "o \"a.sdo\" #", "o \"a.txt\" #", "o \"\" #", "o a.obj #", "light point (0, 1, 0) (1, 1, 1)",
                "light spot (0, 1, 0) (0, -1, 0)",
                "exposure 1,5", "exposur 2", "fog 1 # comment", "light ambiant (1, 1, 1)", "c (0, 0, -5, 2) # 60", "c (0, 0) # 60",
                "handed up"]),
        ];
        RecordedText.Check("scenes-limits.txt", cases.SelectMany(one => one.Values.Select(value =>
            Outcome(one.Line.Replace("{0}", value, StringComparison.Ordinal)))));
    }

    [Theory]
    [InlineData(98)]
    [InlineData(99)]
    [InlineData(100)]
    [InlineData(101)]
    public void Faults_OfALongScene_AreAHundredAtMost(int count)
    {
        var faults = new List<Diagnostic>();
        string text = string.Concat(Enumerable.Range(0, count).Select(i => $"exposure x{i}\n")) + "fog 1\nlight ambient (1, 1, 1)\n";
        var scene = SceneParser.Parse(new("test.sdo", text), faults).Scene;
        const string note = " (after 100 faulty lines the rest is not read)";
        Assert.Equal(Math.Min(count, 100), faults.Count);
        Assert.Equal(Enumerable.Range(1, faults.Count), faults.Select(fault => fault.Line));
        Assert.All(faults, (fault, i) => Assert.Equal(i == 99, fault.Message.EndsWith(note, StringComparison.Ordinal)));
        Assert.Equal((count < 100 ? 1 : 0, count < 100), (scene.Lights.Length, scene.Fog is not null));
    }

    [Fact]
    public void Faults_OfALightAndAnObject_LeaveNeither()
    {
        var faults = new List<Diagnostic>();
        var scene = SceneParser.Parse(
            new("test.sdo", "o \"a.obj\" # x\nlight ambient (1, 1, 1) 1 x\no \"b.obj\" #\nlight ambient (1, 1, 0)\n"), faults).Scene;
        Assert.Equal((2, 1, 1), (faults.Count, scene.Objects.Length, scene.Lights.Length));
        Assert.Equal("b.obj", scene.Objects[0].File);
    }

    [Fact]
    public void Lines_BeyondTheLimit_AreRefused()
    {
        string[] texts = ["fog 1\n# a\n\n", "fog 1\n# a\n\nexposure 1\n", "fog 1\n# a\n\nexposure 1\n\n"];
        RecordedText.Check("scenes-lines.txt", Limited(ParsingLimits.SceneLines, 4, () => texts.Select(Outcome).ToArray()));
    }

    [Fact]
    public void Merge_OfTexts_IsAsRecorded()
    {
        string[] texts = ["", "fog 1\n", "c # # 60\nfog 1", "\uFEFFc # # 60\r\nfog 2\r\n", "\u00EF\u00BB\u00BFexposure 2\n# a\n",
            "fog 1\rfog 3\r  tone none \r"];
        var lines = from original in texts
                    from mine in texts
                    from theirs in texts
                    from preference in Enum.GetValues<MergePreference>()
                    let merged = SceneMerge.Merge(original, mine, theirs, preference)
                    group $"{merged.Text.Replace("\r", "␍", StringComparison.Ordinal)}{string.Join(';', merged.Conflicts)}" by (original,
                        mine) into results
                    select Description.Of(results.Select(result => result.Replace("\n", "⏎",
                        StringComparison.Ordinal)).Distinct().Order(StringComparer.Ordinal).ToArray());
        RecordedText.Check("scenes-merge.txt", lines.Select(line =>
            $"{line.Aggregate(17, (sum, letter) => unchecked((sum * 31) + letter)):x8} {line[..Math.Min(line.Length, 240)]}"));
    }

    [Fact]
    public void Scenes_OfTheAssets_ReadAndWriteAsRecorded()
    {
        var lines = Directory.EnumerateFiles(Repository.Full("assets/scenes"), "*.sdo").Order(StringComparer.Ordinal).Select(file =>
        {
            var parsed = SceneParser.Parse(SourceText.Read(file, file, 1 << 24));
            Assert.Equal(parsed.Source.Text, SceneWriter.Write(parsed.Scene, parsed));
            var numbers = SceneWriter.Write(parsed.Scene).Split([' ', '(', ')', ',', '\n'], StringSplitOptions.RemoveEmptyEntries)
                .Select(word => NumberReader.TryRead(word, out double value, out int length) && length == word.Length ? value : 0);
            return $"{Path.GetFileName(file)} {parsed.Lines.Length} {parsed.Scene.Objects.Length} {parsed.Scene.Lights.Length} "
                + Description.OfNumbers([.. numbers]) + Description.OfNumbers([.. parsed.FileNameOffsets.Select(offset => (double)offset)]);
        });
        RecordedText.Check("scenes-assets.txt", lines);
    }

    private static ParsedScene Parse(string text) => SceneParser.Parse(new("t.sdo", text));

    private static string Outcome(string text)
    {
        string shown = text.Replace("\n", "⏎", StringComparison.Ordinal);
        try
        {
            var parsed = Parse(text);
            string all = $"{shown} → {Description.Of(parsed.Scene)} "
                + $"{string.Join(' ', parsed.Warnings.Select(warning => warning.ToString()))}";
            return all.Replace("\n", "⏎", StringComparison.Ordinal);
        }
        catch (SourceException exception)
        {
            return $"{shown} → {(exception.Kind == ErrorKind.Limit ? "limit " : "")}{exception.Diagnostic.ToString().Split('\n')[0]}";
        }
    }

    private static T Limited<T>(Limit limit, long value, Func<T> get)
    {
        limit.Value = value;
        try
        {
            return get();
        }
        finally
        {
            limit.Value = limit.Default;
        }
    }
}
