using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Tests.Support;
using FsCheck;
using FsCheck.Fluent;

namespace FractalEngine.Tests.Parsing.Sdo;

public class SceneWriterTests
{
    private const string Commented = """
        # A scene

        c   (1,2,3)   (0,0,0)   60
          # two things
        o "a.obj" ((1.50, 0, 0), #, #)   name "first"
        o "b.fdo"    #

        light ambient (1 1 1)
        # the end
        """;

    private static readonly Gen<Vector> AnyVector = Laws.AnyFinite.Three().Select(t => new Vector(t.Item1, t.Item2, t.Item3));
    private static readonly Gen<double> Positive = Laws.AnyFinite.Where(number => number > 0);
    private static readonly Gen<double> Unit = Gen.OneOf(Gen.Elements(0.0, -0.0, 1.0, double.Epsilon, 1.0 / 3), Gen.Choose(0, int.MaxValue)
        .Select(i => (double)i / int.MaxValue));
    private static readonly Gen<double> NotNegative = Gen.OneOf(Gen.Elements(0.0, -0.0), Laws.AnyFinite.Select(Math.Abs));
    private static readonly Gen<Colour> Colours = Unit.Three().Select(t => new Colour(t.Item1, t.Item2, t.Item3));
    private static readonly Gen<Palette> Palettes = Gen.OneOf(
        Gen.Elements(NamedPalettes.All.AsEnumerable()), Colours.Three().Select(t => Palette.OfEven(t.Item1, t.Item2, t.Item3)),
        Colours.Two().Select(t => Palette.OfEven(t.Item1, t.Item2)),
        Colours.Three().Zip(Unit.Three(), (t, p) => new Palette([.. new[] { p.Item1, p.Item2, p.Item3 }.Order().Zip(
            new[] { t.Item1, t.Item2, t.Item3 }, static (position, colour) => new PaletteStop(position, colour))])),
        Colours.Two().Select(t => new Palette([new(0.1, t.Item1), new(0.2, t.Item2)])));

    private static readonly Gen<Vector> Directions = AnyVector.Where(v => v != Vector.Zero);
    private static readonly Gen<double> Factor = Laws.AnyFinite.Where(number => Math.Abs(number) is > 1e-100 and < 1e100);
    private static readonly Gen<Transformation> Placements = Gen.Elements(true, false).Three().SelectMany(given =>
        AnyVector.Two().Zip(Factor.Three(), (vectors, scale) => new Transformation(
            given.Item1 ? vectors.Item1 : Vector.Zero, given.Item2 ? vectors.Item2 : Vector.Zero, given.Item3
            ? new(scale.Item1, scale.Item2, scale.Item3)
            : Vector.One)));

    private static readonly Gen<string?> Names = Gen.Elements(null, "", "x", "with blanks # and (brackets)", "größer, 2");

    private static readonly Gen<SceneObject> Plain = Gen.Elements("a.obj", "../some folder/b.fdo")
        .Zip(Placements, (file, placement) => new SceneObject(file, placement))
        .Zip(Names, (declared, name) => declared with { Name = name })
        .Zip(Gen.OneOf(Gen.Constant<Colour?>(null), Colours.Select(colour => (Colour?)colour)),
        (declared, colour) => declared with { Colour = colour })
        .Zip(Palettes.Zip(Gen.Elements(Enum.GetValues<GradientKind>())),
        (declared, g) => declared with
        {
            Gradient = g.Item2 == GradientKind.None ? null
                : g.Item1 is { Name: null, IsEven: false, Stops.Length: 2 } two ? new(g.Item2, two.Stops[0].Colour)
                : Gradient.Of(g.Item2, g.Item1) with { Roughness = new(g.Item1.Stops[0].Position, 1), Glow = new(-0.0, 5) },
        });

    private static readonly Gen<SceneObject> Bodies = Plain.Zip(Unit)
        .Zip(AnyVector.Zip(Positive), (o, b) => (SceneObject)new PhysicsObject(o.Item1.File!, o.Item1.Placement, o.Item2)
        {
            Name = o.Item1.Name, Colour = o.Item1.Colour, Gradient = o.Item1.Gradient, Velocity = b.Item1, Mass = b.Item2,
            Collider = (ColliderKind)(b.Item2.GetHashCode() & 3),
        }).Zip(NotNegative.Three().Zip(Gen.Elements(1, double.Epsilon, 0.05, 1.0 / 3)),
    (declared, more) => Gen.Elements(declared, (PhysicsObject)declared with
    {
        Friction = more.Item1.Item1,
        Damping = more.Item1.Item2,
        Shrinkage = more.Item1.Item3,
        MinScale = more.Item2,
    })).SelectMany(declared => declared);

