using System.Text;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Sdo;

/// <summary>Compares whole messages: these tests specify what a user reads.</summary>
public class SceneParserErrorTests
{
    private static ParsedScene Parse(string text) => SceneParser.Parse(new("test.sdo", text));

    private static void Fails(string text, string expected) => Errors.AssertMessage(expected, () => Parse(text));

    private static void FailsAt(string line, int column, string message) => Fails(
        line, $"test.sdo:1:{column}: error: {message}\n  {line}\n  {new string(' ', column - 1)}^");

    [Fact]
    public void File_WithoutAnything_SaysSo() =>
        Fails("", "test.sdo:1:1: error: the scene declares nothing: it has no camera, object or light");

    [Fact]
    public void File_OfComments_SaysSo() => Fails("# nothing\n\n", """
        test.sdo:1:1: error: the scene declares nothing: it has no camera, object or light
          # nothing
          ^
        """);

    [Fact]
    public void Keyword_Unknown_ListsTheKnownOnes() => FailsAt(
        "x \"a.obj\" #", 1,
        "unexpected 'x', expected 'c', 'o', 'p', 'handed', 'projection', 'aspect', 'clip', 'background', 'light', 'sun', 'sky', "
        + "'probe', 'exposure', 'tone', 'fog', 'gravity', 'player', 'film' or 'at'");

