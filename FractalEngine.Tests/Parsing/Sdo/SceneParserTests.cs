using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Sdo;

public class SceneParserTests
{
    private static Scene Parse(string text) => SceneParser.Parse(new("test.sdo", text)).Scene;

    private static SceneObject ParseObject(string line) => Assert.Single(Parse(line).Objects);

    [Fact]
    public void Parse_OfAppendixA_GivesItsCameraAndObjects()
    {
        var scene = Parse(Samples.AppendixA);
        Assert.Equal(new Camera(new(-48.761894, 25.567242, 64.429054), new(-0.071402885, -2.4999454, 0), 60), scene.Camera);
        Assert.Equal(
            [
                new SceneObject("SampleAsset1.obj", new(Vector.One, new(90, 0, 30), Vector.One)),
                new SceneObject("SampleAsset2.obj", Transformation.Identity),
            ],
            scene.Objects.ToArray());
    }

    [Fact]
    public void Parse_OfOneObject_LeavesTheRestToTheProgram()
    {
        var scene = Parse("o \"a.obj\" #");
        Assert.Equal(
            (null, Projection.Perspective, null, null, null, null, new Vector(0, -9.8, 0), null),
            (scene.Camera, scene.Projection, scene.OrthographicHeight, scene.Aspect, scene.Clip, scene.Background, scene.Gravity,
            scene.Player));
        Assert.Empty(scene.Lights);
    }

    [Theory]
    [InlineData("c (1, 2, 3) (4, 5, 6) 60")]
    [InlineData("c (1 2 3) (4 5 6) 60")]
    [InlineData("c (1,2,3)(4,5,6)60")]
    [InlineData("c (1 , 2 ,3) , (4,5 , 6) , 60")]
    [InlineData("\tc\t( 1\t2\t3 )\t(4,5,6)\t60\t")]
    [InlineData("c (1., +2, 3e0), (.4e1, 5.0, 6) 6E+1")]
    public void Camera_WithAnySeparators_IsRead(string line) =>
        Assert.Equal(new Camera(new(1, 2, 3), new(4, 5, 6), 60), Parse(line).Camera);

    [Fact]
    public void Camera_WithHashes_IsAtTheOriginUnrotated() =>
        Assert.Equal(new Camera(Vector.Zero, Vector.Zero, 45), Parse("c # # 45").Camera);

    [Theory]
    [InlineData("exposure auto", 1)]
    [InlineData("exposure auto 0.5", 0.5)]
    [InlineData("exposure auto  2 ", 2)]
    public void Exposure_ByWhatIsShown_IsReadAndWritten(string line, double exposure)
    {
        var scene = Parse(line);
        Assert.Equal((true, exposure), (scene.HasAutoExposure, scene.Exposure));
        Assert.Equal(scene, Parse(SceneWriter.Write(scene)));
    }

    [Theory]
    [InlineData("c # # 45 aperture 0.25 focus 3")]
    [InlineData("c # look-at (0, 0, 1) 45 focus 3 aperture 0.25")]
    public void Camera_WithALens_HasIt(string line) =>
        Assert.Equal(new Camera(Vector.Zero, Vector.Zero, 45) { Aperture = 0.25, FocusDepth = 3 }, Parse(line).Camera);

    [Theory]
    [InlineData("#", 0, 0, 1)]
    [InlineData("(#, #, #)", 0, 0, 1)]
    [InlineData("((7, 7, 7), #, #)", 7, 0, 1)]
    [InlineData("(#, (7, 7, 7), #)", 0, 7, 1)]
    [InlineData("(#, #, (7, 7, 7))", 0, 0, 7)]
    [InlineData("((7 7 7) (7,7,7),(7, 7 , 7))", 7, 7, 7)]
    [InlineData("( # # # )", 0, 0, 1)]
    public void Matrix_WithHashes_HasNoTransformationThere(string matrix, double position, double rotation, double scale) => Assert.Equal(
        new(position * Vector.One, rotation * Vector.One, scale * Vector.One), ParseObject($"o \"a.obj\" {matrix}").Placement);