    // In the range that the grammar allows.
    private static readonly Gen<double> Intensity = Laws.AnyFinite.Select(static number => Math.Min(Math.Abs(number), 1e9));

    private static readonly Gen<Light> Lights = Colours.Zip(Intensity).Zip(Directions.Zip(AnyVector).Zip(Positive), (c, v) => (Light[])
    [
        new AmbientLight(c.Item1, c.Item2),
        new DirectionalLight(v.Item1.Item1, c.Item1, c.Item2),
        new SunLight(v.Item1.Item1, c.Item1, c.Item2, 89 * c.Item1.Red),
        new PointLight(v.Item1.Item2, c.Item1, c.Item2, v.Item2),
        new SpotLight(v.Item1.Item2, v.Item1.Item1, 179.99999999999997, c.Item1, c.Item2, v.Item2),
        new BallLight(v.Item1.Item2, v.Item2, c.Item1, c.Item2, v.Item2),
        new QuadLight(v.Item1.Item2, v.Item1.Item1, v.Item2, v.Item2, c.Item1, c.Item2, v.Item2, c.Item1.Red),
    ]).SelectMany(kinds => Gen.Elements(kinds));

    private static readonly Gen<Scene> Scenes =
        from objects in Gen.OneOf(Plain, Bodies).NonEmptyListOf()
        from lights in Lights.ListOf()
        from camera in AnyVector.Two().Zip(Unit, (v, fov) => new Camera(v.Item1, v.Item2, 0.001 + (179 * fov))
        {
            Aperture = fov < 0.5 ? 0 : fov,
            FocusDepth = fov < 0.3 ? 1 : 1e-30 + (1e9 * fov),
        })
        from gravity in AnyVector
        from sizes in Positive
        from colour in Colours
        from going in NotNegative.Zip(Gen.Elements(50, 0, -0.0, 89, 100.0 / 3))
        from given in Gen.Choose(0, 16383)
        select new Scene
        {
            Objects = [.. objects],
            Lights = [.. lights],
            Camera = (given & 1) == 0 ? null : camera,
            Gravity = (given & 2) == 0 ? Scene.DefaultGravity : gravity,
            Projection = (given & 4) == 0 ? Projection.Perspective : Projection.Orthographic,
            OrthographicHeight = (given & 12) == 12 ? sizes : null,
            Background = (given & 16) == 0 ? null : colour,
            Clip = (given & 32) == 0 ? null : (Math.Clamp(sizes, 1e-30, 1e29), 2 * Math.Clamp(sizes, 1e-30, 1e29)),
            Player = (given & 64) == 0 || sizes > 1e307 ? null : new(gravity, sizes, 3 * sizes)
            {
                WalkingSpeedOverride = (given & 128) == 0 ? null : going.Item1,
                JumpSpeedOverride = (given & 256) == 0 ? null : going.Item1,
                MaxSlopeAngle = going.Item2,
                StepHeightOverride = (given & 512) == 0 ? null : sizes,
            },
            Sky = (given & 1024) == 0 ? null
                : (given & 32) == 0 ? new ImageSky("field.hdr", (given & 8) == 0 ? 0 : gravity.X, Math.Clamp(sizes, 1e-9, 1e9))
                : new ColourSky(colour, new(colour.Blue, colour.Red, colour.Green), (given & 8) == 0 ? null : colour),
            Probe = (given & 6) == 2 ? gravity : null,
            Exposure = (given & 2048) == 0 ? 1 : Math.Clamp(sizes, 1e-9, 1e9),
            HasAutoExposure = (given & 12288) == 4096,
            Tone = (given & 4096) == 0 ? Tone.None : (Tone)(1 + (given % 3)),
            Fog = (given & 8192) == 0 ? null : new(going.Item1, (given & 16) == 0 ? null : colour)
            {
                Albedo = (given & 32) == 0 ? 0 : colour.Red, Anisotropy = (given & 64) == 0 ? 0 : 0.95 * colour.Green,
            },
            Aspect = (given & 3) == 0 ? null : 0.01 + colour.Red,
            Handedness = (given & 5) == 0 ? Handedness.Right : Handedness.Left,
        };

    private static ParsedScene Parse(string text) => SceneParser.Parse(new("test.sdo", text));

    [Fact]
    public void Write_OfAnyScene_ReadsBackToTheSameBits() => CheckBits(100);

    [Fact]
    public void Write_Twice_IsTheSameText() => CheckTwice(100);

