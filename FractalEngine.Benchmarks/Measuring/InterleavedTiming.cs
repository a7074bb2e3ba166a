namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// Times several actions side by side. In each round all take their turn, so that a busy moment of the machine meets no one alone. The
/// smallest time of all rounds counts, so that the first rounds, which are the compiler's, do not.
/// </summary>
internal static class InterleavedTiming
{
    /// <summary>Measures the best seconds of one call of each action.</summary>
    /// <param name="actions">Actions to be timed.</param>
    /// <param name="rounds">Number of rounds, at least one.</param>
    /// <param name="clock">Clock that times the calls; the system's by default.</param>
    /// <param name="warmUp">Shortest time for which rounds go on, so that the compiler has done its best in the last ones.</param>
    public static double[] MeasureBestSeconds(
        IReadOnlyList<Action> actions, int rounds, TimeProvider? clock = null, TimeSpan warmUp = default)
    {
        clock ??= TimeProvider.System;
        var begin = clock.GetTimestamp();
        var best = new double[actions.Count];
        Array.Fill(best, double.PositiveInfinity);
        for (var round = 0; round < rounds || clock.GetElapsedTime(begin) < warmUp; round++)
        {
            for (var i = 0; i < best.Length; i++)
            {
                var start = clock.GetTimestamp();
                actions[i]();
                best[i] = Math.Min(best[i], clock.GetElapsedTime(start).TotalSeconds);
            }
        }

        return best;
    }

    /// <summary>Measures the best milliseconds of one action that nothing is compared with in this process.</summary>
    public static double MeasureBestMilliseconds(Action action, int rounds) => 1e3 * MeasureBestSeconds([action], rounds)[0];
}
