using System.Collections.Concurrent;
using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Parsing;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;
using FractalEngine.Tests.Support;
using Xunit.Sdk;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Makes fractals of random models, and compares. A failure comes with the smallest model that was found.</summary>
/// <param name="options">What the models may have.</param>
/// <param name="points">Number of positions for each.</param>
/// <param name="rays">Number of rays for each.</param>
/// <param name="source">How the fractals are made.</param>
internal class GraphCases(GraphOptions options, int points, int rays, GraphSource source)
{
    // A few show whether they have one cause.
    private const int MaxFailures = 4;

    private readonly ConcurrentQueue<string> _failures = [];

    /// <summary>Checks the models of seeds from 1 on.</summary>
    public GraphTally Run(int count, bool inParallel = false)
    {
        var seeds = ParallelEnumerable.Range(1, count).WithDegreeOfParallelism(inParallel ? Environment.ProcessorCount : 1);
        var tally = seeds.Aggregate(GraphTally.Zero, (sum, seed) => sum + RunOne(seed), static (a, b) => a + b, static sum => sum);
        return _failures.IsEmpty ? tally : throw new XunitException(string.Join("\n", _failures));
    }

    /// <summary>Draws a model with its expansion.</summary>
    protected virtual (GraphFile File, ImmutableArray<PlacedMesh> Instances) Create(Random random) =>
        RandomGraphFiles.Create(random, options);

    /// <summary>Expands a model that may be one without a meaning.</summary>
    protected virtual ImmutableArray<PlacedMesh>? TryExpand(GraphFile file) => ModelExpansion.TryExpand(file);

    /// <summary>Compares what else the engine says of the fractal.</summary>
    protected virtual void CheckStructure(GraphFile file, Fractal fractal, TriangleSoup soup, Random random) =>
        GraphStructureChecker.Check(fractal, soup, random);

    private GraphTally RunOne(int seed)
    {
        if (_failures.Count >= MaxFailures)
        {
            return GraphTally.Zero;
        }

        Random random = new(seed);
        var (file, instances) = Create(random);
        var texts = GraphTexts.Of(file, random);
        try
        {
            return Check(file, texts, new(instances), seed);
        }
        catch (Exception exception) when (exception is not OutOfMemoryException)
        {
            _failures.Enqueue($"seed {seed}: {exception}\n{texts}{DescribeSmaller(file, exception, seed)}");
            return GraphTally.Zero;
        }
    }

    private GraphTally Check(GraphFile file, GraphTexts texts, TriangleSoup soup, int seed)
    {
        if (Make(file, texts) is not { } fractal)
        {
            return GraphTally.Zero;
        }

        Random random = new(seed);
        CheckStructure(file, fractal, soup, random);
        return new GraphChecker(fractal, soup, random).Check(points, rays);
    }

    /// <summary>Makes the fractal of a model; null for one that can't be made, or is left out.</summary>
    protected virtual Fractal? Make(GraphFile file, GraphTexts texts)
    {
        if (source == GraphSource.Code)
        {
            return GraphCode.TryMake(file);
        }

        using TemporaryFolder folder = new();
        var fractal = FractalFile.Read(texts.WriteTo(folder));
        if (source == GraphSource.File)
        {
            return fractal;
        }

        FractalFile.Write(folder["written.fdo"], fractal);
        return FractalFile.Read(folder["written.fdo"]);
    }

    private string DescribeSmaller(GraphFile file, Exception failure, int seed)
    {
        string? message = null;
        var smaller = GraphShrinker.Shrink(file, candidate =>
        {
            try
            {
                // Names may be gone, which fails in another way.
                if (TryExpand(candidate) is { } instances)
                {
                    Check(candidate, GraphTexts.Of(candidate), new(instances), seed);
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
