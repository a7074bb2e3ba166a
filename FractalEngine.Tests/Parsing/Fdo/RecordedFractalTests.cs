using FractalEngine.Core;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Fdo.Writing;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Recorded;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Fdo;

/// <summary>Compares what the parser makes of fractals, right and faulty, with what is recorded.</summary>
[Collection(ConsoleTests.Name)]
public class RecordedFractalTests
{
    private const string Small = "v 1 2 3\nv .5 .5 .5\nt.a.b. (a, #, b)\nu. (1, 2, #)\nx. \"b.obj\"\ny. [t.1.2, #] x\nz<x>. [u., #] "
        + "y\n<$>. [t.2.2] z 3\n";

    private static readonly string[] Texts =
    [
        Small, "composition componentwise\nv 1 1 1\nt.a.b.c. (c, b, a)\nx. \"b.ply\"\nz<x>. [t.1.1.1] x\nw<x>. z 2\n<$>. w 3\n",
        "<$>. \"a.obj\"", "v 0.5, 0.5, 0.5\nt.a. (#, #, a)\nx. \"b.stl\"\nz<x>. [t.1] x\n<$>. z\n",
        "composition affine\n# c\n\nx. \"a.obj.gz\"\nmy-y. [] x\n<$>. my-y",
        "k0 = 2\nk = (1 + sin(30))^2/max(k0, 3) from 0 to 9 // c\nup = (0, k, -1)\nm.matrix (1) up (0, 0, 2) (k)\n"
            + "t.p.n. (p, (n*2), (0.5))\nz<box>. [t.up.(3)^-1..2 * m., #] box\n<$>. z (2*k0)\n",
    ];

    [Fact]
    public void Fractals_WithEverySmallFault_AreAsRecorded()
    {
        var sweep = new FaultSweep();
        foreach (string line in Texts)
        {
            sweep.Run(line, static text =>
            {
                var parsed = FractalParser.Parse(new("t.fdo", text));
                string written = parsed.Description.IsInfinite ? "" : Write(parsed);
                return ((parsed.BaseFile, parsed.Bases[0].Offset, parsed.ResultOffset, written, FractalNumber.FindAll(parsed.Source)),
                    parsed.Warnings);
            });
        }

        RecordedText.Check("fractals-faults.txt", sweep.Lines());
    }