    [Fact]
    [Trait("Category", "Soak")]
    public void Write_OfManyScenes_ReadsBackToTheSameBitsAndText()
    {
        CheckBits(3000);
        CheckTwice(3000);
        CheckOverAnOriginal(3000);
    }

    private static void CheckBits(int scenes) => Laws.CheckForAll(
        Scenes, scene => Assert.Equal(Bits.Of(scene), Bits.Of(Parse(SceneWriter.Write(scene)).Scene)), scenes);

    private static void CheckTwice(int scenes) => Laws.CheckForAll(
        Scenes,
        scene => Assert.Equal(SceneWriter.Write(scene), SceneWriter.Write(Parse(SceneWriter.Write(scene)).Scene)),
        scenes);

    private static void CheckOverAnOriginal(int scenes) => Laws.CheckForAll(
        Scenes,
        scene => Assert.Equal(Bits.Of(scene), Bits.Of(Parse(SceneWriter.Write(scene, Parse(Commented))).Scene)),
        scenes);

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Write_InAnyCulture_IsTheSameText(string culture)
    {
        var scene = Parse(Samples.AppendixA).Scene;
        Assert.Equal(SceneWriter.Write(scene), InCulture.Run(culture, () => SceneWriter.Write(scene)));
    }

    [Theory]
    [InlineData("p \"a.obj\" # 0.5")]
    [InlineData("p \"a.obj\" # 0.5 friction 0.5 rolling 0.01 spinning 0.02 inertia 0.5 rotation locked")]
    [InlineData("p \"a.obj\" # 0.5 friction 0.5 damping 0.25 shrink 0.1 0.2 collider simple")]
    [InlineData("p \"a.obj\" # 0.5 shrink 0.1")]
    [InlineData("p \"a.obj\" # 0.5 shrink 0 0.5")]
    [InlineData("p \"a.obj\" # 0.5 shape capsule")]
    [InlineData("p \"a.obj\" # 0.5 shape mesh")]
    [InlineData("p \"a.obj\" # 0.5 mass 1 shape mesh")]
    [InlineData("p \"a.obj\" # 0.5 friction 0.5 shape mesh rotation locked")]
    [InlineData("p \"a.obj\" # 0.5 density 2.5 shape mesh")]
    [InlineData("p \"a.obj\" # 0.5 friction 0.5 shape balls 3 rotation locked")]
    [InlineData("p \"a.obj\" # 0.5 shape balls 1")]
    [InlineData("o \"a.obj\" # moving velocity (1, 0, 0)")]
    [InlineData("o \"a.obj\" # moving spin (0, 20, 0)")]
    [InlineData("o \"a.obj\" # moving velocity (0, 0, 0)")]
    [InlineData("o \"a.obj\" ((0, 1, 0), #, #) moving velocity (0, 1, 0) spin (0, 0, -5) from (0, 0, 0) to (0, 4, 0) belt (1, 0, 0)")]
    [InlineData("o \"a.obj\" # belt (0, 0, 2.5)")]
    [InlineData("handed right")]
    [InlineData("player (0, 0, 0) 0.3 1.8")]
    [InlineData("player (0, 0, 0) 0.3 1.8 speed 4.5 jump 3 slope 45 step 0")]
    public void Write_OfBodiesAndThePlayer_StatesAllButDefaults(string line)
    {
        Assert.Equal(line + "\n", SceneWriter.Write(Parse(line).Scene));
        Assert.Equal(line + "\n", InCulture.Run("de-DE", () => SceneWriter.Write(Parse(line).Scene)));
    }

    [Theory]
    [InlineData("p \"a.obj\" # 0.5 inertia 0.4 spinning 0 rolling 0", "p \"a.obj\" # 0.5\n")]
    [InlineData("p \"a.obj\" # 0.5 friction 0 damping 0 shrink 0 0.05 mass 1 collider exact", "p \"a.obj\" # 0.5\n")]
    [InlineData("player (0, 0, 0) 0.3 1.8 slope 50", "player (0, 0, 0) 0.3 1.8\n")]
    public void Write_OfStatedDefaults_OmitsThem(string line, string expected) =>
        Assert.Equal(expected, SceneWriter.Write(Parse(line).Scene));

    [Theory]
    [InlineData(Commented)]
    [InlineData(Samples.AppendixA)]
    public void Write_OfAnUnchangedScene_IsTheOriginalText(string text)
    {
        Assert.Equal(text, SceneWriter.Write(Parse(text).Scene, Parse(text)));
        var windows = text.ReplaceLineEndings("\r\n") + "\r\n";
        Assert.Equal(windows, SceneWriter.Write(Parse(windows).Scene, Parse(windows)));
    }

