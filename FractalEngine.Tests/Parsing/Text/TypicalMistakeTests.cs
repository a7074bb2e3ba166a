using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Text;

/// <summary>The mistakes that beginners make, each with the whole message that names it.</summary>
public class TypicalMistakeTests
{
    // The first five lines of each fractal; its mistake begins in line 6.
    private const string FractalHead = """
        v 1 2 3
        v 0.5 0.5 0.5
        t.a. (a, #, 2)
        x. "cube.obj"
        z<x>. [t.1] x

        """;

    public static TheoryData<string, string, string> FractalMistakes => new()
    {
        {
            "a comment behind a vector",
            """
            v 1 2 3 # the corner
            """,
            """
            tree.fdo:6:9: error: unexpected '#': a comment in a line begins with '//', since '#' within a declaration is a value
              v 1 2 3 # the corner
                      ^
            """
        },
        {
            "a comment behind the result",
            """
            <$>. z 6 # deep
            """,
            """
            tree.fdo:6:10: error: unexpected '#': a comment in a line begins with '//', since '#' within a declaration is a value
              <$>. z 6 # deep
                       ^
            """
        },
        {
            "commas as decimal points",
            """
            v 0,5 0,5 0,5
            """,
            """
            tree.fdo:6:8: error: unexpected ',': the decimal point is a point, so write 0.5 instead of 0,5
              v 0,5 0,5 0,5
                     ^
            """
        },
        {
            "one comma as decimal point",
            """
            v 0,5 1 2
            """,
            """
            tree.fdo:6:9: error: unexpected '2': the decimal point is a point, so write 0.5 instead of 0,5
              v 0,5 1 2
                      ^
            """
        },
        {
            "a missing third number",
            """
            v 1 2
            """,
            """
            tree.fdo:6:6: error: unexpected end of file: a vector has three numbers, and this one has two
              v 1 2
                   ^
            """
        },
        {
            "no blank behind 'v'",
            """
            v1 2 3
            """,
            """
            tree.fdo:6:3: error: unexpected ' ': a vector is 'v', a blank and three numbers
              v1 2 3
                ^
            """
        },
        {
            "a missing dot in a call",
            """
            y. [t1] x
            """,
            """
            tree.fdo:6:5: error: the transformation 't1' is not declared above: did you mean 't.1'?
              y. [t1] x
                  ^
            """
        },
        {
            "a call without dot and number",
            """
            y. [t] x
            """,
            """
            tree.fdo:6:6: error: unexpected ']': a dot is missing behind 't': a call has the numbers of its vectors behind dots, as in 't.1'
              y. [t] x
                   ^
            """
        },
        {
            "arguments in parentheses",
            """
            y. [t(1)] x
            """,
            """
            tree.fdo:6:6: error: unexpected '(': a dot is missing behind 't': a call has the numbers of its vectors behind dots, as in 't.1'
              y. [t(1)] x
                   ^
            """
        },
        {
            "a blank within a call",
            """
            y. [t.1 2] x
            """,
            """
            tree.fdo:6:9: error: unexpected '2': the numbers of a call follow its name with dots and without blanks, as in 't.1.2'
              y. [t.1 2] x
                      ^
            """
        },
        {
            "a parameter without its dot",
            """
            u.a (a, #, 2)
            """,
            """
            tree.fdo:6:5: error: unexpected '(': a dot is missing behind 'a': each parameter of a transformation ends with one, as in 't.a.'
              u.a (a, #, 2)
                  ^
            """
        },
        {
            "a declaration without its dot",
            """
            y "cube.obj"
            """,
            """
            tree.fdo:6:2: error: unexpected ' ': a dot is missing behind 'y'
              y "cube.obj"
               ^
            """
        },
        {
            "a result without its dot",
            """
            <$> z 6
            """,
            """
            tree.fdo:6:4: error: unexpected ' ': a dot is missing behind '<$>'
              <$> z 6
                 ^
            """
        },
        {
            "an angle as vector number",
            """
            u.a. (a, 45, #)
            """,
            """
            tree.fdo:6:10: error: vector 45 of 2: it is not declared, and numbers stand in parentheses
              u.a. (a, 45, #)
                       ^
            """
        },
        {
            "a decimal as vector number",
            """
            u.a. (a, #, 0.5)
            """,
            """
            tree.fdo:6:13: error: unexpected '0.5': numbers stand in parentheses, as in '(0.5)' or '(0, 1, 0)', but for that of a vector
              u.a. (a, #, 0.5)
                          ^
            """
        },
        {
            "a vector without commas",
            """
            u.a. (a, #, (0.5 0.5 0.5))
            """,
            """
            tree.fdo:6:18: error: unexpected '0.5': commas stand between the components of a vector, as in '(0, 1, 0)'
              u.a. (a, #, (0.5 0.5 0.5))
                               ^
            """
        },
        {
            "a depth with a fraction",
            """
            <$>. z 3.5
            """,
            """
            tree.fdo:6:9: error: unexpected '.': a depth is a whole number
              <$>. z 3.5
                      ^
            """
        },
        {
            "parentheses around a vector",
            """
            v (0, 1, 0)
            """,
            """
            tree.fdo:6:3: error: unexpected '(': the numbers of a vector stand without parentheses, as in 'v 0 1 0'
              v (0, 1, 0)
                ^
            """
        },
        {
            "a blank within a call",
            """
            y. [#, t. 1] x
            """,
            """
            tree.fdo:6:8: error: 't' takes 1 argument, not 0: no blank stands within a call
              y. [#, t. 1] x
                     ^
            """
        },
        {
            "a depth without its recursive",
            """
            <$>. 6
            """,
            """
            tree.fdo:6:6: error: unexpected '6': a depth follows the name of a recursive, as in 'z 6'
              <$>. 6
                   ^
            """
        },
        {
            "a dot before the depth",
            """
            <$>. z.6
            """,
            """
            tree.fdo:6:7: error: unexpected '.': a blank stands between a recursive and its depth, as in 'z 6'
              <$>. z.6
                    ^
            """
        },
        {
            "no blank before the depth",
            """
            <$>. z6
            """,
            """
            tree.fdo:6:6: error: the object 'z6' is not declared above: did you mean 'z 6'?
              <$>. z6
                   ^
            """
        },
        {
            "a misspelt object",
            """
            stem. x
            y. [#] stme
            """,
            """
            tree.fdo:7:8: error: the object 'stme' is not declared above: did you mean 'stem'?
              y. [#] stme
                     ^
            """
        },
        {
            "a set without its bracket",
            """
            y. [t.1 t.2 x
            """,
            """
            tree.fdo:6:13: error: the transformation 'x' is not declared above: 'x' is an object, and a set ends with ']' before it
              y. [t.1 t.2 x
                          ^
            """
        },
        {
            "a file name without quotes",
            """
            y. cube.obj
            """,
            """
            tree.fdo:6:8: error: unexpected '.': the name of a file stands in quotes
              y. cube.obj
                     ^
            """
        },
    };

