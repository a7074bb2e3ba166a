using Xunit.Sdk;

namespace FractalEngine.Tests.Support;

/// <summary>Runs a check on many random inputs. A failure names the seed that repeats it.</summary>
internal static class Seeded
{
    public static void Run(int cases, Action<Random> check)
    {
        for (var seed = 1; seed <= cases; seed++)
        {
            RunOne(seed, check);
        }
    }

    /// <summary>
    /// Runs a check that can't use every input, and fails where it used too few: a check that skips its cases would pass otherwise.
    /// </summary>
    /// <param name="cases">Number of seeds.</param>
    /// <param name="check">Returns false for an input that it skipped.</param>
    /// <param name="minShare">Smallest share of the cases that must have been checked.</param>
    public static void RunMost(int cases, Func<Random, bool> check, double minShare = 0.9)
    {
        var checkedCount = 0;
        Run(cases, random => checkedCount += check(random) ? 1 : 0);
        AssertMost(checkedCount, cases, minShare);
    }

    /// <summary>Runs the seeds of <see cref="RunMost"/> in parallel.</summary>
    public static void RunMostInParallel(int cases, Func<Random, bool> check, double minShare = 0.9)
    {
        var checkedCount = 0;
        Parallel.For(1, cases + 1, seed => RunOne(seed, random =>
        {
            if (check(random))
            {
                Interlocked.Increment(ref checkedCount);
            }
        }));
        AssertMost(checkedCount, cases, minShare);
    }

    public static void RunOne(int seed, Action<Random> check)
    {
        try
        {
            check(new(seed));
        }
        catch (Exception exception)
        {
            throw new XunitException($"seed {seed}: {exception.Message}", exception);
        }
    }

    /// <summary>Fails unless enough of the cases were checked.</summary>
    public static void AssertMost(int checkedCount, int cases, double minShare = 0.9)
    {
        if (!(checkedCount >= minShare * cases))
        {
            throw new XunitException(FormattableString.Invariant($"only {checkedCount} of {cases} cases were checked, not {minShare:P0}"));
        }
    }
}
