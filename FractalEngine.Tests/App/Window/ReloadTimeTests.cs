using System.Diagnostics;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>
/// Tests what the examples take from a save to the next frame, without the settle time and the drawing: the files that are read, and in the
/// soak the time.
/// </summary>
[Collection(TimedTests.Name)]
public sealed class ReloadTimeTests : IDisposable
{
    // A busy machine takes longer sometimes, but not each time.
    private const int Attempts = 3;

    // One of so many files that are opened alone is tried in the default run.
    private const int SampleStride = 5;

    private static readonly TimeSpan Limit = TimeSpan.FromSeconds(0.5);

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Reload_OfEachFileOfTheScenes_ReadsWhatHasChanged() => Reload(FilesOf("scenes/*.sdo"), attempts: 1);

    [SkippableFact]
    public void Reload_OfSomeExamplesFractalsAndModels_ReadsWhatHasChanged() =>
        Reload(FilesOpenedAlone().Where(static (_, index) => index % SampleStride == 0), attempts: 1);

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Reload_OfEachExample_TakesAtMostHalfASecond()
    {
        var slow = Reload(FilesOf("scenes/*.sdo").Concat(FilesOpenedAlone()), Attempts).Where(static reload => !(reload.Time < Limit));
        Assert.Equal([], slow.Select(static reload => $"{reload.File} after {reload.Changed}: {reload.Time.TotalSeconds:F2} s"));
    }

    private static IEnumerable<string> FilesOpenedAlone() =>
    [
        .. FilesOf("examples/*.sdo"), .. FilesOf("examples/*.fdo"), .. FilesOf("fractals/*.fdo"), .. FilesOf("fractals/*.obj"),
        .. FilesOf("models/*.obj"), .. FilesOf("scenes/*.obj"),
    ];

    /// <summary>Paths below the folder of examples, in a fixed order.</summary>
    private static IEnumerable<string> FilesOf(string pattern) =>
        Directory.GetFiles(Repository.Full("assets"), pattern)
            .Select(static file => Path.GetRelativePath(Repository.Full("assets"), file)).Order(StringComparer.Ordinal);

    private (string File, string Changed, TimeSpan Time)[] Reload(IEnumerable<string> files, int attempts)
    {
        foreach (var file in Directory.EnumerateFiles(Repository.Full("assets"), "*", SearchOption.AllDirectories))
        {
            var target = _folder[Path.GetRelativePath(Repository.Full("assets"), file)];
            Directory.CreateDirectory(Path.GetDirectoryName(target)!);
            File.Copy(file, target);
        }

        using var context = GlTests.OpenContext();
        return [.. files.SelectMany(file => Reload(context, file, attempts))];
    }

    /// <summary>Measures the reloads of a file after each file that it is made of has changed.</summary>
    private IEnumerable<(string File, string Changed, TimeSpan Time)> Reload(OffscreenContext context, string file, int attempts)
    {
        var path = _folder[file];
        var cache = new AssetCache();
        var preparation = Prepare(path, cache, null, out _);
        using var renderer = new SceneRenderer(context, preparation.Scene);
        foreach (var changed in cache.Files.Where(static entry => entry.Value.Length > 0).Select(static entry => entry.Key).ToArray())
        {
            var best = Enumerable.Range(0, attempts).Select(_ =>
            {
                File.SetLastWriteTimeUtc(changed, DateTime.UtcNow);
                var start = Stopwatch.GetTimestamp();
                preparation = Prepare(path, cache, preparation.Scene, out var readCount);
                renderer.Replace(preparation.Scene);
                // A description is read each time, a mesh only when it has changed; and only the changed file besides.
                var isRead = Path.GetExtension(file) != ".obj" || Path.GetFileName(file) == Path.GetFileName(changed);
                Assert.InRange(readCount, isRead ? 1 : 0, 2);
                return Stopwatch.GetElapsedTime(start);
            }).Min();
            yield return (file, Path.GetFileName(changed), best);
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
