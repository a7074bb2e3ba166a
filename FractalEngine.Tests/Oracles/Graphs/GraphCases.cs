using System.Collections.Concurrent;
using FractalEngine.Parsing;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;
using FractalEngine.Tests.Support;
using Xunit.Sdk;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Writes random models, reads them by the engine, and compares. A failure comes with the smallest model that was found.</summary>
internal static class GraphCases
{
    // A few show whether they have one cause.
    private const int MaxFailures = 4;

    /// <summary>Checks the models of seeds from 1 on.</summary>
    public static GraphTally Run(int count, int points, int rays, GraphOptions options, bool inParallel = false)
    {
        var seeds = ParallelEnumerable.Range(1, count).WithDegreeOfParallelism(inParallel ? Environment.ProcessorCount : 1);
        ConcurrentQueue<string> failures = [];
        var tally = seeds.Aggregate(
            GraphTally.Zero, (sum, seed) => sum + RunOne(seed, points, rays, options, failures), static (a, b) => a + b, static sum => sum);
        return failures.IsEmpty ? tally : throw new XunitException(string.Join("\n", failures));
    }

    private static GraphTally RunOne(int seed, int points, int rays, GraphOptions options, ConcurrentQueue<string> failures)
    {
        if (failures.Count >= MaxFailures)
        {
            return GraphTally.Zero;
        }

        Random random = new(seed);
        var (file, instances) = RandomGraphFiles.Create(random, options);
        var texts = GraphTexts.Of(file, random);
        try
        {
            return Check(texts, new(instances), seed, points, rays);
        }
        catch (Exception exception) when (exception is not OutOfMemoryException)
        {
            failures.Enqueue($"seed {seed}: {exception}\n{texts}{DescribeSmaller(file, exception, seed, points, rays)}");
            return GraphTally.Zero;
        }
    }

    private static GraphTally Check(GraphTexts texts, TriangleSoup soup, int seed, int points, int rays)
    {
        using TemporaryFolder folder = new();
        var fractal = FractalFile.Read(texts.WriteTo(folder));
        Random random = new(seed);
        GraphStructureChecker.Check(fractal, soup, random);
        GraphStructureChecker.CheckWritten(fractal, soup, folder, random);
        return new GraphChecker(fractal, soup, random).Check(points, rays);
    }

    private static string DescribeSmaller(GraphFile file, Exception failure, int seed, int points, int rays)
    {
        string? message = null;
        var smaller = GraphShrinker.Shrink(file, candidate =>
        {
            try
            {
                // Names may be gone, which fails in another way.
                if (ModelExpansion.TryExpand(candidate) is { } instances)
                {
                    Check(GraphTexts.Of(candidate), new(instances), seed, points, rays);
                }

                return false;
            }
            catch (Exception exception) when (KindOf(exception) == KindOf(failure))
            {
                message = exception.ToString();
                return true;
            }
            catch (Exception exception) when (exception is not OutOfMemoryException)
            {
                return false;
            }
        });
        return message is null ? "(only in this form)\n" : $"smaller: {message}\n{GraphTexts.Of(smaller)}";
    }

    /// <summary>The law that is broken, or the message without what it quotes.</summary>
    private static string KindOf(Exception exception) => exception is GraphMismatch mismatch
        ? mismatch.Kind
        : exception.GetType().Name + exception.TargetSite?.Name + string.Concat(
            exception.Message.Split('\n')[0].Split(": error: ")[^1].Split('\'').Where(static (_, i) => i % 2 == 0));
}
