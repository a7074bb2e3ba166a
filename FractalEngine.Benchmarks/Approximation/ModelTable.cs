using System.Diagnostics;
using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Approximation;
using FractalEngine.Parsing.Assets;

namespace FractalEngine.Benchmarks.Approximation;

/// <summary>What is found for whole models: the fractals of the assets, expanded, and irregular shapes.</summary>
internal static class ModelTable
{
    private const int MaxFaces = 1_000_000;
    private const int OrganicFaces = 20_000;
    private static readonly TimeSpan Limit = TimeSpan.FromSeconds(60);

    /// <summary>Writes the table approximation-models.csv of all models.</summary>
    /// <param name="options">Folder of the table; quick ones have three irregular shapes of each kind, and small assets.</param>
    public static void Write(TableOptions options)
    {
        var table = options.CreateTable(
            "approximation-models.csv", "model", "faces", "verdict", "faces_left", "maps", "bytes", "original_bytes", "mean_distance",
            "max_distance", "same_bytes_mean_distance", "same_bytes_max_distance", "seconds");
        foreach (var path in new[] { "fractals", "classics" }
            .SelectMany(folder => Directory.GetFiles(Path.Combine(FractalCase.Assets, folder), "*.fdo")).Order(StringComparer.Ordinal))
        {
            if (Expand(path, options.IsQuick ? MaxFaces / 10 : MaxFaces) is { } mesh)
            {
                AddRow(table, Path.GetFileName(path), mesh, BytesOf(path));
            }
        }

        foreach (var input in UnseenCases.Organic(Enumerable.Range(0, options.IsQuick ? 3 : 10), OrganicFaces))
        {
            AddRow(table, input.Name, input.Create()!.Mesh, null);
        }

        table.Save();
    }

    private static void AddRow(CsvTable table, string name, Mesh mesh, long? originalBytes)
    {
        using var limit = new CancellationTokenSource(Limit);
        var watch = Stopwatch.StartNew();
        try
        {
            var found = MeshApproximator.Find(mesh, cancellation: limit.Token);
            var same = found.SameBytes?.Distance;
            table.Add(
                name, mesh.FaceCount, found.Verdict, found.Grammar.FaceCount, found.Grammar.MapCount, found.Bytes, originalBytes,
                Rounded(found.Distance.RelativeMeanDistance), Rounded(found.Distance.RelativeMaxDistance.Upper),
                Rounded(same?.RelativeMeanDistance), Rounded(same?.RelativeMaxDistance.Upper), Math.Round(watch.Elapsed.TotalSeconds, 2));
            Console.WriteLine($"{name}: {found.Verdict}");
        }
        catch (OperationCanceledException)
        {
            var nothing = (object?)null;
            table.Add(
                name, mesh.FaceCount, "over the time", nothing, nothing, nothing, originalBytes, nothing, nothing, nothing, nothing,
                Math.Round(watch.Elapsed.TotalSeconds, 2));
            Console.WriteLine($"{name}: over the time");
        }
    }

    /// <summary>The fractal at the largest depth, from its own downwards, at which it has no more faces than that; null at none.</summary>
    private static Mesh? Expand(string path, int maxFaces)
    {
        var fractal = FractalFile.Read(path);
        for (var depth = -1; depth < 12; depth++)
        {
            try
            {
                // Its own depth, and then 12 to 1.
                return (depth < 0 ? fractal : FractalFile.Read(path, new LoadOptions { Depth = 11 - depth })).Flatten(maxFaces);
            }
            catch (FractalLimitException)
            {
                // The next depth has fewer faces.
            }
        }

        return null;
    }

    /// <summary>Size of a file without comments.</summary>
    private static long BytesOf(string path) => File.ReadLines(path).Where(line => !line.StartsWith('#'))
        .Select(line => line.Split("//")[0].TrimEnd().Length).Where(length => length > 0).Sum(length => length + 1L);

    private static double? Rounded(double? number) => number is { } value ? Math.Round(value, 6) : null;
}
