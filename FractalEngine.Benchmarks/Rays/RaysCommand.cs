using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Benchmarks.Rays;

/// <summary>
/// Runs the command <c>rays</c>: rays on the levels of fractals beside a search of the expanded mesh, where that fits into memory.
/// </summary>
internal static class RaysCommand
{
    private const string Usage = """
        rays [--quick] [--output FOLDER]
          Million rays a second on one thread, of a camera, towards the sun, and at random; what all cores gain for a batch;
          writes rays.csv, into docs/benchmarks or, with --quick, out/benchmarks unless stated.
        """;

    private const long MaxExpandedFaces = 3_000_000;

    private static readonly string[] Names =
        ["menger:3", "menger:5", "menger:10", "menger:40", "tetrahedron:8", "tetrahedron:10", "sierpinski:5", "sierpinski:8",
        "tree:6", "tree:10", "appendix-b:3", "appendix-b:5", "fern:3", "romanesco:3", "terrain:8"];

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        if (TableOptions.TryParse("rays", Usage, args) is not { } options)
        {
            return 2;
        }

        var table = options.CreateTable(
            "rays.csv", "fractal", "bytes", "primary_mrays", "shadow_mrays", "random_mrays", "primary_to_expansion", "shadow_to_expansion",
            "random_to_expansion", "hits_percent", "all_cores_to_one");
        foreach (var name in options.IsQuick ? Names[..2] : Names)
        {
            Write(name, options, table);
        }

        table.Save();
        return 0;
    }

    private static void Write(string name, TableOptions options, CsvTable table)
    {
        var fractal = FractalCase.Parse(name).Fractal;
        var caster = RayCaster.For(fractal);
        var sets = new RaySets(caster, fractal.Bounds, options.IsQuick ? 2500 : 22_500);
        var expansion = fractal.FaceCount <= MaxExpandedFaces
            ? RayCaster.For(FractalGenerator.Flatten(fractal, MaxExpandedFaces))
            : null;
        List<Action> actions = [.. Actions(caster, sets), .. expansion is null ? [] : Actions(expansion, sets)];
        var seconds = InterleavedTiming.MeasureBestSeconds(actions, options.Rounds, warmUp: TimeSpan.FromSeconds(1));
        int[] counts = [sets.Primary.Length, sets.Shadow.Length, sets.Random.Length];
        var context = new QueryContext();
        var hits = sets.Primary.Count(ray => caster.TryFindNearest(ray, context, out _));
        object?[] row =
        [
            name, caster.StorageBytes,
            .. counts.Select((count, i) => (object)Math.Round(count / seconds[i] / 1e6, 3)),
            .. Enumerable.Range(0, 3).Select(i => expansion is null ? null : (object)Math.Round(seconds[3 + i] / seconds[i], 3)),
            Math.Round(100.0 * hits / sets.Primary.Length, 1), Math.Round(MeasureScaling(fractal, sets.Primary, options.Rounds), 2),
        ];
        table.Add(row);
        Console.WriteLine(string.Join(' ', row.Select(static field => Convert.ToString(field, CultureInfo.InvariantCulture))));
    }

    /// <summary>Measures how many times as fast a batch on all cores is as one on one core.</summary>
    private static double MeasureScaling(Fractal fractal, Ray[] rays, int rounds)
    {
        var scene = new SceneRayCaster(LoadedScene.Of(new Scene { Objects = [new SceneObject(fractal)] }));
        var seconds = InterleavedTiming.MeasureBestSeconds([() => FindAll(1), () => FindAll(null)], rounds);
        return seconds[0] / seconds[1];

        void FindAll(int? threads) => BatchQuery.Run(rays, (ray, context) => scene.FindNearest(ray, context), threads: threads);
    }

    private static Action[] Actions(RayCaster caster, RaySets sets)
    {
        var context = new QueryContext();
        return
        [
            () => FindAll(caster, sets.Primary, context),
            () => Array.ForEach(sets.Shadow, ray => caster.HitsAny(ray, context)),
            () => FindAll(caster, sets.Random, context),
        ];
    }

    private static void FindAll(RayCaster caster, Ray[] rays, QueryContext context)
    {
        foreach (var ray in rays)
        {
            caster.TryFindNearest(ray, context, out _);
        }
    }
}
