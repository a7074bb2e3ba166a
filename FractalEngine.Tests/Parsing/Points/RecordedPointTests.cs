using FractalEngine.Parsing.Points;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Recorded;

namespace FractalEngine.Tests.Parsing.Points;

/// <summary>Compares what the parsers make of lists of points and rays, and how long lines are shown, with what is recorded.</summary>
public class RecordedPointTests
{
    [Fact]
    public void Lists_WithEverySmallFault_AreAsRecorded()
    {
        var sweep = new FaultSweep();
        sweep.Run("# a\n1 2 3\n\n-0.5, 1e3 , 2 # b\n1e75 0 0\n", static text => (PointsParser.Parse(new("t.txt", text)), []));
        sweep.Run("1 2 3 0 0 1\n# a\n0, 0, 0, 1e3, 0, -2 # b\n1e75 0 0 0 1e75 0\n", static text => (RaysParser.Parse(new("t.txt", text)),
            []));
        string[] values = ["1e75", "1.1e75", "1e76", "1e150", "1.1e150", "1e151", "0"];
        RecordedText.Check("points-faults.txt", sweep.Lines().Concat(values.SelectMany(value => (string[])[
            Outcome(() => PointsParser.Parse(new("t.txt", $"0 {value} 0\n"))), Outcome(() => RaysParser.Parse(new("t.txt",
                $"0 0 -{value} 1 0 0\n"))),
            Outcome(() => RaysParser.Parse(new("t.txt", $"0 0 0 0 0 {value}\n")))])));
    }

    [Fact]
    public void Diagnostics_OfLongLines_AreAsRecorded() => RecordedText.Check(
        "long-lines.txt", ((int[])[1, 2, 49, 99, 100, 101, 102, 150, 199, 200, 201]).SelectMany(column => ((int[])[100, 101,
        200]).Select(length =>
            new Diagnostic("t", 1, column, DiagnosticSeverity.Warning, "m", string.Concat(Enumerable.Range(0,
                length).Select(i => (char)('a' + (i % 26)))))
                .ToString().Replace("\n", "⏎", StringComparison.Ordinal).TrimEnd())));

    private static string Outcome(Func<object> parse)
    {
        try
        {
            return Description.Of(parse());
        }
        catch (SourceException exception)
        {
            return $"{exception.Kind} {exception.Message.Replace("\n", "⏎", StringComparison.Ordinal)}";
        }
    }
}
