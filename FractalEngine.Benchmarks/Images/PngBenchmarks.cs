using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;

namespace FractalEngine.Benchmarks.Images;

/// <summary>How long does it take to read and write a PNG file, beside the decompression of its pixels?</summary>
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
        Write();
        File.Move(Target, Source, overwrite: true);
    }

    [GlobalCleanup]
    public void CleanUp() => Directory.Delete(_folder, recursive: true);

    /// <summary>Runs the baseline: checksums and decompression alone, which no reader does without.</summary>
    [Benchmark(Baseline = true)]
    public string? Check()
    {
        var file = File.ReadAllBytes(Source);
        using var stream = new MemoryStream(file);
        return PngCheck.FindFault(file, ImageHeader.Read(stream, isTga: false)!.Value);
    }

    [Benchmark]
    public PixelImage Read() => ImageFile.Load(Source);

    [Benchmark]
    public void Write()
    {
        using var stream = File.Create(Target);
        PngWriter.Write(_image, stream);
    }

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method)
    {
        double? megabytes = null;
        if (method == nameof(Write))
        {
            Write();
            megabytes = new FileInfo(Target).Length / 1e6;
        }

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
