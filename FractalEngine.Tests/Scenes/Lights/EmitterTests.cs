using System.Reflection;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Scenes.Lights;

/// <summary>What lights bring to points, by the statement of Core and by that of the shaders.</summary>
[Collection(GlTests.Name)]
public sealed class EmitterTests
{
    // Per light: the light, then the direction towards it.
    private const int NumberCount = 6;

    private const string Vertex = """
        #version 330 core
        void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
        """;

    // A row for each light, and a pixel for each number, whose four bytes are those of the float.
    private const string Fragment = """
        #version 330 core
        #define SURFACE_LIGHTS
        #include "lighting.glsl"
        uniform vec3 normal;
        out vec4 pixel;
        void main()
        {
            vec3 toLight;
            vec3 light = incomingLight(lights[int(gl_FragCoord.y)], vec3(0.0), normal, toLight);
            float numbers[6] = float[](light.r, light.g, light.b, toLight.x, toLight.y, toLight.z);
            uint bits = floatBitsToUint(numbers[int(gl_FragCoord.x)]);
            pixel = vec4(uvec4(bits, bits >> 8, bits >> 16, bits >> 24) & 255u) / 255.0;
        }
        """;

    [SkippableFact]
    public void Incoming_OfRandomLights_IsThatOfTheShaders()
    {
        var (lit, dark, weakened) = (0, 0, 0);
        AskShaders(100, RandomLight, (light, camera, _, incoming, towards) =>
        {
            var emitter = light.ToEmitter()!;
            var expected = emitter.Incoming(camera, out var toLight, out var distance);
            // Rounding of floats, times the slopes of the falloff at its end and of the edge of a narrow cone.
            var tolerance = (2e-5 * expected.MaxAbsComponent()) + (3e-4 * Bright(emitter, distance));
            Assert.True((incoming - expected).MaxAbsComponent() <= tolerance, $"{light} from {camera}: {incoming} instead of {expected}");
            Assert.True((towards - toLight).MaxAbsComponent() < 2e-6);
            dark += expected == Vector.Zero ? 1 : 0;
            lit += expected == Vector.Zero ? 0 : 1;
            weakened += emitter.HasCone && -Vector.Dot(toLight, emitter.Axis) is var cosine
                && cosine > emitter.EdgeCosine && cosine < emitter.BrightCosine ? 1 : 0;
        });
        Assert.True(lit > 200 && dark > 20 && weakened > 5, $"{lit} lit, {dark} dark, {weakened} at an edge");
    }

    [SkippableFact]
    public void Incoming_OfRandomSurfaces_HasTheCosineOfTheIntegralOverThem()
    {
        var (partly, tiny) = (0, 0);
        AskShaders(8, RandomSurface, (light, camera, normal, incoming, towards) =>
        {
            var expected = LampIntegral.Irradiance((PointLight)light, camera, normal, 120);
            var towardsMiddle = (((PointLight)light).Position - camera).UnitVector();
            var straight = LampIntegral.Irradiance((PointLight)light, camera, towardsMiddle, 120);
            var found = incoming.Y * Math.Max(0, Vector.Dot(normal, towards));
            Assert.True(
                Math.Abs(found - expected) <= (2e-3 * expected) + (1e-3 * straight),
                $"{light} from {camera}: {found} instead of {expected}");
            partly += expected > 0 && expected < 0.1 * straight ? 1 : 0;
            tiny += straight < 1e-2 * LampIntegral.RadianceOf((PointLight)light) ? 1 : 0;
        });
        Assert.True(partly > 5 && tiny > 20, $"{partly} partly seen, {tiny} tiny");
    }

    /// <summary>Has the shaders compute what lights bring to a camera that is a face with a normal, 16 at a time.</summary>
    private static void AskShaders(
        int cases, Func<int, Vector, Random, Light> create, Action<Light, Vector, Vector, Vector, Vector> check)
    {
        using var context = new SharedContext();
        using var program = new ShaderProgram(
            context.Resources, ("test.vert", Vertex),
            ("test.frag", Fragment.Replace("#include \"lighting.glsl\"", EmbeddedResource.ReadText("Shaders/lighting.glsl"),
                StringComparison.Ordinal)));
        using var target = new Framebuffer(
            context.Resources, "numbers", NumberCount, LightBlock.MaxLights, samples: 0);
        using var vertices = new VertexArray(context.Resources, "none");
        program.BindBlock("LightBlock", GlState.LightBinding);
        Seeded.Run(cases, random =>
        {
            var camera = random.Vector(100);
            var normal = random.Direction();
            Light[] lights = [.. Enumerable.Range(0, LightBlock.MaxLights).Select(i => create(i, camera, random))];
            var scene = LoadedScene.Of(new Scene { Lights = [.. lights] });
            using var block = new LightBlock(context.Resources, scene);
            block.Bind(GlState.LightBinding, camera, 1, new() { Background = Colour.Black });
            target.Bind();
            program.Use();
            program.Set("normal", normal);
            vertices.Bind();
            DrawTriangle();
            var bytes = new byte[NumberCount * LightBlock.MaxLights * 4];
            target.ReadPixels(bytes);
            for (var i = 0; i < lights.Length; i++)
            {
                var numbers = Enumerable.Range(0, NumberCount)
                    .Select(number => (double)BitConverter.ToSingle(bytes, 4 * ((i * NumberCount) + number))).ToArray();
                check(
                    lights[i], camera, normal, new(numbers[0], numbers[1], numbers[2]), new(numbers[3], numbers[4], numbers[5]));
            }
        });
    }

