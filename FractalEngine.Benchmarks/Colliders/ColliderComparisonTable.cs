using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>
/// What do the colliders of fractals cost, and how wrong are they? One row for each fractal, collider and kind of position: face and bound
/// tests and time a query, the largest error, and the collisions that were missed.
/// </summary>
/// <remarks>
/// Times are the smallest of some rounds, in which the colliders take turns, on one thread; the ratio is to the paper's descent on
/// the same positions. The reference for errors is a hierarchy over the faces of the expanded fractal where they are not too many, else the
/// exact collider.
/// </remarks>
internal sealed class ColliderComparisonTable(int queries, int rounds, TextWriter output)
{
    // Of the fractal's size: errors above it count as wrong.
    private const double MaxRelativeError = 1e-6;
    private const int MaxExpandedFaces = 1_000_000;

    private static readonly TimeSpan WarmUpDuration = TimeSpan.FromSeconds(3);

    private readonly QueryContext _context = new();
    private readonly Stopwatch _sinceStart = Stopwatch.StartNew();

    /// <summary>Writes the head and a few rows for each fractal.</summary>
    public void Write(IEnumerable<FractalCase> cases)
    {
        output.WriteLine(
            $"{"fractal",-26}{"positions",-10}{"collider",-11}{"faces",9}{"bounds",9}{"us",9}{"ratio",8}{"largest error",15}{"wrong %",9}{"missed %",10}");
        foreach (var (name, fractal) in cases)
        {
            var build = Stopwatch.StartNew();
            var exact = new ExactFractalCollider(fractal);
            build.Stop();
            List<(string Name, Collider Collider)> colliders = [("fractal", new FractalCollider(fractal)), ("exact", exact)];
            if (fractal.FaceCount <= MaxExpandedFaces)
            {
                colliders.Insert(0, ("hierarchy", new HierarchyCollider(FractalGenerator.Flatten(fractal, MaxExpandedFaces))));
            }

            foreach (var (kind, make) in PositionKinds)
            {
                var random = new Random(1);
                var positions = Enumerable.Range(0, queries).Select(_ => make(random, fractal)).ToArray();
                Write(name, kind, fractal, colliders, positions, kind == "far"
                    ? DistanceErrors.TouchDistance * fractal.Bounds.Diagonal
                    : double.PositiveInfinity);
            }

            output.WriteLine(
                FormatInvariant(
                    $"{name,-26}{"build",-10}{"exact",-11}{build.Elapsed.TotalMilliseconds,27:F2} ms, {exact.StorageBytes / 1024.0:F1} KB"));
        }
    }

    private static (string Name, Func<Random, Fractal, Vector> Make)[] PositionKinds { get; } =
    [
        ("uniform", static (random, fractal) => QueryPositions.Uniform(random, fractal.Bounds)),
        ("near", QueryPositions.NearSurface),
        ("far", static (random, fractal) => QueryPositions.Far(random, fractal.Bounds)),
    ];

    private void Write(
        string name, string kind, Fractal fractal, List<(string Name, Collider Collider)> colliders, Vector[] positions, double maxDistance)
    {
        var size = fractal.Bounds.Diagonal;
        var distances = colliders.Select(entry => ComputeDistances(entry.Collider, positions, maxDistance)).ToArray();
        var costs = colliders.Select(entry => CountTests(entry.Collider, positions, maxDistance)).ToArray();
        WarmUpColliders(colliders, positions, maxDistance);
        var times = MeasureTimes(colliders, positions, maxDistance);
        // The first is the hierarchy, if there is one, else the last is.
        var reference = distances[colliders.Count > 2 ? 0 : 1];
        var descentIndex = colliders.FindIndex(entry => entry.Name == "fractal");
        for (var i = 0; i < colliders.Count; i++)
        {
            var errors = DistanceErrors.Compare(distances[i], reference, size);
            var wrongCount = distances[i].Zip(reference).Count(pair => Math.Abs(pair.First - pair.Second) > MaxRelativeError * size);
            output.WriteLine(FormatInvariant(
                $"{name,-26}{kind,-10}{colliders[i].Name,-11}{costs[i].Faces,9:F1}{costs[i].Bounds,9:F1}{times[i],9:F3}{times[i] / times[descentIndex],8:F3}{errors.Max,15:E1}{100.0 * wrongCount / queries,9:F1}{errors.MissedPercent,10:F1}"));
        }
    }

    private static string FormatInvariant(FormattableString text) => text.ToString(CultureInfo.InvariantCulture);

    private double[] ComputeDistances(Collider collider, Vector[] positions, double maxDistance) =>
        [.. positions.Select(position => collider.TryFindClosest(position, maxDistance, _context, out var closest)
        ? closest.Distance
        : double.PositiveInfinity)];

    private (double Faces, double Bounds) CountTests(Collider collider, Vector[] positions, double maxDistance)
    {
        _context.Reset();
        ComputeDistances(collider, positions, maxDistance);
        return ((double)_context.FaceTests / queries, (double)_context.BoundTests / queries);
    }

    /// <summary>The compiler needs some thousand calls, and then some time, to do its best: most of it with the first fractal.</summary>
    private void WarmUpColliders(List<(string Name, Collider Collider)> colliders, Vector[] positions, double maxDistance)
    {
        do
        {
            MeasureTimes(colliders, positions, maxDistance);
        }
        while (_sinceStart.Elapsed < WarmUpDuration);
    }

    /// <summary>Microseconds a query.</summary>
    private double[] MeasureTimes(List<(string Name, Collider Collider)> colliders, Vector[] positions, double maxDistance)
    {
        var best = new double[colliders.Count];
        Array.Fill(best, double.PositiveInfinity);
        for (var round = 0; round < rounds; round++)
        {
            for (var i = 0; i < best.Length; i++)
            {
                var watch = Stopwatch.StartNew();
                foreach (var position in positions)
                {
                    colliders[i].Collider.TryFindClosest(position, maxDistance, _context, out _);
                }

                best[i] = Math.Min(best[i], watch.Elapsed.TotalMicroseconds / queries);
            }
        }

        return best;
    }
}
