using System.Diagnostics;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Measures how long the examples take from a save to the next frame, without the settle time and the drawing.</summary>
[Collection(GlTests.Name)]
public sealed class ReloadTimeTests : IDisposable
{
    // A busy machine takes longer sometimes, but not each time.
    private const int Attempts = 3;

    private static readonly TimeSpan Limit = TimeSpan.FromSeconds(0.5);

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Reload_OfEachFileOfTheExamples_TakesAtMostHalfASecond()
    {
        foreach (var file in Directory.EnumerateFiles(Repository.Full("assets"), "*", SearchOption.AllDirectories))
        {
            var target = _folder[Path.GetRelativePath(Repository.Full("assets"), file)];
            Directory.CreateDirectory(Path.GetDirectoryName(target)!);
            File.Copy(file, target);
        }

        using var context = GlTests.OpenContext();
        foreach (var path in Directory.EnumerateFiles(_folder["scenes"], "*.sdo"))
        {
            var cache = new AssetCache();
            var preparation = Prepare(path, cache, null, out _);
            using var renderer = new SceneRenderer(context, preparation.Scene);
            foreach (var changed in cache.Files.Where(static file => file.Value.Length > 0).Select(static file => file.Key))
            {
                var best = Enumerable.Range(0, Attempts).Select(_ =>
                {
                    File.SetLastWriteTimeUtc(changed, DateTime.UtcNow);
                    var start = Stopwatch.GetTimestamp();
                    preparation = Prepare(path, cache, preparation.Scene, out var readCount);
                    renderer.Replace(preparation.Scene);
                    // The scene is read each time, and only the changed file besides.
                    Assert.InRange(readCount, 1, 2);
                    return Stopwatch.GetElapsedTime(start);
                }).Min();
                Assert.True(best < Limit, $"{Path.GetFileName(path)} after {Path.GetFileName(changed)}: {best.TotalSeconds:F2} s");
            }
        }
    }

    private static ScenePreparation Prepare(string path, AssetCache cache, DrawableScene? previous, out int readCount)
    {
        var file = AssetLoader.Load(path, null, null, cache);
        readCount = cache.ReadCount;
        var preparation = new ScenePreparation(file.Scene, new(), previous);
        preparation.PrepareAll(null, CancellationToken.None);
        return preparation;
    }
}