    [Theory]
    [InlineData("o \"a b/ü.obj\" #", "a b/ü.obj")]
    [InlineData("o \"../x.FDO\" #", "../x.FDO")]
    [InlineData("o \"#.obj\" #", "#.obj")]
    [InlineData("o\"a.obj\"#", "a.obj")]
    public void File_OfAnObject_IsTheNameInTheScene(string line, string file) => Assert.Equal(file, ParseObject(line).File);

    [Fact]
    public void Object_WithOptions_HasThem()
    {
        var declared = ParseObject("o \"a.obj\" # name \"the first\" colour (1, 0.5, 0)");
        Assert.Equal(("the first", new Colour(1, 0.5, 0)), (declared.Name, declared.Colour));
        Assert.Equal(declared, ParseObject("o \"a.obj\" # color (1 .5 0) name \"the first\""));
    }

    [Fact]
    public void Object_WithAGradient_HasIt()
    {
        Assert.Equal(new Gradient(GradientKind.Level, new(1, 0.5, 0)), ParseObject("o \"a.fdo\" # gradient level (1, 0.5, 0)").Gradient);
        var declared = ParseObject("o \"a.fdo\" # colour (0, 0, 1) gradient path (1 .5 0) name \"x\"");
        Assert.Equal(("x", new Colour(0, 0, 1), new Gradient(GradientKind.Path, new(1, 0.5, 0))),
            (declared.Name, declared.Colour, declared.Gradient));
        Assert.Null(ParseObject("o \"a.fdo\" # colour (0, 0, 1)").Gradient);
        Assert.NotNull(ParseObject("p \"a.fdo\" # 0.5 mass 2 gradient path (1, 1, 1)").Gradient);
    }

    [Fact]
    public void Object_WithAPalette_HasIt()
    {
        Assert.Equal(
            Gradient.Of(GradientKind.Height, NamedPalettes.Find("ember")!),
            ParseObject("o \"a.fdo\" # gradient height \"ember\"").Gradient);
        var even = Palette.OfEven(new Colour(1, 0, 0), new Colour(0, 1, 0), new Colour(0, 0, 0.5));
        string[] all = ["(1, 0, 0) (0, 1, 0) (0, 0, 0.5)", "(1 0 0),(0 1 0)(0 0 .5)", "0 (1, 0, 0) .5 (0, 1, 0) 1 (0, 0, 0.5)"];
        foreach (var colours in all)
        {
            var declared = ParseObject($"o \"a.fdo\" # gradient trap {colours} name \"n\"");
            Assert.Equal(("n", Gradient.Of(GradientKind.Trap, even)), (declared.Name, declared.Gradient));
        }

        Assert.Equal(
            new Gradient(GradientKind.Path, Colour.White) { Roughness = new(0.2, 0.9), Glow = new(0, 4), Metalness = new(1, 0) },
            ParseObject("o \"a.fdo\" # gradient path (1, 1, 1) glow 0 4 roughness .2, 0.9 metal 1 0 name \"n\"").Gradient);
        var sharp = ParseObject("p \"a.fdo\" # 0.5 gradient distance 0.25 (1, 0, 0), 0.5 (0, 1, 0), 0.5 (0, 0, 0.5) mass 2").Gradient;
        Assert.Equal([0.25, 0.5, 0.5], sharp!.Palette!.Stops.Select(static stop => stop.Position));
    }

    [Fact]
    public void PhysicsObject_WithoutOptions_HasTheDefaults()
    {
        var body = Assert.IsType<PhysicsObject>(ParseObject("p \"a.fdo\" # 0.5"));
        Assert.Equal((0.5, Vector.Zero, 1.0, ColliderKind.Exact), (body.Restitution, body.Velocity, body.Mass, body.Collider));
        Assert.Equal((0.0, 0.0, 0.0, 0.05), (body.Friction, body.Damping, body.Shrinkage, body.MinScale));
    }

