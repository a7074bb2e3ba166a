using Xunit.Sdk;

namespace FractalEngine.Tests.Support;

/// <summary>Runs a check on many random inputs; a failure names the seed that repeats it.</summary>
internal static class Seeded
{
    public static void Run(int cases, Action<Random> check)
    {
        for (var seed = 1; seed <= cases; seed++)
        {
            RunOne(seed, check);
        }
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
}