    [Fact]
    public void Fractals_WithTypicalMistakes_AreAsRecorded()
    {
        string[] cases =
        [
            "", "# a\n", "v 1 2 3", "v (1, 2, 3)", "v 1 2", "v 1 2 3 4", "v 1,5 2 3", "V 1 2 3", "vec 1 2 3", "vector 1 2 3", "v1 1 2 3",
            "v1 2 3",
            "compositon affine", "composition x", "composition affine\ncomposition affine", "x \"b.obj\"", "x. b.obj", "x. b.obj.gz",
            "x. models\\b.ply", "x. \"b.fdo\"", "x. \"b\"",
            "x. \"b.obj", "x. \"b.obj\"\nx. \"c.obj\"", "x. y", "x. \"b.obj\"\n<$>. X", "x. \"b.obj\"\nz<x>. [#] x\n<$>. z 3.5",
            "x. \"b.obj\"\nz<x>. [#] x\n<$>. z3",
            "x. \"b.obj\"\nz<x>. [#] x\n<$>. z.3", "x. \"b.obj\"\nz<x>. [#] x\n<$>. z -3", "x. \"b.obj\"\nz<x>. [#] x\n<$>. 6",
            "x. \"b.obj\"\nz<x>. [#] x\n<$> z 6",
            "x. \"b.obj\"\n<$>. x 6", "x. \"b.obj\"\nz<x>. x\n<$>. z 2", "x. \"b.obj\"\ny. \"c.obj\"\nz<x>. [#] y\n<$>. z 2",
            "x. \"b.obj\"\nz<x>. [#] x\nw<z>. [#] z\n<$>. w 2",
            "x. \"b.obj\"\nz<x>. [#] x\nw<x>. z\n<$>. w 2", "t.a (a, #, #)", "t.a. (b, #, #)", "t.a. (a, #, 0.5)",
            "t. ((1, 2, 3), #, #)", "t.a. (a, #, -1)", "t.a.a. (a, #, #)",
            "t.a.b.c.d. (a, b, c)", "t. (0, #, #)", "t. (#, #)", "t. (#, #, #, #)", "t. (#, #, #)\nt. (#, #, #)", Small + "<$>. x",
            "v 1 1 1\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. [t] x",
            "v 1 1 1\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. [t.1 1] x", "v 1 1 1\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. [1, 2] x",
            "v 1 1 1\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. t.1 x",
            "v 1 1 1\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. [t1] x", "v 1 1 1\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. [t.2] x",
            "v 1 1 1\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. [t.0] x",
            "v 1 1 1\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. [t.1.1] x", "v 1 1 1\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. [x.1] x",
            "v 1 1 1\nt.a. (a, #, #)\nx. \"b.obj\"\n<$>. t",
            "v 1 1 1\ntree.a. (a, #, #)\nx. \"b.obj\"\n<$>. [tre.1] x", "v 1 1 1\nt.a. (a, #, #)\nbase. \"b.obj\"\n<$>. [t.1] bass",
            "v 0 1 1\nt.a. (#, #, a)\nx. \"b.obj\"\n<$>. [t.1] x",
            "v 1e-300 1 1\nt.a. (#, #, a)\nx. \"b.obj\"\n<$>. [t.1] x", "v 0.5 0.2 0\nt.a. (#, a, #)\nx. \"b.obj\"\n<$>. [t.1] x",
            "composition componentwise\nx. \"b.obj\"\nz<x>. [#] x\n<$>. z",
            "v 1 1 1 # c", "x. \"b.obj\" # c", "<$>. \"a.obj\"\n<$>. \"b.obj\"", "x. \"b.obj\"\nz<x>. [#] x\n<$>. z 1000001",
            "x. \"b.obj\"\nz<x>. [#] x\n<$>. z 99999999999",
            "t.a. (2, #, a)\nv 1 1 1\nx. \"b.obj\"\n<$>. [t.1] x", "t.a. (2, #, a)\nx. \"b.obj\"\n<$>. x",
            "x. \"b.obj\"\nz<x>. [#] x\nw<x>. z\n", "x<$>. \"a.obj\"", "<$>. [#] [#] \"a.obj\"", "<$>. [#,] \"a.obj\"",
            "<$>. [# #] \"a.obj\"", "<$>. [#", "<$>.", "<$>", "<$", "a.b.c", "a<b", "a<b>", "a<b>. ", "1. \"b.obj\"", "x.. \"b.obj\"",
            // What people write who know other languages.
            "step. (1, 0, 0), (0, 10, 0), (0.98)",
            "a. (1 0 0) # 0.5",
            "a. (1, 0, 0, 0, 90, 0, 0.5)",
            "<$>. [(1, 0, 0)] box",
            "<$>. [((1, 0, 0), #, (0.5)^0..9] box",
            "<$>. [((1, 0, 0), #, (0.5))^0..9 box",
            "a. (#, #, #)\n<$>. [(a., a.)^0..3] box",
            "a. (#, #, #)\n<$>. [(a. a.)^0..3] box",
            "a. (#, #, #)\n<$>. [((a. * ((0,1,0),#,#)^2)] box",
            "<$>. [((1, 0, 0), #, (0.5), (1, 0, 0))] box",
            "a. ((1, 0), (0, 90, 0), #)",
            "a. (#, #, (0.5, 0.5))",
            "<$>. 10 * { x 1 } box",
            "<$>. 3 box",
            "a. (#, #, #)\n<$>. 20 a box",
            "a. (#, #, #)\n<$>. [9 * a.] box",
            "a. (#, #, #)\n<$>. [a. * 3] box",
            "step. { x 1 ry 10 s 0.98 }",
            "a. (#, #, #)\n<$>. a.^0..9 box",
            "a. (#, #, #)\n<$>. a. box",
            "a. (#, #, #)\n<$>. [a., a.]^4 box",
            "a. (#, #, #)\nc. a. * a.",
            "a. (#, #, #)\nc. a.^3",
            "c. ((1, 0, 0), #, #) * (#, #, #)",
            "a. (#, #, #)\n<$>. [a. ^ 0..9] box",
            "a. (#, #, #)\n<$>. [a.^0 .. 9] box",
            "a. (#, #, #)\n<$>. [a.^0,9] box",
            "a. (#, #, #)\n<$>. [a.^0:9] box",
            "a. (#, #, #)\n<$>. [a.^0-9] box",
            "a. (#, #, #)\n<$>. [a.^(0..5)] box",
            "a. (#, #, #)\n<$>. [a.^0...9] box",
            "n = 3\na. (#, #, #)\n<$>. [a.^0..n] box",
            "b. [((1,0,0),#,#)] box\n<$>. [b.^0..3] box",
            "rule r {",
            "set maxdepth 5",
            "startshape tree",
            "my tree. (#, #, #)",
            "left-1. (#, #, #)",
            "tree(box). [(#, #, #)] box",
            "tree <box>. [(#, #, #)] box",
            "tree 5",
            "h = sin 30",
            "h = (sqrt 0.5)",
            "h = pow(2, 3)",
            "h = 2**3",
            "h = 2pi",
            "a. (#, (90°), #)",
            "a. (#, #, (50%))",
            "size = 0.5;",
            "size = 0.5 /* half */",
            "/* half */",
            "angle = 30 (0 .. 90)",
            "angle = 30 in 0..90",
            "a = ((1,0,0), #, (0.5))",
            "p = 1, 0, 0",
            "t.x.y. (x, y, #)\n<$>. [t.(1, 2)] box",
            "<$>. [(x=1, ry=30, s=0.5)] box",
            "<$>. [ry 30] box",
            "a. x = 1, ry = 10",
            "tree<box>. [",
            "t.x. ((x), #, #)\n<$>. [t.30] box",
            "t.x. ((x), #, #)\n<$>. [t.-1] box",
            "t.x. ((x), #, #)\n<$>. [t.#] box",
            "<$>. box - ball",
            // Chance, and ends by size.
            "seed 7 by levels",
            "seed -3",
            "seed 1.5",
            "seed 99999999999",
            "<$>. 1: box | ball",
            "<$>. box | ball",
            "<$>. 1 box | 1 ball",
            "<$>. 0: box | 0: ball",
            "<$>. -1: box | 2: ball",
            "<$>. w: box | 2: ball",
            "<$>. [(#, #, #)] 1: box | 2: ball",
            "composition componentwise\n<$>. 1: box | 2: ball",
            "<$>. 1: box || 1: ball",
            "<$>. 1: box, 1: ball",
            "<$>. 30%: box | 70%: ball",
            "z<box>. [(#, #, (0.5))] box\n<$>. z until",
            "z<box>. [(#, #, (0.5))] box\n<$>. z until 0",
            "z<box>. [(#, #, (0.5))] box\n<$>. z until size 0.2",
            "z<box>. [(#, #, (0.5))] box\n<$>. z 4 until 0.2",
            "z<box>. [(#, #, #)] box\n<$>. z until 0.2",
            "z<box>, w<ball>. [(#, #, (0.5))] ball, [(#, #, (2))] box\n<$>. z until 0.2",
            "z<box>. [(#, #, (0.5))] box until 0.2",
            "<$>. box until 0.2",
            // Colours of maps.
            "a. (#, #, #) colour",
            "a. (#, #, #) colour (1, 0, 0)",
            "a. (#, #, #) colour (1, 0, 0) 2",
            "a. (#, #, #) colour (255, 0, 0) 1",
            "a. (#, #, #) color (1, 0, 0) 0.5",
            "a. (#, #, #) colour red 0.5",
            "a. (#, #, #) colour (1, 0, 0), 0.5",
            "a. (#, #, #) colour (1, 0, 0) 0.5\n<$>. [a.^-1] box",
            "composition componentwise\na. (#, #, #) colour (1, 0, 0) 0.5\n<$>. [a.] box",
            "a.c.k. (#, #, #) colour c k\n<$>. [a.(2, 0, 0).(0.5)] box",
            "a.c.k. (#, #, #) colour c k\n<$>. [a.(1, 0, 0).(1.5)] box",
            "tree<box>. [(#,#,(0.5))] box\n<$>. tree^5",
            "a. (#, #, #)\n<$>. [a.a.] box",
            "t.a.(a, #, #)\nx. \"b.obj\"\n<$>. x", "ü. \"b.obj\"\n<$>. ü", "_a. \"b.obj\"\n<$>. _a",
        ];
        RecordedText.Check("fractals-mistakes.txt", cases.Select(Outcome));
    }