    [Fact]
    public void Incoming_OfAPointLight_IsItsIntensityAtATenthOfTheRange()
    {
        var emitter = new PointLight(new(0, 3, 0), Colour.White, 0.7, 30).ToEmitter()!;
        var light = emitter.Incoming(Vector.Zero, out var toLight, out var distance);
        Assert.Equal(0.7, light.X, 1e-12);
        Assert.Equal((Vector.J, 3.0), (toLight, distance));
        Assert.Equal(Vector.Zero, emitter.Incoming(new(0, -27, 0), out _, out _));
        Assert.NotEqual(Vector.Zero, emitter.Incoming(new(0, -26.9, 0), out _, out _));
        Assert.Equal((true, false, 30.0), (emitter.NeedsCube, emitter.HasCone, emitter.Range));
    }

    [Fact]
    public void ToEmitter_OfEachKind_TellsItsShape()
    {
        Assert.Null(new AmbientLight(Colour.White, 1).ToEmitter());
        var sun = new SunLight(new(0, -2, 0), Colour.White, 1, 3).ToEmitter()!;
        Assert.Equal((null, -Vector.J, 3.0, false), (sun.Position, sun.Axis, sun.Diameter, sun.NeedsCube));
        Assert.Equal(Vector.One, sun.Incoming(Vector.I, out var toLight, out var distance));
        Assert.Equal((Vector.J, double.PositiveInfinity), (toLight, distance));
        var spot = new SpotLight(Vector.Zero, new(0, 0, 5), 60, Colour.White, 1, 10).ToEmitter()!;
        Assert.Equal((Vector.K, true, false), (spot.Axis, spot.HasCone, spot.NeedsCube));
        Assert.True(new SpotLight(Vector.Zero, Vector.K, 110, Colour.White, 1, 10).ToEmitter()!.NeedsCube);
        Assert.Equal(Vector.Zero, spot.Incoming(new(0.58, 0, 1), out _, out _));
        Assert.Equal("Spot", new SpotLight(Vector.Zero, Vector.K, 110, Colour.White, 1, 10).Kind);
    }

    /// <summary>The light at the middle of what the emitter lights, at the same distance.</summary>
    private static double Bright(Emitter emitter, double distance) => emitter.Position is null ? 0
        : new Emitter(emitter.Radiance, Vector.Zero, emitter.Range).Incoming(distance * Vector.I, out _, out _).MaxAbsComponent()
            + (1e-3 * emitter.Radiance.MaxAbsComponent());

    private static Light RandomLight(int index, Vector camera, Random random)
    {
        var colour = new Colour(random.NextDouble(), random.NextDouble(), random.NextDouble());
        var range = Math.Pow(10, random.Between(-1, 2));
        // From far within the range to beyond its end.
        var position = camera + (range * Math.Pow(10, random.Between(-2, 0.1)) * random.Direction());
        var direction = random.Direction();
        var towardsCamera = (camera - position).UnitVector() + (random.Between(0, 1.5) * direction);
        return (index % 4) switch
        {
            0 => new DirectionalLight(direction, colour, random.Between(0, 2)),
            1 => new SunLight(direction, colour, random.Between(0, 2)),
            2 => new PointLight(position, colour, random.Between(0, 2), range),
            _ => new SpotLight(position, towardsCamera, random.Between(20, 170), colour, random.Between(0, 2), range),
        };
    }

    /// <summary>A ball or a quad at any distance, from within twice its size to a thousand times that.</summary>
    private static PointLight RandomSurface(int index, Vector camera, Random random)
    {
        var towards = random.Direction();
        var size = Math.Pow(10, random.Between(-1, 1));
        var position = camera + (size * Math.Pow(10, random.Between(0.05, 3)) * towards);
        return index % 2 == 0
            ? new BallLight(position, size, Colour.White, 1, 1e7)
            : new QuadLight(
                position, random.Direction() - towards, 2 * size, 2 * size * random.Between(0.1, 1), Colour.White, 1, 1e7,
                random.Between(0, 180));
    }

    /// <summary>Draws a triangle by the OpenTK that Render has: the tests don't reference it.</summary>
    private static void DrawTriangle()
    {
        var gl = typeof(ShaderProgram).Assembly.GetReferencedAssemblies()
            .Where(static name => name.Name!.StartsWith("OpenTK", StringComparison.Ordinal))
            .Select(static name => Assembly.Load(name).GetType("OpenTK.Graphics.OpenGL4.GL")).First(static type => type is not null)!;
        var draw = gl.GetMethods().First(static method =>
            method.Name == "DrawArrays" && method.GetParameters() is [{ ParameterType.Name: "PrimitiveType" }, _, _]);
        draw.Invoke(null, [Enum.Parse(draw.GetParameters()[0].ParameterType, "Triangles"), 0, 3]);
    }
}