    public static TheoryData<string, string, string> SceneMistakes => new()
    {
        {
            "a missing third number",
            """
            c (1, 2) # 60
            """,
            """
            room.sdo:1:8: error: unexpected ')': a vector has three numbers, and this one has two
              c (1, 2) # 60
                     ^
            """
        },
        {
            "a comma as decimal point",
            """
            c # # 60,5
            """,
            """
            room.sdo:1:9: error: unexpected ',': the decimal point is a point, so write 60.5 instead of 60,5
              c # # 60,5
                      ^
            """
        },
        {
            "a shape in place of a file",
            """
            p ball (#, #, #) 0.5
            """,
            """
            room.sdo:1:3: error: unexpected 'ball': a scene takes a shape from a fractal file, such as one with the line '<$>. ball'
              p ball (#, #, #) 0.5
                ^
            """
        },
        {
            "a comment behind an object",
            """
            o "cube.obj" # # red
            """,
            """
            room.sdo:1:16: error: unexpected '#': a comment stands on a line of its own, since '#' within a declaration is a value
              o "cube.obj" # # red
                             ^
            """
        },
        {
            "a position as placement",
            """
            o "cube.obj" (0, 1, 0)
            """,
            """
            room.sdo:1:15: error: unexpected '0': a placement is '#' or three vectors in parentheses, (position, rotation, scale)
              o "cube.obj" (0, 1, 0)
                            ^
            """
        },
        {
            "no placement",
            """
            o "cube.obj"
            """,
            """
            room.sdo:1:13: error: unexpected end of file: a placement is '#' or three vectors in parentheses, (position, rotation, scale)
              o "cube.obj"
                          ^
            """
        },
        {
            "a misspelt declaration",
            """
            gravty (0, -1, 0)
            """,
            """
            room.sdo:1:1: error: unexpected 'gravty': did you mean 'gravity'?
              gravty (0, -1, 0)
              ^
            """
        },
        {
            "a misspelt option",
            """
            p "a.obj" # 1 mas 3
            """,
            """
            room.sdo:1:15: error: unexpected 'mas': did you mean 'mass'?
              p "a.obj" # 1 mas 3
                            ^
            """
        },
        {
            "a capital letter",
            """
            Light ambient (1,1,1)
            """,
            """
            room.sdo:1:1: error: unexpected 'Light': did you mean 'light'?
              Light ambient (1,1,1)
              ^
            """
        },
        {
            "a whole word for a camera",
            """
            camera # # 60
            """,
            """
            room.sdo:1:1: error: unexpected 'camera': a camera is declared by 'c'
              camera # # 60
              ^
            """
        },
        {
            "the name of a colour",
            """
            background black
            """,
            """
            room.sdo:1:12: error: unexpected 'black', expected a colour (r, g, b)
              background black
                         ^
            """
        },
    };