    [Fact]
    public void Fractals_AtTheirLimits_AreAsRecorded()
    {
        const string nested = "x. \"b.obj\"\nz<x>. [#, #] x\ny<x>. z 2\nw<x>. y 2\n<$>. w 2\n";
        (Limit Limit, long Value)[] limits =
        [
            (FractalLimits.Depth, 1), (FractalLimits.Depth, 2), (FractalLimits.Levels, 7), (FractalLimits.Levels, 8),
            (FractalLimits.Steps, 1),
            (FractalLimits.Nesting, 2), (FractalLimits.Nesting, 3), (FractalLimits.Digits, 2), (FractalLimits.Digits, 3),
            (ParsingLimits.Maps, 1), (ParsingLimits.Maps, 2),
            (ParsingLimits.Names, 3), (ParsingLimits.Names, 4), (ParsingLimits.RepeatedSteps, 2), (ParsingLimits.RepeatedSteps, 3),
        ];
        var lines = new List<string>();
        foreach (var (limit, value) in limits)
        {
            limit.Value = value;
            try
            {
                lines.Add($"{limit.Name}={value} {Outcome(nested)}");
                lines.Add($"{limit.Name}={value} {Outcome("x. \"b.obj\"\nt. (#, #, #)\ny. [#] x\n<$>. [#] [#] [t., #] y\n")}");
            }
            finally
            {
                limit.Value = limit.Default;
            }
        }

