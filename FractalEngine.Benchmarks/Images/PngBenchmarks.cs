using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Images;

namespace FractalEngine.Benchmarks.Images;

/// <summary>How long does it take to read and write a PNG file, beside SDL2_image?</summary>
[MemoryDiagnoser]
public class PngBenchmarks : IExtraMetrics
{
    private string _folder = "";
    private PixelImage _image = null!;

    /// <summary>Height in pixels: of a large square texture, and of a screenshot.</summary>
    [Params(4096, 1080)]
    public int Height { get; set; }

    private int Width => Height == 1080 ? 1920 : Height;

    private string Source => Path.Combine(_folder, "source.png");

    private string Target => Path.Combine(_folder, "target.png");

    [GlobalSetup]
    public void SetUp()
    {
        _folder = Directory.CreateTempSubdirectory("fractal-engine-").FullName;
        _image = new(Width, Height, CreatePhotograph(Width, Height));
        WriteManaged();
        File.Move(Target, Source, overwrite: true);
    }

    [GlobalCleanup]
    public void CleanUp() => Directory.Delete(_folder, recursive: true);

    /// <summary>Runs the baseline: libpng, without copying the pixels into memory of ours.</summary>
    [Benchmark(Baseline = true)]
    public void ReadSdl() => SdlPng.Load(Source);

    [Benchmark]
    public PixelImage ReadManaged()
    {
        using var stream = File.OpenRead(Source);
        return PngReader.Read(stream);
    }

    [Benchmark]
    public void WriteSdl() => SdlPng.Save(_image, Target);

    [Benchmark]
    public void WriteManaged()
    {
        using var stream = File.Create(Target);
        PngWriter.Write(_image, stream);
    }

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method)
    {
        var write = method switch
        {
            nameof(WriteSdl) => WriteSdl,
            nameof(WriteManaged) => WriteManaged,
            _ => (Action?)null,
        };
        write?.Invoke();
        double? megabytes = write is null ? null : new FileInfo(Target).Length / 1e6;
        CleanUp();
        return [new("megapixels_a_second", Width * Height / 1e6, IsPerSecond: true), new("megabytes", megabytes)];
    }

    /// <summary>Creates waves with noise, as in photographs. Every filter is best for some rows, and little repeats.</summary>
    private static byte[] CreatePhotograph(int width, int height)
    {
        var random = new Random(1);
        var pixels = new byte[4 * width * height];
        for (var i = 0; i < pixels.Length; i += 4)
        {
            var (y, x) = Math.DivRem(i / 4, width);
            var wave = 128 + (60 * Math.Sin((x * 0.013) + (y * 0.007))) + (40 * Math.Sin((y * 0.031) - (x * 0.003)));
            pixels[i] = (byte)(wave + random.Next(7));
            pixels[i + 1] = (byte)((wave * 0.8) + random.Next(5));
            pixels[i + 2] = (byte)(251 - wave + random.Next(4));
            pixels[i + 3] = byte.MaxValue;
        }

        return pixels;
    }
}