    [Theory]
    [MemberData(nameof(FractalMistakes))]
    public void Fractal_WithATypicalMistake_NamesIt(string mistake, string text, string message)
    {
        Assert.NotEmpty(mistake);
        Errors.AssertMessage(message, () => FractalParser.Parse(new("tree.fdo", FractalHead + text)));
    }

    [Theory]
    [MemberData(nameof(SceneMistakes))]
    public void Scene_WithATypicalMistake_NamesIt(string mistake, string text, string message)
    {
        Assert.NotEmpty(mistake);
        Errors.AssertMessage(message, () => SceneParser.Parse(new("room.sdo", text)));
    }

    [Theory]
    [InlineData("0 1.5708 0", "(0, 1.5708, 0)", "1.5708 radians are 90 degrees")]
    [InlineData("0.785 0 -3.14", "(0.785, 0, -3.14)", "0.785 radians are 45 degrees")]
    public void Fractal_WithRadians_IsReadWithAHint(string numbers, string rotation, string equation)
    {
        var fractal = FractalParser.Parse(new("tree.fdo", $"v {numbers}\nt. (#, 1, #)\nx. \"cube.obj\"\n<$>. [t.] x"));
        Assert.Equal(
            $"tree.fdo:4:7: warning: the rotation {rotation} looks like radians, but is in degrees here: {equation}\n"
            + "  <$>. [t.] x\n        ^",
            Assert.Single(fractal.Warnings).ToString());
    }

    [Theory]
    [InlineData("0 90 0")]
    [InlineData("0 1 0")]
    [InlineData("0 0.5 0")]
    [InlineData("0 1.5708 8")]
    public void Fractal_WithDegrees_HasNoHint(string numbers) =>
        Assert.Empty(FractalParser.Parse(new("tree.fdo", $"v {numbers}\nt. (#, 1, #)\n<$>. [t.] \"cube.obj\"")).Warnings);

    [Fact]
    public void Camera_WithDegrees_IsReadWithAHint() => Assert.Equal(
        """
        room.sdo:1:13: warning: the rotation (0, 45, 0) looks like degrees, but is in radians here: 45 degrees are 0.7854 radians
          c (1, 2, 3) (0, 45, 0) 60
                      ^
        """,
        Assert.Single(SceneParser.Parse(new("room.sdo", "c (1, 2, 3) (0, 45, 0) 60")).Warnings).ToString());

    [Fact]
    public void Camera_WithALargeRotation_IsConvertedWithoutOverflow() => Assert.EndsWith(
        ": 1E+308 degrees are 1.7453292519943295E+306 radians",
        Assert.Single(SceneParser.Parse(new("room.sdo", "c (1, 2, 3) (0, 1e308, 0) 60")).Warnings).Message, StringComparison.Ordinal);

    [Fact]
    public void Object_WithRadians_IsReadWithAHint() => Assert.Equal(
        """
        room.sdo:1:18: warning: the rotation (0, 1.5708, 0) looks like radians, but is in degrees here: 1.5708 radians are 90 degrees
          o "cube.obj" (#, (0, 1.5708, 0), #)
                           ^
        """,
        Assert.Single(SceneParser.Parse(new("room.sdo", "o \"cube.obj\" (#, (0, 1.5708, 0), #)")).Warnings).ToString());

    [Fact]
    public void Set_WithBlanksInPlaceOfCommas_IsRead() =>
        Assert.Equal("cube.obj", FractalParser.Parse(new("tree.fdo", FractalHead + "<$>. [#, t.1 t.2] x")).BaseFile);
}