    [Theory]
    [InlineData("c (1, 2, 3) (4, 5, 6)", 22, "unexpected end of file: a camera ends with its vertical angle of view in degrees")]
    [InlineData("c # look-at (4, 5, 6) up (0, 1, 0)", 35,
        "unexpected end of file: a camera ends with its vertical angle of view in degrees")]
    [InlineData("c (1, 2) (4, 5, 6) 60", 8, "unexpected ')': a vector has three numbers, and this one has two")]
    [InlineData("c 1 2 3", 3, "unexpected '1', expected '#' or '('")]
    [InlineData("c (1, 2, 3) (4, 5, 6) 0", 23, "the angle of view must lie between 0 and 180 degrees")]
    [InlineData("c (1, 2, 3) (4, 5, 6) 180", 23, "the angle of view must lie between 0 and 180 degrees")]
    [InlineData("c (1, 1e400, 3) # 60", 7, "the number 1e400 is beyond the range of a double")]
    [InlineData("c (1, nan, 3) # 60", 7, "unexpected 'nan', expected a number")]
    [InlineData("o \"a.obj\"", 10,
        "unexpected end of file: a placement is '#' or three vectors in parentheses, (position, rotation, scale)")]
    [InlineData("o \"a.obj\" (#, #)", 16,
        "unexpected ')': a placement is '#' or three vectors in parentheses, (position, rotation, scale)")]
    [InlineData("o a.obj #", 3, "unexpected 'a', expected a file name in quotes")]
    [InlineData("o \"a.png\" #", 3, "expected the name of a mesh or fractal (.obj, .obj.gz, .ply, .stl, .glb, .gltf, .fdo)")]
    [InlineData("o \"a.obj #", 11, "unexpected end of file, expected '\"'")]
    [InlineData("o \"a.obj\" (#, #, (1, 0, 1))", 18,
        "the scale (1, 0, 1) is singular: each factor must lie between 1e-100 and 1e100 in size")]
    [InlineData("p \"a.obj\" #", 12,
        "unexpected end of file: the placement of a physics object is followed by its restitution, from 0 to 1")]
    [InlineData("p \"a.obj\" (#, #, (1, 2, 3)) colour (1, 0, 0)", 29,
        "unexpected 'colour': the placement of a physics object is followed by its restitution, from 0 to 1")]
    [InlineData("p \"a.obj\" # 1.5", 13, "the coefficient of restitution must lie between 0 and 1")]
    [InlineData("p \"a.obj\" # -0.5", 13, "the coefficient of restitution must lie between 0 and 1")]
    [InlineData("p \"a.obj\" # 1 mass 0", 20, "the mass must be positive")]
    [InlineData("o \"a.obj\" # mass 5", 13, "unexpected 'mass': it is an option of physics objects, which a 'p' line declares")]
    [InlineData("o \"a.obj\" # rolling 5", 13, "unexpected 'rolling': it is an option of physics objects, which a 'p' line declares")]
    [InlineData("p \"a.obj\" # 1 belt (1, 0, 0)", 15,
        "unexpected 'belt': it is an option of objects that no force moves, which an 'o' line declares")]
    [InlineData("o \"a.obj\" # moving", 19, "unexpected end of file, expected 'velocity' or 'spin'")]
    [InlineData("o \"a.obj\" # moving (1, 0, 0)", 20, "unexpected '(', expected 'velocity' or 'spin'")]
    [InlineData("o \"a.obj\" # moving velocity (1, 0, 0) from (0, 0, 0)", 53, "unexpected end of file, expected 'to'")]
    [InlineData("o \"a.obj\" # moving velocity (1, 0, 0) from (0, 0, 0) to (0, 0, 0)", 44, "the ends of the path must differ")]
    [InlineData("o \"a.obj\" # moving velocity (1, 0, 0) from (0, 0, 0) to (0, 3, 0)", 29, "the velocity must lead along the path")]
    [InlineData("o \"a.obj\" # moving velocity (0, 0, 0) from (0, 0, 0) to (0, 3, 0)", 29,
        "the velocity along a path must not be (0, 0, 0)")]
    [InlineData("o \"a.obj\" # moving velocity (1, 0, 0) from (1, 0, 0) to (3, 0, 0)", 44,
        "the object's position must lie on the path, between its ends")]
    [InlineData("o \"a.obj\" # belt 3", 18, "unexpected '3', expected '('")]
    [InlineData("handed up", 8, "unexpected 'up', expected 'left' or 'right'")]
    [InlineData("projection fisheye", 12, "unexpected 'fisheye', expected 'perspective' or 'orthographic'")]
    [InlineData("projection orthographic 0", 25, "the visible height must be positive")]
    [InlineData("aspect 0", 8, "the aspect ratio must lie between 1:100 and 100:1")]
    [InlineData("aspect 16:0", 8, "the aspect ratio must lie between 1:100 and 100:1")]
    [InlineData("c # # 45 aperture -1", 19, "the aperture must lie between 0 and 1e30")]
    [InlineData("c # # 45 focus 0", 16, "the focus must lie between 1e-30 and 1e30")]
    [InlineData("clip 10 1", 6, "the clip planes must satisfy 0 < near < far")]
    [InlineData("clip 0 1", 6, "the clip planes must satisfy 0 < near < far")]
    [InlineData("background (1, 2, 3)", 12, "the components of a colour must lie between 0 and 1")]
    [InlineData("sky (0, 0, 1)", 14, "unexpected end of file, expected a colour (r, g, b)")]
    [InlineData("sky (0, 0, 1) (1, 1, 1) 2", 25, "unexpected '2', expected the end of the line or a colour (r, g, b)")]
    [InlineData("sky (0, 0, 1) (1, 1, 2)", 15, "the components of a colour must lie between 0 and 1")]
    [InlineData("sun (0, 0, 0) (1, 1, 1) 1", 5, "a direction must not be (0, 0, 0)")]
    [InlineData("sun (0, -1, 0) (1, 1, 1)", 25, "unexpected end of file, expected a number")]
    [InlineData("sun (0, -1, 0) (1, 1, 1) -1", 26, "the intensity of a light must not be negative")]
    [InlineData("sun (0, -1, 0) (1, 1, 1) 1 90", 28, "the diameter of the sun must be at least 0 and less than 90 degrees")]
    [InlineData("probe 1", 7, "unexpected '1', expected '('")]
    [InlineData("exposure auto 0", 15, "the exposure must be positive")]
    [InlineData("exposure auto 1e10", 15, "the exposure must lie between 1e-9 and 1e9")]
    [InlineData("exposure 0", 10, "the exposure must be positive")]
    [InlineData("exposure 1e20", 10, "the exposure must lie between 1e-9 and 1e9")]
    [InlineData("exposure 1e-10", 10, "the exposure must lie between 1e-9 and 1e9")]
    [InlineData("sun (0, -1, 0) (1, 1, 1) 2e9", 26, "the intensity of a light must not exceed 1e9")]
    [InlineData("tone film", 6, "unexpected 'film', expected 'none', 'filmic', 'reinhard' or 'aces'")]
    [InlineData("fog -0.1", 5, "the density of fog must not be negative")]
    [InlineData("fog 0.1 (2, 0, 0)", 9, "the components of a colour must lie between 0 and 1")]
    [InlineData("fog 0.1 (2, 0, 0) scatter 1", 9, "the components of a colour must lie between 0 and 1")]
    [InlineData("fog 0.1 scatter 1.1", 17, "the share that fog scatters must lie between 0 and 1")]
    [InlineData("fog 0.1 scatter -0.1", 17, "the share that fog scatters must lie between 0 and 1")]
    [InlineData("fog 0.1 scatter 1 forward 0.96", 27, "the anisotropy of fog must lie between -0.95 and 0.95")]
    [InlineData("fog 0.1 forward -1", 17, "the anisotropy of fog must lie between -0.95 and 0.95")]
    [InlineData("fog 0.1 scatter", 16, "unexpected end of file, expected a number")]
    [InlineData("fog 0.1 glow 1", 9, "unexpected 'glow', expected a colour (r, g, b), 'scatter', 'forward' or the end of the line")]
    [InlineData("light laser (1, 1, 1)", 7, "unexpected 'laser', expected 'ambient', 'directional', 'point', 'spot', 'ball' or 'quad'")]
    [InlineData("light directional (0, 0, 0) (1, 1, 1)", 19, "a direction must not be (0, 0, 0)")]
    [InlineData("light ambient (1, 1, 1) -1", 25, "the intensity of a light must not be negative")]
    [InlineData("light point (0, 0, 0) (1, 1, 1) 1", 34,
        "unexpected end of file: a point light is its position, colour, intensity and range")]
    [InlineData("light spot (0, 0, 0) (0, 0, 1) 45", 34,
        "unexpected end of file: a spot light is its position, direction, angle, colour, intensity and range")]
    [InlineData("light point (0, 0, 0) (1, 1, 1) 1 0", 35, "the range of a light must be positive")]
    [InlineData("light ball (0, 0, 0) 0 (1, 1, 1) 1 30", 22, "the radius of a light must be positive")]
    [InlineData("light ball (0, 0, 0) 1 (1, 1, 1) -1 30", 34, "the intensity of a light must not be negative")]
    [InlineData("light ball (0, 0, 0) 1e-5 (1, 1, 1) 1 30", 22, "the size of a light must lie between 1e-6 and 1e6 of its range")]
    [InlineData("light ball (0, 0, 0) 1 (1, 1, 1) 1 1e-7", 22, "the size of a light must lie between 1e-6 and 1e6 of its range")]
    [InlineData("light ball (0, 0, 0) 1 (1, 1, 1) 1", 35,
        "unexpected end of file: a ball light is its position, radius, colour, intensity and range")]
    [InlineData("light quad (0, 0, 0) (0, 0, 0) 2 1 (1, 1, 1) 1 30", 22, "a direction must not be (0, 0, 0)")]
    [InlineData("light quad (0, 0, 0) (0, 0, 1) 0 1 (1, 1, 1) 1 30", 32, "the width of a light must be positive")]
    [InlineData("light quad (0, 0, 0) (0, 0, 1) 2 -1 (1, 1, 1) 1 30", 34, "the height of a light must be positive")]
    [InlineData("light quad (0, 0, 0) (0, 0, 1) 2 1 (1, 1, 1) 1 30 x", 51, "unexpected 'x', expected the end of the line or a number")]
    [InlineData("light quad (0, 0, 0) (0, 0, 1) 2", 33,
        "unexpected end of file: a quad light is its position, direction, width, height, colour, intensity and range")]
    [InlineData("light spot (0, 0, 0) (0, 0, 1) 180 (1, 1, 1) 1 1", 32, "the angle of the cone must lie between 0 and 180 degrees")]
    [InlineData("o \"a.fdo\" # gradient", 21, "unexpected end of file, expected 'level', 'path', 'height', 'distance' or 'trap'")]
    [InlineData("o \"a.fdo\" # gradient none (1, 1, 1)", 22, "unexpected 'none', expected 'level', 'path', 'height', 'distance' or 'trap'")]
    [InlineData("o \"a.fdo\" # gradient (1, 1, 1)", 22, "unexpected '(', expected 'level', 'path', 'height', 'distance' or 'trap'")]
    [InlineData("o \"a.fdo\" # gradient level", 27,
        "unexpected end of file, expected the name of a palette in quotes, a colour (r, g, b) or a number")]
    [InlineData("o \"a.fdo\" # gradient path red", 27,
        "unexpected 'red', expected the name of a palette in quotes, a colour (r, g, b) or a number")]
    [InlineData("o \"a.fdo\" # gradient level \"Ember\"", 28,
        "there is no palette 'Ember'; there are: slate, bark, gold, ember, rose, plum, "
        + "dusk, ice, sea, lagoon, aurora, moss")]
    [InlineData("o \"a.fdo\" # gradient level \"ember", 34, "unexpected end of file, expected '\"'")]
    [InlineData("o \"a.fdo\" # gradient trap 0.5 (1, 1, 1)", 27, "a palette has two stops or more")]
    [InlineData("o \"a.fdo\" # gradient trap 0.5 (1, 1, 1) 0.4 (0, 0, 0)", 41, "the positions of a palette must ascend from 0 to 1")]
    [InlineData("o \"a.fdo\" # gradient trap -0.5 (1, 1, 1) 0.4 (0, 0, 0)", 27, "the positions of a palette must ascend from 0 to 1")]
    [InlineData("o \"a.fdo\" # gradient trap 0.5 (1, 1, 1) 1.4 (0, 0, 0)", 41, "the positions of a palette must ascend from 0 to 1")]
    [InlineData("o \"a.fdo\" # gradient trap 0.5 0.6 (0, 0, 0)", 31, "unexpected '0.6', expected a colour (r, g, b)")]
    [InlineData("o \"a.fdo\" # gradient height (1, 1, 1) (2, 0, 0)", 39, "the components of a colour must lie between 0 and 1")]
    [InlineData("o \"a.fdo\" # gradient level \"ember\" roughness 0 1.1", 48, "the roughness must lie between 0 and 1")]
    [InlineData("o \"a.fdo\" # gradient level \"ember\" metal -1 1", 42, "the share of metal must lie between 0 and 1")]
    [InlineData("o \"a.fdo\" # gradient level \"ember\" glow 1 1e10", 43, "the glow must lie between 0 and 1e9")]
    [InlineData("o \"a.fdo\" # gradient level \"ember\" glow 1", 42, "unexpected end of file, expected a blank or ','")]
    [InlineData("o \"a.fdo\" # gradient level (1, 2, 1)", 28, "the components of a colour must lie between 0 and 1")]
    [InlineData("player (0, 0, 0) 1 1", 18, "the player's radius must be positive, and the height at least twice as much")]
    [InlineData("p \"a.obj\" # 1 friction -0.1", 24, "the friction must not be negative")]
    [InlineData("p \"a.obj\" # 1 friction", 23, "unexpected end of file, expected a number")]
    [InlineData("p \"a.obj\" # 1 friction nan", 24, "unexpected 'nan', expected a number")]
    [InlineData("p \"a.obj\" # 1 friction 1e999", 24, "the number 1e999 is beyond the range of a double")]
    [InlineData("p \"a.obj\" # 1 rolling -1", 23, "the rolling friction must not be negative")]
    [InlineData("p \"a.obj\" # 1 spinning -1", 24, "the spinning friction must not be negative")]
    [InlineData("p \"a.obj\" # 1 inertia 0.7", 23, "the inertia must be positive and at most 2/3")]
    [InlineData("p \"a.obj\" # 1 shape", 20, "unexpected end of file, expected 'balls', 'mesh' or 'capsule'")]
    [InlineData("p \"a.obj\" # 1 shape cube", 21, "unexpected 'cube', expected 'balls', 'mesh' or 'capsule'")]
    [InlineData("p \"a.obj\" # 1 shape balls", 26, "unexpected end of file, expected a number")]
    [InlineData("p \"a.obj\" # 1 shape balls 0", 27, "a body has 1 to 64 balls")]
    [InlineData("p \"a.obj\" # 1 shape balls 2.5", 27, "a body has 1 to 64 balls")]
    [InlineData("p \"a.obj\" # 1 damping -1", 23, "the damping must not be negative")]
    [InlineData("p \"a.obj\" # 1 damping Infinity", 23, "unexpected 'Infinity', expected a number")]
    [InlineData("p \"a.obj\" # 1 shrink -1", 22, "the rate of shrinking must not be negative")]
    [InlineData("p \"a.obj\" # 1 shrink 1 0", 24, "the smallest scale must be more than 0 and no more than 1")]
    [InlineData("p \"a.obj\" # 1 shrink 1 -0.5", 24, "the smallest scale must be more than 0 and no more than 1")]
    [InlineData("p \"a.obj\" # 1 shrink 1, 1.5", 25, "the smallest scale must be more than 0 and no more than 1")]
    [InlineData("p \"a.obj\" # 1 shrink", 21, "unexpected end of file, expected a number")]
    [InlineData("p \"a.obj\" # 1 shrink 1, name", 25, "unexpected 'name', expected a number")]
    [InlineData("p \"a.obj\" # 1 shrink 1 -1e999", 24, "the number -1e999 is beyond the range of a double")]
    [InlineData("p \"a.obj\" # 1 velocity (0, nan, 0)", 28, "unexpected 'nan', expected a number")]
    [InlineData("p \"a.obj\" # 1 velocity (0, -1e999, 0)", 28, "the number -1e999 is beyond the range of a double")]
    [InlineData("p \"a.obj\" # 1 velocity (0, 0, Infinity)", 31, "unexpected 'Infinity', expected a number")]
    [InlineData("p \"a.obj\" # 1 mass inf", 20, "unexpected 'inf', expected a number")]
    [InlineData("p \"a.obj\" # 1 mass 1e999", 20, "the number 1e999 is beyond the range of a double")]
    [InlineData("p \"a.obj\" # NaN", 13, "unexpected 'NaN': the placement of a physics object is followed by its restitution, from 0 to 1")]
    [InlineData("gravity (0, -1e999, 0)", 13, "the number -1e999 is beyond the range of a double")]
    [InlineData("player (0, 5, 0) 1e-9 3", 18, "the player's height must be at most 1000 times the radius")]
    [InlineData("player (0, 0, 0) 1 2 speed -1", 28, "the player's speed must not be negative")]
    [InlineData("player (0, 0, 0) 1 2 jump -1", 27, "the speed of a jump must not be negative")]
    [InlineData("player (0, 0, 0) 1 2 slope -1", 28, "the player's slope must lie between 0 and 89 degrees")]
    [InlineData("player (0, 0, 0) 1 2 slope 89.5", 28, "the player's slope must lie between 0 and 89 degrees")]
    [InlineData("player (0, 0, 0) 1 2 step -1", 27, "the player's step must not be negative, and less than the height")]
    [InlineData("player (0, 0, 0) 1 2 step 2", 27, "the player's step must not be negative, and less than the height")]
    [InlineData("player (0, 0, 0) 1 2 speed", 27, "unexpected end of file, expected a number")]
    [InlineData("player (0, 0, 0) 1 2 speed nan", 28, "unexpected 'nan', expected a number")]
    [InlineData("player (0, 0, 0) 1 2 jump 1e999", 27, "the number 1e999 is beyond the range of a double")]
    [InlineData("player (0, 0, 0) 1 2 mass 3", 22, "unexpected 'mass', expected 'speed', 'jump', 'slope', 'step' or the end of the line")]
    [InlineData("player (0, 0, 0) 1 2speed 3", 21, "unexpected 'speed', expected a blank or the end of the line")]
    public void Line_ThatIsWrong_PointsAtTheFault(string line, int column, string message) => FailsAt(line, column, message);

