using System.Collections.Immutable;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Parsing;
using FractalEngine.Render.Images;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Light;

/// <summary>
/// How much noise has the light of very many lamps? The floor of a wood under a swarm of fireflies is traced, with lamps sampled by
/// importance and uniformly, for about the same processor time.
/// </summary>
internal static class LampTable
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
    [
        "lamps", "bytes", "ms_importance", "ms_uniform", "noise_importance", "noise_uniform", "noise_ratio",
    ];

    /// <summary>Sets and depths of the swarms: 10⁶, and 4³⁴ or 3·10²⁰ lamps.</summary>
    public static readonly (int Maps, int Depth)[] Swarms = [(10, 6), (4, 34)];

    /// <summary>Measures the noise under one swarm.</summary>
    /// <param name="swarm">Number of maps, and depth.</param>
    /// <param name="isQuick">Whether a smaller image with fewer samples will do.</param>
    /// <param name="folder">Receives the images; null for none.</param>
    public static object?[] Measure((int Maps, int Depth) swarm, bool isQuick, string? folder)
    {
        var (width, height, samples) = isQuick ? (32, 18, 8) : (64, 36, 32);
        var fractal = Fireflies(swarm.Maps, swarm.Depth);
        var scene = CreateScene(fractal, swarm.Maps, swarm.Depth);
        var view = View.Of(scene, (double)width / height);
        var truth = Trace(AreaLightSampling.ByImportance, 8 * samples, seed: 1, out _);
        var sampled = Trace(AreaLightSampling.ByImportance, samples, seed: 2, out var importanceTime);
        Trace(AreaLightSampling.Uniform, samples, seed: 2, out _);
        var uniform = Trace(AreaLightSampling.Uniform, samples, seed: 2, out var uniformTime);
        // As many samples as the time of the other image allows.
        var count = Math.Max(1, (int)Math.Ceiling(samples * importanceTime / uniformTime));
        uniform = Trace(AreaLightSampling.Uniform, count, seed: 3, out uniformTime);
        if (folder is not null)
        {
            truth.ToImage().SavePng(Path.Combine(folder, $"lamps-{swarm.Maps}-truth.png"));
            sampled.ToImage().SavePng(Path.Combine(folder, $"lamps-{swarm.Maps}-importance.png"));
            uniform.ToImage().SavePng(Path.Combine(folder, $"lamps-{swarm.Maps}-uniform.png"));
        }

        var sampler = new AreaLightSampler(scene, static (part, _) => part is FractalModel ? 1 : 0);
        var (noise, noiseOfUniform) = (Noise(sampled), Noise(uniform));
        return
        [
            fractal.InstanceCount!.Value.ToString("0", System.Globalization.CultureInfo.InvariantCulture), sampler.StorageBytes,
            Math.Round(importanceTime), Math.Round(uniformTime), Math.Round(noise, 4), Math.Round(noiseOfUniform, 4),
            Math.Round(noise / noiseOfUniform, 4),
        ];

        PathTracer Trace(AreaLightSampling sampling, int sampleCount, int seed, out double milliseconds)
        {
            var tracer = new PathTracer(scene, view, width, height, seed: seed) { AreaLightSampling = sampling, BounceLimit = 2 };
            tracer.AddSample();
            var start = Environment.CpuUsage.TotalTime;
            for (var i = 1; i < sampleCount; i++)
            {
                tracer.AddSample();
            }

            milliseconds = (Environment.CpuUsage.TotalTime - start).TotalMilliseconds * sampleCount / Math.Max(1, sampleCount - 1);
            return tracer;
        }

        // As a part of the mean radiance.
        double Noise(PathTracer tracer)
        {
            var (sum, mean) = (0.0, 0.0);
            for (var i = 0; i < width * height; i++)
            {
                sum += (tracer.RadianceAt(i % width, i / width) - truth.RadianceAt(i % width, i / width)).LengthSquared();
                mean += truth.RadianceAt(i % width, i / width).Length();
            }

            return Math.Sqrt(sum * width * height) / mean;
        }
    }

    /// <summary>A swarm of about the size 1, and flat, of octahedra that get smaller with the distances between them.</summary>
    private static Fractal Fireflies(int maps, int depth)
    {
        var random = new Random(5);
        var set = Enumerable.Range(0, maps).Select(i => new Transformation(
            new(random.NextDouble() - 0.5, 0.01 * (random.NextDouble() - 0.5), random.NextDouble() - 0.5),
            new(0, 360 * random.NextDouble(), 0), 0.42 * Vector.One)).ToArray();
        var lamp = Shapes.Octahedron();
        return Fractal.Of(lamp.WithGroups([new(0, lamp.FaceCount, "", "", "light", 0)], []))
            .Apply([Transformation.Identity with { Scale = 0.003 * Vector.One }]).Repeat(set, depth);
    }

    private static LoadedScene CreateScene(Fractal fractal, int maps, int depth)
    {
        // All swarms are as bright, whatever the sum of their areas.
        var glow = 100_000 / Math.Pow(maps * 0.42 * 0.42, depth);
        var light = new Material("light") { Emission = new(glow, 0.8 * glow, 0.3 * glow) };
        Mesh floor = new([-60, 0, -60, -60, 0, 60, 60, 0, 60, 60, 0, -60], [0, 1, 2, 0, 2, 3]);
        var tree = FractalFile.Read(Path.Combine(FractalCase.Assets, "fractals", "tree.fdo"));
        return LoadedScene.Of(new Scene
        {
            Lights = [new AmbientLight(Colour.Black, 0)],
            Background = Colour.Black,
            Camera = new(new(0, 0.7, -9), CameraFraming.LookRotation(new(0, -0.55, 1)), 40),
            Objects =
            [
                new(new MeshModel(floor)),
                new(new FractalModel(tree)) { Placement = new(new(-2, 0, -2), Vector.Zero, Vector.One) },
                new(new FractalModel(tree)) { Placement = new(new(3, 0, 1), new(0, 70, 0), 1.3 * Vector.One) },
                new(new FractalModel(fractal) { Materials = ImmutableDictionary<string, Material>.Empty.Add("light", light) })
                {
                    Placement = new(new(0, 2.3, 0), Vector.Zero, 100 * Vector.One),
                },
            ],
        });
    }
}
