using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>Light of emissive faces, against integrals over all faces of expansions, and paths that meet them by themselves.</summary>
public class AreaLightTests
{
    private const int Size = 6;
    private const int Batches = 10;

    private static readonly Colour Glow = new(3, 2, 1);

    /// <summary>Names and depths of the fractals of <see cref="Lamps"/>.</summary>
    public static TheoryData<string, int, bool> Cases => new()
    {
        { "mesh", 0, false }, { "mesh", 0, true }, { "similar", 1, false }, { "similar", 4, false }, { "similar", 4, true },
        { "skewed", 3, false }, { "skewed", 3, true }, { "leaves", 3, false }, { "leaves", 4, true }, { "calls", 2, false },
    };

    [Theory]
    [MemberData(nameof(Cases))]
    public void AddSample_UnderLamps_HasTheMeanOfTheIntegralOverTheExpansion(string name, int depth, bool isGlossy)
    {
        var (lamps, expanded) = Lamps(name, depth);
        // The first reflection only, of light that comes straight from a lamp.
        var expected = Integrate(expanded, isGlossy);
        var (mean, error) = Mean(lamps, isGlossy, AreaLightSampling.ByImportance, bounces: 1, samples: 24);
        var (uniform, uniformError) = Mean(lamps, isGlossy, AreaLightSampling.Uniform, bounces: 1, samples: 24);

        // The quadrature has points of a 64th of each face.
        Assert.InRange(mean, expected - (3 * error) - (0.004 * expected), expected + (3 * error) + (0.004 * expected));
        Assert.InRange(
            uniform, expected - (3 * uniformError) - (0.004 * expected), expected + (3 * uniformError) + (0.004 * expected));
        Assert.InRange(error, 0, 0.03 * mean);
    }

    [Theory]
    [InlineData("similar", 3)]
    [InlineData("skewed", 2)]
    [InlineData("leaves", 3)]
    public void AddSample_OfLampsOfAFractal_HasTheMeanOfPathsThroughItsExpansion(string name, int depth)
    {
        // All reflections, those between the lamps and the floor too.
        var (lamps, expanded) = Lamps(name, depth);
        var (mean, error) = Mean(lamps, false, AreaLightSampling.ByImportance, PathTracer.MaxBounces, samples: 32);
        var (expected, expectedError) = Mean(expanded, false, AreaLightSampling.None, PathTracer.MaxBounces, samples: 256);

        Assert.InRange(Math.Abs(mean - expected), 0, 3 * Math.Sqrt((error * error) + (expectedError * expectedError)));
        Assert.InRange(expectedError, 0, 0.05 * expected);
    }

    [Theory]
    [InlineData("twice")]
    [InlineData("glass")]
    [InlineData("translucent")]
    [InlineData("lid")]
    public void AddSample_UnderALamp_HasTheMeanOfPathsThatMeetIt(string name)
    {
        var lamp = Object(Shapes.Cube(), Colour.Black, Glow, name == "translucent" ? 0.5 : 1);
        var other = name switch
        {
            // Faces at the same place shine once.
            "twice" => lamp,
            "glass" => Object(Square(5, 0.3), Colour.Black, default, 0.4),
            "lid" => Object(Square(0.2, 0.2), Colour.Black, default),
            _ => Object(Square(0.1, 9), Colour.Black, default),
        };
        var (mean, error) = Mean([lamp, other], false, AreaLightSampling.ByImportance, 2, samples: 48);
        var (expected, expectedError) = Mean([lamp, other], false, AreaLightSampling.None, 2, samples: 512);

        Assert.InRange(Math.Abs(mean - expected), 0, 3 * Math.Sqrt((error * error) + (expectedError * expectedError)));
        Assert.InRange(expectedError, 0, 0.02 * expected);
        Assert.InRange(error, 0, 0.03 * mean);
    }

    [Fact]
    public void AddSample_WithASection_HasTheMeanOfPathsThatMeetWhatIsLeft()
    {
        var (lamps, expanded) = Lamps("similar", 2);
        var section = new SectionPlane(Vector.I, 0.1);
        var (mean, error) = Mean(lamps, false, AreaLightSampling.ByImportance, 2, samples: 48, section);
        var (expected, expectedError) = Mean(expanded, false, AreaLightSampling.None, 2, samples: 256, section);

        Assert.InRange(Math.Abs(mean - expected), 0, 3 * Math.Sqrt((error * error) + (expectedError * expectedError)));
    }

    [Fact]
    public void AddSample_OfALampThatIsSeen_ShowsItWhole()
    {
        var tracer = Trace([Object(Shapes.Sphere(2), Colour.Black, Glow)], new(new(0, 0, -4), Vector.Zero, 5), 4);
        Assert.Equal(Glow.Green, tracer.RadianceAt(3, 3).Y, 1e-12);
    }