    [Theory]
    [InlineData("c # # 60 70", 10)]
    [InlineData("c # # 60 # comment", 10)]
    [InlineData("o \"a.obj\" # 5", 13)]
    [InlineData("o \"a.obj\" # mass 5", 13)]
    [InlineData("o \"a.obj\" # colour", 19)]
    [InlineData("o \"a.obj\" # name x", 18)]
    [InlineData("p \"a.obj\" # 1 collider sphere", 24)]
    [InlineData("p \"a.obj\" # 1 velocity 3", 24)]
    [InlineData("p \"a.obj\" # 1 friction 0,5", 25)]
    [InlineData("p \"a.obj\" # 1 shrink 0.1 0.2 0.3", 30)]
    [InlineData("o \"a.obj\" # friction 1", 13)]
    [InlineData("player (0, 0, 0) 1 2 3", 22)]
    [InlineData("player (0, 0, 0) 1 2 speed 1 # fast", 30)]
    [InlineData("gravity -9.8", 9)]
    [InlineData("c (1,,2,3) # 60", 6)]
    [InlineData("C # # 60", 1)]
    [InlineData("o \"a.obj\" ((0,5, 0,5, 0,5), #, #)", 19)]
    public void Line_WithSomethingUnexpected_PointsAtIt(string line, int column)
    {
        var error = Errors.ThrownBy(() => Parse(line)).Diagnostic;
        Assert.Equal((1, column), (error.Line, error.Column));
        Assert.StartsWith("unexpected ", error.Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("c # # 60")]
    [InlineData("handed right")]
    [InlineData("projection perspective")]
    [InlineData("aspect 1")]
    [InlineData("clip 1 2")]
    [InlineData("background (0, 0, 0)")]
    [InlineData("sky (0, 0, 1) (1, 1, 1)")]
    [InlineData("probe (0, 1, 0)")]
    [InlineData("exposure 2")]
    [InlineData("tone none")]
    [InlineData("fog 0.1")]
    [InlineData("gravity #")]
    [InlineData("player (0, 0, 0) 1 2")]
    public void Declaration_OfASingletonTwice_IsRefused(string line) =>
        Fails($"{line}\n# again\n{line}\n",
        $"test.sdo:3:1: error: '{line.Split(' ')[0]}' is declared twice, first in line 1\n  {line}\n  ^");

    [Fact]
    public void Error_WithCommaDecimalsUnderAGermanCulture_IsTheSameEverywhere() => Assert.Equal(
        Errors.MessageOf(() => Parse("c (1,5, 2,5, 3,5) # 60")),
        InCulture.Run("de-DE", () => Errors.MessageOf(() => Parse("c (1,5, 2,5, 3,5) # 60"))));

    [Fact]
    public void Parse_OfAnyText_EndsInAResultOrOneProperError()
    {
        var parsedCount = 0;
        Seeded.Run(3000, random =>
        {
            var text = new StringBuilder(Samples.AppendixA + "\nlight spot (1, 2, 3) (0, -1, 0) 40 (0, 1, 0) 2, 30\n"
                + "p \"b.fdo\" # 1 mass 2 friction 1 shrink 0.1 0.5 name \"x\"\naspect 16:9\nplayer (0, 0, 0) 1 2 speed 1 step 0.5");
            for (var change = random.Next(1, 6); change > 0; change--)
            {
                const string characters = "\0\t\n\r \"#(),-.0159:acelmops§\uD83D";
                var offset = random.Next(text.Length);
                _ = random.Next(2) switch
                {
                    0 => text.Remove(offset, Math.Min(random.Next(1, 20), text.Length - offset)),
                    _ => text.Insert(offset, characters[random.Next(characters.Length)]),
                };
            }

            try
            {
                Assert.NotEmpty(Parse(text.ToString()).Lines);
                parsedCount++;
            }
            catch (SourceException error)
            {
                Assert.Matches(@"^test\.sdo:[1-9]\d*:[1-9]\d*: error: \S", error.Message);
            }
        });
        // Both happen, so that neither check is empty.
        Assert.InRange(parsedCount, 100, 2900);
    }
}