    [Theory]
    [InlineData("\n")]
    [InlineData("\r\n")]
    public void Write_WithAnotherCamera_ChangesOnlyItsLine(string lineBreak)
    {
        var original = Parse(Commented.ReplaceLineEndings(lineBreak));
        var written = SceneWriter.Write(original.Scene with { Camera = new(new(0.1, -0.0, 7), new(1, 2, 3), 45) }, original);
        Assert.Equal(original.Source.Text.Replace("c   (1,2,3)   (0,0,0)   60", "c (0.1, -0, 7) (1, 2, 3) 45", StringComparison.Ordinal),
            written);
    }

    [Theory]
    [InlineData("handed  left\no \"a.obj\" #\n", Handedness.Left, "handed  left\no \"a.obj\" #\n")]
    [InlineData("handed  left\no \"a.obj\" #\n", Handedness.Right, "handed right\no \"a.obj\" #\n")]
    [InlineData("handed  right\no \"a.obj\" #\n", Handedness.Right, "handed  right\no \"a.obj\" #\n")]
    [InlineData("handed right\no \"a.obj\" #\n", Handedness.Left, "o \"a.obj\" #\n")]
    public void Write_WithAnotherHandedness_ChangesOnlyItsLine(string text, Handedness handedness, string expected)
    {
        var original = Parse(text);
        Assert.Equal(expected, SceneWriter.Write(original.Scene with { Handedness = handedness }, original));
    }

    [Theory]
    [InlineData("\n")]
    [InlineData("\r\n")]
    public void Write_WithANewCamera_AddsOneLineAtTheEnd(string lineBreak)
    {
        var original = Parse($"# one{lineBreak}o \"a.obj\" #");
        var written = SceneWriter.Write(original.Scene with { Camera = new(Vector.One, Vector.Zero, 45) }, original);
        Assert.Equal($"# one{lineBreak}o \"a.obj\" #{lineBreak}c (1, 1, 1) (0, 0, 0) 45{lineBreak}", written);
    }

    [Fact]
    public void Write_WithoutTheCamera_DropsItsLineAndKeepsComments()
    {
        var original = Parse(Commented);
        Assert.Equal(
            Commented.Replace("c   (1,2,3)   (0,0,0)   60\n", "", StringComparison.Ordinal),
            SceneWriter.Write(original.Scene with { Camera = null }, original));
    }

    [Fact]
    public void Write_WithObjectsChangedAddedAndRemoved_ReadsBackEqual() => Seeded.Run(200, random =>
    {
        var original = Parse(Commented);
        var objects = original.Scene.Objects.Concat(original.Scene.Objects).Where(_ => random.Next(2) == 0)
            .Select(declared => random.Next(2) == 0 ? declared : declared with { Placement = random.Transformation() })
            .OrderBy(_ => random.Next()).ToArray();
        var changed = original.Scene with { Objects = [.. objects] };
        Assert.Equal(Bits.Of(changed), Bits.Of(Parse(SceneWriter.Write(changed, original)).Scene));
        Assert.Contains("# two things", SceneWriter.Write(changed, original), StringComparison.Ordinal);
    });

    [Fact]
    public void Write_OfAnyOtherSceneOverAnOriginal_ReadsBackToTheSameBits() => CheckOverAnOriginal(100);

    [Fact]
    public void Write_OfACameraWithATarget_KeepsItsLineUntilTheCameraMoves()
    {
        const string text = "c (1, 2, -5) look-at (4, 0, 3) 60\nhanded right\n";
        var original = Parse(text);
        Assert.Equal(text, SceneWriter.Write(original.Scene, original));
        var moved = original.Scene with { Camera = original.Scene.Camera! with { Position = new(1, 2, 3) } };
        Assert.Equal(Bits.Of(moved), Bits.Of(Parse(SceneWriter.Write(moved, original)).Scene));
        var mirrored = original.Scene with { Handedness = Handedness.Left };
        Assert.Equal(Bits.Of(mirrored), Bits.Of(Parse(SceneWriter.Write(mirrored, original)).Scene));
    }

    [Fact]
    public void Relocate_ToAnotherFolder_NamesTheSameFiles()
    {
        var scene = Parse("o \"models/a.obj\" #\no \"../b.fdo\" #").Scene;
        Assert.Equal(
            ["../scenes/models/a.obj", "../b.fdo"],
            SceneRelocation.Relocate(scene, Path.GetFullPath("/assets/scenes/x.sdo"),
            Path.GetFullPath("/assets/saved/y.sdo")).Objects.Select(declared => declared.File));
    }
}