    [Fact]
    public void AddSample_UnderManyLamps_Ends()
    {
        // 3⁴² lamps whose areas sum to a hundred thousandth of the first one's: brighter by that.
        var maps = new[] { new Vector(0.5, 0, 0), new(-0.5, 0, 0), new(0, 0.5, 0) }
            .Select(static move => new Transformation(move, Vector.Zero, 0.5 * Vector.One));
        var bright = Math.Pow(0.75, -42);
        var lamps = FractalOf(Fractal.Of(WithGroup(Shapes.Tetrahedron())).Repeat(maps, 42), Colour.Black, new(bright, bright, bright));
        var (mean, error) = Mean([lamps], false, AreaLightSampling.ByImportance, 1, samples: 24);
        Assert.InRange(mean, 0.01, 10);
        Assert.InRange(error, 0, 0.05 * mean);
    }

    /// <summary>Lamps of a fractal, and the same of meshes alone.</summary>
    private static (SceneObject[] Fractal, SceneObject[] Expanded) Lamps(string name, int depth)
    {
        var half = 0.5 * Vector.One;
        Transformation[] turned =
        [
            new(new(0.8, 0.1, 0), new(10, 20, 30), half), new(new(-0.7, 0.2, 0.3), new(0, 50, 0), 0.6 * Vector.One),
            new(new(0, 0.9, 0.1), new(80, 0, 10), 0.4 * Vector.One),
        ];
        Transformation[] skewed = [.. turned.Select(static map => map with { Scale = map.Scale.Stretch(new(1.2, 0.7, 0.9)) })];
        var lamp = WithGroup(Shapes.Tetrahedron());
        var branch = WithGroup(Shapes.Box(new(new(-0.05, -0.5, -0.05), new(0.05, 0.5, 0.05))));
        if (name == "mesh")
        {
            return ([Object(lamp, Colour.White, Glow)], [Object(lamp, Colour.White, Glow)]);
        }

        var fractal = name switch
        {
            "similar" => Fractal.Of(lamp).Repeat(turned, depth),
            "skewed" => Fractal.Of(lamp).Repeat(skewed, depth),
            "leaves" => Fractal.Recurse(Fractal.Of(lamp), depth, self => self.Apply(turned) + Fractal.Of(branch)),
            _ => Fractal.Recurse(Fractal.Of(lamp), depth, self => self.Apply(turned) + Fractal.Recurse(
                Fractal.Of(branch), 2, inner => inner.Apply(turned[..2]) + Fractal.Of(lamp)).Apply(turned[1..])),
        };
        Colour EmissionOf(Mesh mesh) => ReferenceEquals(mesh, branch) ? Colour.Black : Glow;
        return ([new(new FractalModel(fractal)
            {
                MaterialsByMesh = [.. fractal.BaseMeshes.Select(mesh => MaterialOf(Colour.White, EmissionOf(mesh), 1))],
                Materials = MaterialOf(Colour.White, Glow, 1),
            }) { Placement = Place }],
            [.. fractal.ByMesh.Select((part, index) => Object(
                part.Flatten(1_000_000), Colour.White, EmissionOf(fractal.BaseMeshes[index])) with { Placement = Place })]);
    }

    private static Transformation Place => new(new(0.3, 0.6, 0.1), new(10, 20, 5), 0.8 * Vector.One);

    private static SceneObject Floor(bool isGlossy) => new(new MeshModel(WithGroup(Square(30, -1)))
    {
        Materials = ImmutableDictionary<string, Material>.Empty.Add("matt", new Material("matt")
        {
            Diffuse = new(0.7, 0.7, 0.7),
            Specular = isGlossy ? new(0.5, 0.5, 0.5) : Colour.Black,
            SpecularExponent = 60,
        }),
    });

    // Obliquely to a point of the floor beside the lamps.
    private static Camera Eye => new(new(-4, 1, -0.4), CameraFraming.LookRotation(new Vector(5, -2, 0.1)), 0.02);

    private static SceneObject FractalOf(Fractal fractal, Colour colour, Colour emission) =>
        new(new FractalModel(fractal) { Materials = MaterialOf(colour, emission, 1) });

    private static SceneObject Object(Mesh mesh, Colour colour, Colour emission, double opacity = 1) =>
        new(new MeshModel(WithGroup(mesh)) { Materials = MaterialOf(colour, emission, opacity) });

    private static ImmutableDictionary<string, Material> MaterialOf(Colour colour, Colour emission, double opacity) =>
        ImmutableDictionary<string, Material>.Empty.Add(
            "matt", new Material("matt") { Diffuse = colour, Emission = emission, Opacity = opacity });

    private static Mesh WithGroup(Mesh mesh) =>
        mesh.Groups.IsEmpty ? mesh.WithGroups([new(0, mesh.FaceCount, "", "", "matt", 0)], []) : mesh;

    private static Mesh Square(double half, double height) => new(
        [-half, height, -half, -half, height, half, half, height, half, half, height, -half], [0, 1, 2, 0, 2, 3]);

