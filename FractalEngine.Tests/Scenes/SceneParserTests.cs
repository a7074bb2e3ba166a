using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Scenes;

public class SceneParserTests
{
    private static Scene Parse(string text) => SceneParser.Parse(new("test.sdo", text)).Scene;

    private static SceneObject Object(string line) => Assert.Single(Parse(line).Objects);

    [Fact]
    public void Parse_AppendixA_AsItStands()
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
            (scene.Camera, scene.Projection, scene.OrthographicHeight, scene.Aspect, scene.Clip, scene.Background, scene.Gravity, scene.Player));
        Assert.Empty(scene.Lights);
    }

    [Theory]
    [InlineData("c (1, 2, 3) (4, 5, 6) 60")]
    [InlineData("c (1 2 3) (4 5 6) 60")]
    [InlineData("c (1,2,3)(4,5,6)60")]
    [InlineData("c (1 , 2 ,3) , (4,5 , 6) , 60")]
    [InlineData("\tc\t( 1\t2\t3 )\t(4,5,6)\t60\t")]
    [InlineData("c (1., +2, 3e0), (.4e1, 5.0, 6) 6E+1")]
    public void Camera_WithAnySeparators_IsRead(string line) => Assert.Equal(new Camera(new(1, 2, 3), new(4, 5, 6), 60), Parse(line).Camera);

    [Fact]
    public void Camera_WithHashes_IsAtTheOriginUnturned() => Assert.Equal(new Camera(Vector.Zero, Vector.Zero, 45), Parse("c # # 45").Camera);

    [Theory]
    [InlineData("#", 0, 0, 1)]
    [InlineData("(#, #, #)", 0, 0, 1)]
    [InlineData("((7, 7, 7), #, #)", 7, 0, 1)]
    [InlineData("(#, (7, 7, 7), #)", 0, 7, 1)]
    [InlineData("(#, #, (7, 7, 7))", 0, 0, 7)]
    [InlineData("((7 7 7) (7,7,7),(7, 7 , 7))", 7, 7, 7)]
    [InlineData("( # # # )", 0, 0, 1)]
    public void Matrix_WithHashes_HasNoTransformationThere(string matrix, double position, double rotation, double scale) => Assert.Equal(
        new(position * Vector.One, rotation * Vector.One, scale * Vector.One), Object($"o \"a.obj\" {matrix}").Placement);

    [Theory]
    [InlineData("o \"a b/ü.obj\" #", "a b/ü.obj")]
    [InlineData("o \"../x.FDO\" #", "../x.FDO")]
    [InlineData("o \"#.obj\" #", "#.obj")]
    [InlineData("o\"a.obj\"#", "a.obj")]
    public void File_IsAsTheSceneNamesIt(string line, string file) => Assert.Equal(file, Object(line).File);

    [Fact]
    public void Object_WithOptions_HasThem()
    {
        var declared = Object("o \"a.obj\" # name \"the first\" colour (1, 0.5, 0)");
        Assert.Equal(("the first", new Colour(1, 0.5, 0)), (declared.Name, declared.Colour));
        Assert.Equal(declared, Object("o \"a.obj\" # color (1 .5 0) name \"the first\""));
    }

    [Fact]
    public void Object_WithAGradient_HasIt()
    {
        Assert.Equal(new Gradient(GradientKind.Level, new(1, 0.5, 0)), Object("o \"a.fdo\" # gradient level (1, 0.5, 0)").Gradient);
        var declared = Object("o \"a.fdo\" # colour (0, 0, 1) gradient path (1 .5 0) name \"x\"");
        Assert.Equal(("x", new Colour(0, 0, 1), new Gradient(GradientKind.Path, new(1, 0.5, 0))), (declared.Name, declared.Colour, declared.Gradient));
        Assert.Null(Object("o \"a.fdo\" # colour (0, 0, 1)").Gradient);
        Assert.NotNull(Object("p \"a.fdo\" # 0.5 mass 2 gradient path (1, 1, 1)").Gradient);
    }

    [Fact]
    public void PhysicsObject_WithoutOptions_HasTheDefaults()
    {
        var body = Assert.IsType<PhysicsObject>(Object("p \"a.fdo\" # 0.5"));
        Assert.Equal((0.5, Vector.Zero, 1.0, ColliderKind.Exact), (body.Restitution, body.Velocity, body.Mass, body.Collider));
    }

    [Theory]
    [InlineData("exact", ColliderKind.Exact)]
    [InlineData("fractal", ColliderKind.Fractal)]
    [InlineData("hierarchy", ColliderKind.Hierarchy)]
    [InlineData("bounding-box", ColliderKind.BoundingBox)]
    [InlineData("simple", ColliderKind.Simple)]
    public void PhysicsObject_WithOptions_HasThem(string name, ColliderKind collider) => Assert.Equal(
        new PhysicsObject("a.fdo", Samples.Move(1, 2, 3), 1) { Velocity = new(4, 5, 6), Mass = 2.5, Collider = collider, Name = "n", Colour = Colour.White },
        Object($"p \"a.fdo\" ((1,2,3),#,#) 1 velocity (4, 5, 6) mass 2.5 collider {name} name \"n\" colour (1,1,1)"));

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

    [Fact]
    public void Gravity_IsAVectorOrNone()
    {
        Assert.Equal(new(0, -1.6, 0), Parse("gravity (0, -1.6, 0)").Gravity);
        Assert.Equal(Vector.Zero, Parse("gravity #").Gravity);
    }

    [Fact]
    public void Player_HasAPositionARadiusAndAHeight() => Assert.Equal(new Player(new(1, 2, 3), 0.3, 1.8), Parse("player (1, 2, 3) 0.3 1.8").Player);

    [Fact]
    public void Lights_OfAllKinds_AreReadInOrder() => Assert.Equal(
        [
            new AmbientLight(new(1, 1, 1), 0.2),
            new AmbientLight(new(1, 1, 1), 1),
            new DirectionalLight(new(1, -2, 1), new(1, 0.5, 0), 0.9),
            new DirectionalLight(new(1, -2, 1), new(1, 0.5, 0), 1),
            new PointLight(new(1, 2, 3), new(0, 0, 1), 2, 30),
            new SpotLight(new(1, 2, 3), new(0, -1, 0), 40, new(0, 1, 0), 2, 30),
        ],
        Parse("""
            light ambient (1, 1, 1) 0.2
            light ambient (1, 1, 1)
            light directional (1, -2, 1) (1, 0.5, 0) 0.9
            light directional (1, -2, 1) (1, 0.5, 0)
            light point (1, 2, 3) (0, 0, 1) 2 30
            light spot (1, 2, 3) (0, -1, 0) 40 (0, 1, 0) 2, 30
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
    public void Parse_InAnyCulture_ReadsPoints(string culture) => Assert.Equal(Parse(Samples.AppendixA), InCulture.Get(culture, () => Parse(Samples.AppendixA)));

    [Fact]
    public void FileOffset_PointsAtTheName()
    {
        var file = SceneParser.Parse(new("test.sdo", Samples.AppendixA));
        Assert.StartsWith("\"SampleAsset2.obj\"", file.Source.Text[file.FileOffsets.ElementAt(1)..], StringComparison.Ordinal);
    }

    [Fact]
    public void Lines_TogetherAreTheText()
    {
        var text = Samples.AppendixA.ReplaceLineEndings("\r\n") + "\n\n# end";
        Assert.Equal(text, string.Concat(SceneParser.Parse(new("test.sdo", text)).Lines.Select(line => line.Text)));
    }

    [Fact]
    public void Parse_OfAHundredThousandObjects_TakesNoLongerThanTwoSeconds()
    {
        var text = string.Concat(Enumerable.Range(0, 100_000).Select(i => $"o \"a.obj\" (({i}, 0, 0), #, #)\n"));
        var start = System.Diagnostics.Stopwatch.StartNew();
        Assert.Equal(100_000, Parse(text).Objects.Length);
        Assert.True(start.ElapsedMilliseconds < 2000, $"{start.ElapsedMilliseconds} ms");
    }

    [Fact]
    public void Comment_BeforeACarriageReturnAlone_EndsThere() => Assert.Single(Parse("# comment\ro \"a.obj\" #\r").Objects);
}