        RecordedText.Check("fractals-limits.txt", lines);
    }

    [Fact]
    public void Fractals_OfTheAssets_ReadAndWriteAsRecorded()
    {
        var lines = Directory.EnumerateFiles(Repository.Full("assets/fractals"), "*.fdo").Order(StringComparer.Ordinal).Select(file =>
        {
            var parsed = FractalParser.Parse(SourceText.Read(file, file, 1 << 24));
            string text = Write(parsed);
            Assert.Equal(parsed.Description, FractalParser.Parse(new("written.fdo", text)).Description);
            var numbers = FractalNumber.FindAll(parsed.Source);
            return $"{Path.GetFileName(file)} {parsed.BaseFile} {parsed.Bases[0].Offset} {parsed.ResultOffset} {numbers.Length} "
                + Description.OfNumbers([.. numbers.Select(number => number.Value)])
                + Description.OfNumbers([.. numbers.Select(number => number.Offset + (100.0 * number.Length) + (1e4 * (int)number.Role)
                    + (1e5 * number.Component))])
                + $" {Kinds(text)} {text.Length}";
        });
        RecordedText.Check("fractals-assets.txt", lines);
    }

    [Fact]
    public void Writer_OfSmallFractals_WritesAsRecorded() => RecordedText.Check("fractals-written.txt", Texts.Concat(
    [
        "v 1 0 0\nv 0 1 0\nv .5 .5 .5\nv 10 0 0\nx. \"b.obj\"\nt.a.b. (a, b, 3)\ns.a. (#, #, a)\nr.a. (#, a, #)\nz<x>. [t.1.4, t.2.4, "
            + "#] [s.3] [r.4, r.4] x\n<$>. [s.3] z 4",
        "v -0 0 0\nv 1 1 1\nx. \"b.obj\"\nt.a.b. (a, #, b)\n<$>. [t.1.2] [#] [] x",
    ]).SelectMany(text =>
    {
        var parsed = FractalParser.Parse(new("t.fdo", text));
        return new[] { $"$ {text.Split('\n')[0]}" }.Concat(Write(parsed).Split('\n'))
            .Concat(FractalNumber.FindAll(parsed.Source).Take(12).Select(number => Description.Of(number)));
    }));

    [Fact]
    public void Numbers_ThatAreReplaced_AreAsRecorded() => RecordedText.Check(
        "fractals-replaced.txt", FractalNumber.FindAll(new("t.fdo", Small)).SelectMany(number => ((double[])[-3, 0.25, 2.5, 7.75]).Select(
            value => number.Replace(Small, value).Replace("\n", "⏎", StringComparison.Ordinal))).Distinct());

    private static string Write(ParsedFractal parsed) =>
        FractalWriter.Write(parsed.Description, [.. parsed.Bases.Select(static one => one.File)]);

    // First letters of the lines, with how often each comes.
    private static string Kinds(string text) => string.Join(
        '/', text.Split('\n').GroupBy(line => line.Length > 0 ? line[0] : '-').Select(group => $"{group.Key}{group.Count()}"));

    private static string Outcome(string text)
    {
        string shown = text.Replace("\n", "⏎", StringComparison.Ordinal);
        try
        {
            var parsed = FractalParser.Parse(new("t.fdo", text));
            string warnings = string.Join(' ', parsed.Warnings.Select(warning => warning.ToString().Split('\n')[0]));
            return $"{shown} → {parsed.BaseFile} {parsed.Description.IsInfinite} {parsed.Description.Steps.Length} {warnings}";
        }
        catch (SourceException exception)
        {
            return $"{shown} → {(exception.Kind == ErrorKind.Limit ? "limit " : "")}{exception.Diagnostic.ToString().Split('\n')[0]}";
        }
    }
}