    [Theory]
    [InlineData("exact", ColliderKind.Exact)]
    [InlineData("fractal", ColliderKind.Fractal)]
    [InlineData("hierarchy", ColliderKind.Hierarchy)]
    [InlineData("bounding-box", ColliderKind.BoundingBox)]
    [InlineData("simple", ColliderKind.Simple)]
    public void PhysicsObject_WithOptions_HasThem(string name, ColliderKind collider) => Assert.Equal(
        new PhysicsObject("a.fdo", Samples.Move(1, 2, 3), 1)
        {
            Velocity = new(4, 5, 6), Mass = 2.5, Collider = collider, Name = "n",
            Colour = Colour.White
        },
        ParseObject($"p \"a.fdo\" ((1,2,3),#,#) 1 velocity (4, 5, 6) mass 2.5 collider {name} name \"n\" colour (1,1,1)"));

    [Theory]
    [InlineData("friction 0.5", 0.5, 0, 0, 0.05)]
    [InlineData("friction 7", 7, 0, 0, 0.05)]
    [InlineData("damping 0.25", 0, 0.25, 0, 0.05)]
    [InlineData("shrink 0.1", 0, 0, 0.1, 0.05)]
    [InlineData("shrink 0.1 0.2", 0, 0, 0.1, 0.2)]
    [InlineData("shrink 0.1, 1", 0, 0, 0.1, 1)]
    [InlineData("shrink 0 .5", 0, 0, 0, 0.5)]
    [InlineData("shrink 0.1 mass 1", 0, 0, 0.1, 0.05)]
    [InlineData("friction 0.5 damping 0.25 shrink 0.1 0.2", 0.5, 0.25, 0.1, 0.2)]
    [InlineData("shrink 0.1 0.2 damping 0.25 name \"x\" friction 0.5", 0.5, 0.25, 0.1, 0.2)]
    [InlineData("friction 1 friction 0", 0, 0, 0, 0.05)]
    [InlineData("shrink 1 0.5 shrink 2", 0, 0, 2, 0.05)]
    public void PhysicsObject_WithFrictionDampingAndShrinking_HasThemAndTheLastWins(string options, double friction, double damping,
    double rate, double minimum)
    {
        var body = Assert.IsType<PhysicsObject>(ParseObject($"p \"a.obj\" # 0.5 {options}"));
        Assert.Equal((friction, damping, rate, minimum), (body.Friction, body.Damping, body.Shrinkage, body.MinScale));
    }

    [Theory]
    [InlineData("c (1, 2, 3) # 60", Handedness.Left)]
    [InlineData("handed left\nc (1, 2, 3) # 60", Handedness.Left)]
    [InlineData("handed right\nc (1, 2, 3) # 60", Handedness.Right)]
    [InlineData("c (1, 2, 3) # 60\n handed  right ", Handedness.Right)]
    public void Handedness_IsReadAndIsThatOfTheCamera(string text, Handedness handedness)
    {
        Assert.Equal((handedness, handedness), (Parse(text).Handedness, Parse(text).Camera!.Handedness));
        Assert.Equal(new(1, 2, 3), Parse(text).Camera!.Position);
    }

    [Theory]
    [InlineData("projection perspective", Projection.Perspective, null)]
    [InlineData("projection orthographic", Projection.Orthographic, null)]
    [InlineData("projection orthographic 7.5", Projection.Orthographic, 7.5)]
    public void Projection_IsRead(string line, Projection projection, double? height) =>
        Assert.Equal((projection, height), (Parse(line).Projection, Parse(line).OrthographicHeight));

