using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Light;

/// <summary>
/// The white furnace: white balls of all materials under an even white sky, in which they can't be seen unless light is lost or created.
/// </summary>
internal static class FurnaceTable
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
    [
        "material", "roughness", "samples", "mean", "darkest_ring", "brightest_ring", "brightest_pixel", "drawn_darkest",
        "drawn_brightest",
    ];

    private const int Size = 64;
    private const int Rings = 8;

    // So far from white that drawn pixels may be brighter: sRGB.
    private static readonly Colour Sky = new(0.7, 0.7, 0.7);

    private static readonly (string Name, Material Material, double[] Roughnesses)[] Materials =
    [
        ("matt", new("m"), [1]),
        ("plastic", new("m") { Metalness = 0 }, [0.14, 0.3, 0.5, 0.7, 0.85, 1]),
        ("metal", new("m") { Metalness = 1 }, [0.14, 0.3, 0.5, 0.7, 0.85, 1]),
        ("half metal", new("m") { Metalness = 0.5 }, [0.14, 0.3, 0.5, 0.7, 0.85, 1]),
        ("Ks 0.04 Ns 1000", new("m") { Specular = new(0.04, 0.04, 0.04), SpecularExponent = 1000 }, [double.NaN]),
        ("Ks 0.5 Ns 20", new("m") { Specular = new(0.5, 0.5, 0.5), SpecularExponent = 20 }, [double.NaN]),
        ("glass", new("m") { RefractiveIndex = 1.5, Opacity = 0 }, [0, 0.3, 0.5, 0.7, 0.85, 1]),
    ];

    /// <summary>Measures each material at each roughness.</summary>
    /// <param name="ball">A ball of radius 1 about the origin.</param>
    /// <param name="isQuick">Whether few samples will do.</param>
    public static IEnumerable<object?[]> Measure(Mesh ball, bool isQuick)
    {
        var samples = isQuick ? 64 : 1024;
        foreach (var (name, material, roughnesses) in Materials)
        {
            foreach (var roughness in roughnesses)
            {
                yield return Measure(
                    name, double.IsNaN(roughness) || name == "matt" ? material : material with { Roughness = roughness }, ball, samples);
            }
        }
    }

    private static object?[] Measure(string name, Material material, Mesh ball, int samples)
    {
        var model = new MeshModel(ball.WithGroups([new(0, ball.FaceCount, "", "", "m", 0)], ["m.mtl"]))
        {
            SourcePath = "ball.obj",
            Materials = System.Collections.Immutable.ImmutableDictionary<string, Material>.Empty.Add("m", material),
        };
        var scene = new LoadedScene(
            new Scene { Sky = new ColourSky(Sky, Sky, Sky) }, [new PlacedModel(new SceneObject("ball", Transformation.Identity), model)]);
        var view = new View(Camera.Default with { Position = new(0, 0, -4) }, Projection.Orthographic) { OrthographicHeight = 2 };
        var tracer = new PathTracer(scene, view, Size, Size);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        var sky = Sky.ToLinearVector().X;
        // By the distance from the middle: a ring's mean has little noise.
        var (sums, counts, brightest) = (new double[Rings], new int[Rings], 0.0);
        for (var i = 0; i < Size * Size; i++)
        {
            var (x, y) = ((2.0 * (i % Size) + 1) / Size - 1, (2.0 * (i / Size) + 1) / Size - 1);
            var radius = Math.Sqrt((x * x) + (y * y));
            if (radius < 1)
            {
                var light = tracer.RadianceAt(i % Size, i / Size).X / sky;
                var ring = (int)(radius * Rings);
                sums[ring] += light;
                counts[ring]++;
                brightest = Math.Max(brightest, light);
            }
        }

        var rings = sums.Zip(counts, static (sum, count) => sum / count).ToArray();
        using var renderer = Renderer.Offscreen(Size, Size, new());
        var drawn = renderer.Draw(scene, view);
        var levels = Enumerable.Range(0, Size * Size).Select(i =>
            new Colour(drawn[i % Size, i / Size].Red / 255.0, 0, 0).ToLinearVector().X / sky).ToArray();
        return
        [
            name, material.Roughness, samples, Math.Round(sums.Sum() / counts.Sum(), 4), Math.Round(rings.Min(), 4),
            Math.Round(rings.Max(), 4), Math.Round(brightest, 4), Math.Round(levels.Min(), 3), Math.Round(levels.Max(), 3),
        ];
    }
}
