namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Counts what was asked, and how often rounding alone decides the answer.</summary>
internal sealed record GraphTally(long Graphs, long Points, long Rays, long Hits, long Aimed, long Ambiguous, long AmbiguousAimed)
{
    public static GraphTally Zero { get; } = new(0, 0, 0, 0, 0, 0, 0);

    public static GraphTally operator +(GraphTally a, GraphTally b) => new(
        a.Graphs + b.Graphs, a.Points + b.Points, a.Rays + b.Rays, a.Hits + b.Hits, a.Aimed + b.Aimed, a.Ambiguous + b.Ambiguous,
        a.AmbiguousAimed + b.AmbiguousAimed);
}
