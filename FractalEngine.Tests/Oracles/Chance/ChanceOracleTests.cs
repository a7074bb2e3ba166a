using FractalEngine.Tests.Oracles.Graphs;
using static System.FormattableString;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Random files with choices and ends by size, against an expansion that shares nothing with the engine but its files.</summary>
public class ChanceOracleTests
{
    [Fact]
    public void Answers_OfFilesByChance_AreThoseOfAllTriangles() => Check(16, 10, 10);

    [Fact]
    [Trait("Category", "Soak")]
    public void Answers_OfManyFilesByChance_AreThoseOfAllTriangles() => Check(2000, 100, 100, inParallel: true);

    [Fact]
    public void Answers_OfFilesByChanceThatTheEngineWrote_AreThoseOfAllTriangles() => Check(10, 5, 5, GraphSource.WrittenFile);

    [Fact]
    [Trait("Category", "Soak")]
    public void Answers_OfManyFilesByChanceThatTheEngineWrote_AreThoseOfAllTriangles() =>
        Check(2000, 10, 10, GraphSource.WrittenFile, inParallel: true);

    private static void Check(int count, int points, int rays, GraphSource source = GraphSource.File, bool inParallel = false)
    {
        var tally = new ChanceCases(new(), points, rays, source).Run(count, inParallel);
        // Few are left out only when they are read.
        Assert.InRange(tally.Graphs, 0.95 * count, count);
        // The rays have to hit something.
        Assert.True(tally.Hits > 0.2 * tally.Rays, Invariant($"{tally}"));
    }
}