    [Theory]
    [InlineData("aspect 16:9", 16.0 / 9)]
    [InlineData("aspect 16 : 9", 16.0 / 9)]
    [InlineData("aspect 1.5", 1.5)]
    public void Aspect_IsWidthDividedByHeight(string line, double expected) => Assert.Equal(expected, Parse(line).Aspect);

    [Theory]
    [InlineData("clip 0.1 100")]
    [InlineData("clip 0.1, 100")]
    public void Clip_IsNearAndFar(string line) => Assert.Equal((0.1, 100), Parse(line).Clip);

    [Fact]
    public void Background_IsAColour() => Assert.Equal(new Colour(0.1, 0.2, 0.3), Parse("background (0.1, 0.2, 0.3)").Background);

    [Theory]
    [InlineData("sky (0.1, 0.2, 0.3) (0.4, 0.5, 0.6)", false)]
    [InlineData("sky (0.1, 0.2, 0.3), (0.4, 0.5, 0.6), (0.7, 0.8, 0.9)", true)]
    public void Sky_IsTwoColoursOrThree(string line, bool hasGround) => Assert.Equal(
        new ColourSky(new(0.1, 0.2, 0.3), new(0.4, 0.5, 0.6), hasGround ? new(0.7, 0.8, 0.9) : null), Parse(line).Sky);

    [Theory]
    [InlineData("sun (1, -2, 0) (1, 0.9, 0.8) 3", SunLight.DefaultDiameter)]
    [InlineData("sun (1, -2, 0), (1, 0.9, 0.8), 3, 0", 0)]
    [InlineData("sun (1, -2, 0) (1, 0.9, 0.8) 3 7.5", 7.5)]
    public void Sun_IsADirectionalLightWithADiameter(string line, double diameter) => Assert.Equal(
        new SunLight(new(1, -2, 0), new(1, 0.9, 0.8), 3, diameter), Assert.Single(Parse(line).Lights));

    [Theory]
    [InlineData("probe (1, -2.5, 3e-9)", true)]
    [InlineData("fog 1", false)]
    public void Probe_IsAPoint(string line, bool isDeclared) =>
        Assert.Equal(isDeclared ? new Vector(1, -2.5, 3e-9) : null, Parse(line).Probe);

    [Theory]
    [InlineData("exposure 1.5\ntone filmic", 1.5, Tone.Filmic)]
    [InlineData("tone none", 1, Tone.None)]
    [InlineData("tone reinhard", 1, Tone.Reinhard)]
    [InlineData("tone aces", 1, Tone.Aces)]
    [InlineData("handed left", 1, Tone.None)]
    public void ExposureAndTone_AreRead(string text, double exposure, Tone tone) =>
        Assert.Equal((exposure, tone), (Parse(text).Exposure, Parse(text).Tone));

    [Theory]
    [InlineData("fog 0.25", false)]
    [InlineData("fog 0.25 (0.1, 0.2, 0.3)", true)]
    public void Fog_IsADensityAndPerhapsAColour(string line, bool hasColour) =>
        Assert.Equal(new Fog(0.25, hasColour ? new Colour(0.1, 0.2, 0.3) : null), Parse(line).Fog);

    [Theory]
    [InlineData("fog 0.25 scatter 0.8", 0.8, 0)]
    [InlineData("fog 0.25, (0.1, 0.2, 0.3) forward -0.95 scatter 1", 1, -0.95)]
    [InlineData("fog 0.25 scatter 0.5 forward 0.6", 0.5, 0.6)]
    public void Fog_MayScatterLight(string line, double albedo, double anisotropy)
    {
        var colour = line.Contains('(', StringComparison.Ordinal) ? new Colour(0.1, 0.2, 0.3) : (Colour?)null;
        Assert.Equal(new Fog(0.25, colour) { Albedo = albedo, Anisotropy = anisotropy }, Parse(line).Fog);
    }

