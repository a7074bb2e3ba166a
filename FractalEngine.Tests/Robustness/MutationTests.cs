using System.Globalization;
using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Points;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;
using Xunit.Sdk;

namespace FractalEngine.Tests.Robustness;

/// <summary>
/// Loads changed files of the corpus, then queries, counts, traces and prepares them for drawing: a result or an error of the engine's own,
/// in two seconds of processor time.
/// </summary>
public class MutationTests(Xunit.Abstractions.ITestOutputHelper output)
{
    private const double MaxSeconds = 2;

    // What a small file may allocate in all on the way, garbage included.
    private const long MaxAllocatedBytes = 1L << 30;

    private static readonly string[] Entries = ["scene.sdo", "row.fdo", "endless.fdo", "base.obj", "points.txt"];
    private static readonly string[] Cultures = ["", "de-DE", "tr-TR", "ar-SA"];

    [Fact]
    public void LoadThenUse_OfChangedFiles_GivesAResultOrAnErrorOfTheEngine() => Seeded.Run(30, Run);

    [Fact]
    [Trait("Category", "Soak")]
    public void LoadThenUse_OfChangedFilesForTenMinutes_GivesAResultOrAnErrorOfTheEngine()
    {
        var end = DateTime.UtcNow + TimeSpan.FromMinutes(10);
        var seed = 1_000;
        for (; DateTime.UtcNow < end; seed++)
        {
            Seeded.RunOne(seed, Run);
        }

        output.WriteLine($"{seed - 1_000} seeds");
    }

    private static void Run(Random random)
    {
        using var folder = new TemporaryFolder();
        foreach (var file in Directory.GetFiles(Repository.Full("FractalEngine.Tests/Robustness/Corpus")))
        {
            var text = File.ReadAllText(file);
            var name = Path.GetFileName(file);
            File.WriteAllBytes(folder[name], random.Next(3) == 0 ? TextMutation.Mutate(random, text) : File.ReadAllBytes(file));
        }

        var entry = Entries[random.Next(Entries.Length)];
        var culture = Cultures[random.Next(Cultures.Length)];
        var before = GC.GetAllocatedBytesForCurrentThread();
        try
        {
            ProcessorTime.RunWithin(MaxSeconds, () => InCulture.Run(culture, () => Use(folder[entry])));
        }
        catch (FractalEngineException)
        {
            // The engine has said what is wrong.
        }

        var allocated = GC.GetAllocatedBytesForCurrentThread() - before;
        if (allocated > MaxAllocatedBytes)
        {
            throw new XunitException(string.Create(CultureInfo.InvariantCulture, $"{entry}: {allocated} bytes were allocated"));
        }
    }

    private static bool Use(string path)
    {
        if (path.EndsWith(".txt", StringComparison.Ordinal))
        {
            return PointsParser.Parse(SourceText.Read(path, path, 1 << 20)).Length >= 0;
        }

        var scene = AssetLoader.Load(path).Scene;
        foreach (var model in scene.Models.OfType<FractalModel>())
        {
            DistinctInstances.Count(model.Fractal);
        }

        Attempt(() => Query(scene));
        Attempt(() => DrawableScene.Prepare(scene, new RenderSettings { InstanceBudget = 10_000 }));
        Attempt(() => Trace(scene));
        return true;
    }

    // One use that a file does not allow must not hide what another one does.
    private static void Attempt(Action use)
    {
        try
        {
            use();
        }
        catch (FractalEngineException)
        {
            // The engine has said what is wrong.
        }
    }

    private static void Trace(LoadedScene scene)
    {
        const int Size = 8;
        var tracer = new PathTracer(scene, View.Of(scene, 1), Size, Size);
        tracer.AddSample(threads: 1);
        for (var i = 0; i < Size * Size; i++)
        {
            var radiance = tracer.RadianceAt(i % Size, i / Size);
            if (!radiance.IsFinite() || Math.Min(radiance.X, Math.Min(radiance.Y, radiance.Z)) < 0)
            {
                throw new XunitException($"the radiance of pixel {i} is {radiance}");
            }
        }
    }

    private static void Query(LoadedScene scene)
    {
        var collider = new SceneCollider(scene);
        foreach (var position in (Vector[])[Vector.Zero, new(1e3, -2, 3), new(-1e150, 1e150, 0)])
        {
            if (collider.TryFindClosest(position, double.PositiveInfinity, out var hit) && !(hit.Distance >= 0))
            {
                throw new XunitException($"the distance from {position} is {hit.Distance}");
            }
        }
    }
}
