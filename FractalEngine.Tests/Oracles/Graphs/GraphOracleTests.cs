using FractalEngine.Tests.Oracles.Graphs.Models;
using static System.FormattableString;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Random files of the language of fractals, against an expansion that shares nothing with the engine but its files.</summary>
public class GraphOracleTests
{
    // Of rays between random places. More would mean that the oracle does not tell what it should.
    private const double MaxAmbiguous = 1e-3;

    private static readonly GraphOptions Linear = new() { IsLinear = true, HasIndirectCalls = true };

    [Fact]
    public void Answers_OfLinearFiles_AreThoseOfAllTriangles() => Check(20, 10, 10, Linear);

    [Fact]
    [Trait("Category", "Soak")]
    public void Answers_OfManyLinearFiles_AreThoseOfAllTriangles() => Check(2000, 100, 100, Linear, inParallel: true);

    [Fact]
    public void Answers_OfRandomFiles_AreThoseOfAllTriangles() => Check(20, 10, 10, new());

    [Fact]
    [Trait("Category", "Soak")]
    public void Answers_OfManyRandomFiles_AreThoseOfAllTriangles() => Check(2000, 100, 100, new(), inParallel: true);

    /// <summary>Bodies with sums use what is built on their bases, which takes no level there.</summary>
    [Fact]
    public void Answers_OfFilesThatUseBasesByOtherNames_AreThoseOfAllTriangles() => Check(20, 5, 5, new() { HasIndirectCalls = true });

    [Fact]
    [Trait("Category", "Soak")]
    public void Answers_OfManyFilesThatUseBasesByOtherNames_AreThoseOfAllTriangles() =>
        Check(1000, 100, 100, new() { HasIndirectCalls = true }, inParallel: true);

    [Fact]
    public void Answers_OfFractalsMadeInCode_AreThoseOfAllTriangles() => Check(20, 5, 5, new(), GraphSource.Code);

    [Fact]
    [Trait("Category", "Soak")]
    public void Answers_OfManyFractalsMadeInCode_AreThoseOfAllTriangles() =>
        Check(1000, 50, 50, new(), GraphSource.Code, inParallel: true);

    [Fact]
    public void Answers_OfFilesThatTheEngineWrote_AreThoseOfAllTriangles() => Check(20, 5, 5, new(), GraphSource.WrittenFile);

    [Fact]
    [Trait("Category", "Soak")]
    public void Answers_OfManyFilesThatTheEngineWrote_AreThoseOfAllTriangles() =>
        Check(2000, 20, 20, new(), GraphSource.WrittenFile, inParallel: true);

    private static void Check(
        int count, int points, int rays, GraphOptions options, GraphSource source = GraphSource.File, bool inParallel = false)
    {
        var tally = new GraphCases(options, points, rays, source).Run(count, inParallel);
        // Recursives that call each other can't be made in code.
        Assert.InRange(tally.Graphs, source == GraphSource.Code ? 0.5 * count : count, count);
        Assert.True(tally.Ambiguous <= MaxAmbiguous * (tally.Rays - tally.Aimed), Invariant($"{tally}"));
        // The rays have to hit something, and most of those at edges and in planes too.
        Assert.True(tally.Hits > 0.2 * tally.Rays, Invariant($"{tally}"));
    }
}