    [Fact]
    public void Gravity_IsAVectorOrNone()
    {
        Assert.Equal(new(0, -1.6, 0), Parse("gravity (0, -1.6, 0)").Gravity);
        Assert.Equal(Vector.Zero, Parse("gravity #").Gravity);
    }

    [Fact]
    public void Player_HasAPositionARadiusAndAHeight() =>
        Assert.Equal(new Player(new(1, 2, 3), 0.3, 1.8), Parse("player (1, 2, 3) 0.3 1.8").Player);

    [Fact]
    public void Player_WithoutOptions_HasDefaultsFromItsHeight()
    {
        var player = new Player(Vector.Zero, 0.3, 1.8);
        Assert.Equal((null, null, 50.0, null),
            (player.WalkingSpeedOverride, player.JumpSpeedOverride, player.MaxSlopeAngle, player.StepHeightOverride));
        // 2.5 · 1.8; 1.8 / 4; and the height v²/2g of the jump is 0.6 · 1.8. Roundings of a few products.
        Near.Equal(4.5, player.WalkingSpeed, 1e-15);
        Near.Equal(0.45, player.StepHeight, 1e-16);
        Near.Equal(1.08, player.JumpSpeed(9.8) * player.JumpSpeed(9.8) / (2 * 9.8), 1e-15);
        Assert.Equal(0, player.JumpSpeed(0));
    }

    [Theory]
    [InlineData("speed 4 jump 5 slope 60 step 0.5")]
    [InlineData("step .5 slope 60 jump 5 speed 4")]
    [InlineData("speed 1 speed 4 jump 5 slope 60 step 0.5")]
    public void Player_WithOptions_HasThem(string options)
    {
        var player = Parse($"player (1, 2, 3) 0.3 1.8 {options}").Player!;
        Assert.Equal(new Player(new(1, 2, 3), 0.3, 1.8)
        {
            WalkingSpeedOverride = 4, JumpSpeedOverride = 5, MaxSlopeAngle = 60,
            StepHeightOverride = 0.5
        }, player);
        Assert.Equal((4, 5, 0.5), (player.WalkingSpeed, player.JumpSpeed(9.8), player.StepHeight));
    }

    [Theory]
    [InlineData("speed 0 jump 0 slope 0 step 0", 0, 0)]
    [InlineData("speed 0 jump 0 slope 89 step 1.7999999999999998", 89, 1.7999999999999998)]
    public void Player_AtTheEndsOfTheRanges_IsRead(string options, double slope, double step) => Assert.Equal(
        new Player(Vector.Zero, 0.9, 1.8)
        {
            WalkingSpeedOverride = 0, JumpSpeedOverride = 0, MaxSlopeAngle = slope,
            StepHeightOverride = step
        }, Parse($"player (0, 0, 0) 0.9 1.8 {options}").Player);

    [Fact]
    public void Lights_OfAllKinds_AreReadInOrder() => Assert.Equal(
        [
            new AmbientLight(new(1, 1, 1), 0.2),
            new AmbientLight(new(1, 1, 1), 1),
            new DirectionalLight(new(1, -2, 1), new(1, 0.5, 0), 0.9),
            new DirectionalLight(new(1, -2, 1), new(1, 0.5, 0), 1),
            new PointLight(new(1, 2, 3), new(0, 0, 1), 2, 30),
            new SpotLight(new(1, 2, 3), new(0, -1, 0), 40, new(0, 1, 0), 2, 30),
            new BallLight(new(1, 2, 3), 0.5, new(0, 1, 0), 2, 30),
            new QuadLight(new(1, 2, 3), new(0, -1, 0), 2, 1, new(0, 1, 0), 2, 30),
            new QuadLight(new(1, 2, 3), new(0, -1, 0), 2, 1, new(0, 1, 0), 2, 30, -45),
        ],
        Parse("""
            light ambient (1, 1, 1) 0.2
            light ambient (1, 1, 1)
            light directional (1, -2, 1) (1, 0.5, 0) 0.9
            light directional (1, -2, 1) (1, 0.5, 0)
            light point (1, 2, 3) (0, 0, 1) 2 30
            light spot (1, 2, 3) (0, -1, 0) 40 (0, 1, 0) 2, 30
            light ball (1, 2, 3) 0.5 (0, 1, 0) 2, 30
            light quad (1, 2, 3) (0, -1, 0) 2 1 (0, 1, 0) 2 30
            light quad (1, 2, 3) (0, -1, 0), 2, 1, (0, 1, 0), 2, 30, -45
            """).Lights.ToArray());