    private static (double Mean, double Error) Mean(
        IEnumerable<SceneObject> lamps, bool isGlossy, AreaLightSampling sampling, int bounces, int samples, SectionPlane? section = null)
    {
        var scene = SceneOf([Floor(isGlossy), .. lamps], Eye);
        double[] means = [.. Enumerable.Range(0, Batches).Select(seed =>
        {
            var tracer = new PathTracer(scene, View.Of(scene, 1) with { Section = section }, Size, Size, seed: seed)
            {
                BounceLimit = bounces,
                AreaLightSampling = sampling,
            };
            for (var i = 0; i < samples; i++)
            {
                tracer.AddSample(1);
            }

            return Enumerable.Range(0, Size * Size).Average(i => tracer.RadianceAt(i % Size, i / Size).Y);
        })];
        var mean = means.Average();
        return (mean, Math.Sqrt(means.Sum(one => (one - mean) * (one - mean)) / (Batches * (Batches - 1))));
    }

    private static PathTracer Trace(SceneObject[] objects, Camera camera, int samples)
    {
        var scene = SceneOf([.. objects], camera);
        var tracer = new PathTracer(scene, View.Of(scene, 1), Size, Size);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample(1);
        }

        return tracer;
    }

    private static LoadedScene SceneOf(ImmutableArray<SceneObject> objects, Camera camera) => LoadedScene.Of(new Scene
    {
        Lights = [new AmbientLight(Colour.Black, 0)],
        Background = Colour.Black,
        Camera = camera,
        Objects = objects,
    });

    [Fact]
    public void Ray_ThatKeepsLamps_IsALineForObjectsThatShineOnly()
    {
        var footprint = new RayFootprint(0.2, 0);
        var ray = new Ray(new(0.37, 0.31, -3), Vector.K);
        foreach (var emission in (Colour[])[Colour.Black, Colour.White])
        {
            var menger = RenderScenes.Menger(6);
            var mesh = menger.Mesh.WithGroups([new(0, menger.Mesh.FaceCount, "", "", "m", 0)], ["m.mtl"]);
            var model = new FractalModel(new(menger.Fractal.Description, mesh))
            {
                SourcePath = "menger.fdo",
                Materials = ImmutableDictionary<string, Material>.Empty.Add("m", new("m") { Emission = emission }),
            };
            var caster = new SceneRayCaster(RenderScenes.Scene(new(), (model, Transformation.Identity, null)));
            var context = new QueryContext();
            Assert.True(caster.TryFindNearest(ray, context, out var line));
            Assert.True(caster.TryFindNearest(ray, context, out var wide, footprint: footprint));
            Assert.True(caster.TryFindNearest(ray, context, out var kept, footprint: footprint with { KeepsLamps = true }));

            Assert.NotEqual(line.InstanceMap, wide.InstanceMap);
            Assert.Equal(emission == Colour.White ? line.InstanceMap : wide.InstanceMap, kept.InstanceMap);
        }
    }

    /// <summary>Adds up what each small part of each emissive face sends to the point of the floor that the eye sees.</summary>
    private static double Integrate(SceneObject[] expanded, bool isGlossy)
    {
        const int steps = 8;
        var scene = SceneOf([Floor(isGlossy), .. expanded], Eye);
        var caster = new SceneRayCaster(scene);
        var (_, _, forward) = Eye.LocalAxes;
        var seen = caster.FindNearest(new(Eye.Position, forward))!.Value;
        Assert.Equal(0, seen.ObjectIndex);
        var material = TracedMaterial.Create(
            new TextureCache(ImmutableArray.CreateBuilder<string>(), true, []).GetMaterial(scene.Objects[0].Model.Materials["matt"]));
        var surface = new TracedSurface(seen.Point, Vector.J, Vector.J, material.BaseColour!.Value, material.Gloss, Vector.Zero, 1);
        var sum = 0.0;
        foreach (var placed in scene.Objects.Skip(1))
        {
            var radiance = placed.Model.Materials["matt"].Emission.Green;
            for (var face = 0; radiance > 0 && face < placed.Model.Mesh.FaceCount; face++)
            {
                var (a, b, c) = placed.Model.Mesh.Face(face);
                (a, b, c) = (placed.ObjectToWorld * a, placed.ObjectToWorld * b, placed.ObjectToWorld * c);
                var cross = Vector.Cross(b - a, c - a);
                for (var i = 0; i < steps; i++)
                {
                    for (var j = 0; j < steps - i; j++)
                    {
                        Add(i + (1.0 / 3), j + (1.0 / 3));
                        if (i + j < steps - 1)
                        {
                            Add(i + (2.0 / 3), j + (2.0 / 3));
                        }
                    }
                }

                void Add(double u, double v)
                {
                    var toLight = a + (u / steps * (b - a)) + (v / steps * (c - a)) - seen.Point;
                    var distance = toLight.Length();
                    toLight /= distance;
                    var origin = seen.Point + (1e-7 * Vector.J);
                    if (toLight.Y > 0 && !caster.HitsAny(new(origin, toLight), null, 0, distance * (1 - 1e-5)))
                    {
                        var facing = 0.5 / (steps * steps) * Math.Abs(Vector.Dot(cross, toLight));
                        sum += radiance * facing / (distance * distance * Math.PI) * Reflection.Evaluate(in surface, -forward, toLight).Y;
                    }
                }
            }
        }

        return sum;
    }
}
