using System.Diagnostics;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// Times of several things side by side: in each round all take their turn, so that a busy moment of the machine meets no one alone, and
/// the smallest time of all rounds counts. So the first rounds, which are the compiler's, do not.
/// </summary>
internal static class InterleavedTiming
{
    /// <summary>Seconds of one call, for each.</summary>
    public static double[] MeasureBestSeconds(IReadOnlyList<Action> actions, int rounds)
    {
        var best = new double[actions.Count];
        Array.Fill(best, double.PositiveInfinity);
        for (var round = 0; round < rounds; round++)
        {
            for (var i = 0; i < best.Length; i++)
            {
                var start = Stopwatch.GetTimestamp();
                actions[i]();
                best[i] = Math.Min(best[i], Stopwatch.GetElapsedTime(start).TotalSeconds);
            }
        }

        return best;
    }
}