    [Fact]
    public void Parse_WithAnyLineBreaks_IsTheSame()
    {
        var expected = Parse(Samples.AppendixA);
        Assert.Equal(expected, Parse(Samples.AppendixA.ReplaceLineEndings("\r\n")));
        Assert.Equal(expected, Parse(Samples.AppendixA + "\n"));
    }

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Parse_InAnyCulture_ReadsPoints(string culture) =>
        Assert.Equal(Parse(Samples.AppendixA), InCulture.Run(culture, () => Parse(Samples.AppendixA)));

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Parse_OfBodiesAndThePlayerInAnyCulture_ReadsPoints(string culture)
    {
        const string text =
            "p \"a.obj\" # 0.5 friction 0.5 damping 1.5 shrink 0.1 0.2\nplayer (0, 0, 0) 0.3 1.8 speed 1.5 jump 2.5 slope 30.5 step 0.1";
        Assert.Equal(Parse(text), InCulture.Run(culture, () => Parse(text)));
    }

    [Fact]
    public void FileNameOffset_PointsAtTheName()
    {
        var file = SceneParser.Parse(new("test.sdo", Samples.AppendixA));
        Assert.StartsWith("\"SampleAsset2.obj\"", file.Source.Text[file.FileNameOffsets.ElementAt(1)..], StringComparison.Ordinal);
    }

    [Fact]
    public void Lines_TogetherAreTheText()
    {
        var text = Samples.AppendixA.ReplaceLineEndings("\r\n") + "\n\n# end";
        Assert.Equal(text, string.Concat(SceneParser.Parse(new("test.sdo", text)).Lines.Select(line => line.Text)));
    }

    [Theory]
    [InlineData("")]
    [InlineData("handed right\n")]
    public void Camera_WithATarget_HasItInTheMiddle(string handed)
    {
        // The handedness may stand on either side of the camera.
        var camera = Parse($"c (1, 2, -5) look-at (4, 0, 3) 60\n{handed}").Camera!;
        var (right, up, depth) = camera.ToCameraSpace(new(4, 0, 3));
        var distance = new Vector(3, -2, 8).Length();
        // Three roundings of sines and cosines, at a distance of nine.
        Assert.InRange(new Vector(right, up, depth - distance).Length(), 0, 1e-13);
        Assert.True(camera.LocalAxes.V2.Y > 0.9, "up is up");
        Assert.Equal(camera, Parse($"{handed}c (1, 2, -5), look-at (4 0 3) up (0, 2, 0), 60").Camera);
    }

    [Theory]
    [InlineData("c # look-at (0, 0, 0) 60", "a camera can't look at its own position")]
    [InlineData("c # look-at (0, 0, 1) up (0, 0, 0) 60", "the direction up must not be (0, 0, 0)")]
    [InlineData("c # look-at # 60", "unexpected '#', expected '('")]
    [InlineData("c # lookat (0, 0, 1) 60", "unexpected 'lookat': did you mean 'look-at'?")]
    public void Camera_WithAFaultyTarget_IsRefused(string line, string message) =>
        Assert.Equal(message, Errors.ThrownBy(() => Parse(line)).Diagnostic.Message);

    [Fact]
    public void Comment_BeforeACarriageReturnAlone_EndsThere() => Assert.Single(Parse("# comment\ro \"a.obj\" #\r").Objects);
}
