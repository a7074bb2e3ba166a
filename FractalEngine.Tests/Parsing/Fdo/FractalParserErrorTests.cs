using System.Text;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Fdo;

/// <summary>Compares whole messages: these tests specify what a user reads.</summary>
public class FractalParserErrorTests
{
    private const string Head = "v 1 2 3\nv 2 2 2\nt.a. (a, #, #)\nx. \"b.obj\"\nz<x>. [t.1] x\n";

    private static void Fails(string text, string expected) => Errors.AssertMessage(expected, () => Samples.ParseFractal(text));

    [Fact]
    public void File_WithoutAnything_SaysSo() => Fails("", "test.fdo:1:1: error: the fractal declares nothing");

    [Fact]
    public void File_OfComments_SaysSo() => Fails("# one\n# two\n", """
        test.fdo:1:1: error: the fractal declares nothing
          # one
          ^
        """);

    [Fact]
    public void File_WithoutAResult_SaysWhatIsExpected()
    {
        var error = Errors.MessageOf(() => Samples.ParseFractal("v 1 2 3\nx. \"b.obj\"\n"));
        Assert.Contains("error: the fractal has no result: expected a declaration '<$>. object'", error, StringComparison.Ordinal);
    }

    [Fact]
    public void File_WithTwoResults_NamesTheFirst() => Fails("<$>. \"a.obj\"\n\n<$>. \"b.obj\"", """
        test.fdo:3:1: error: the result '<$>' is declared twice, first in line 1
          <$>. "b.obj"
          ^
        """);

    [Fact]
    public void Object_UsedBeforeItsDeclaration_IsUnknown() => Fails("<$>. [#] x\nx. \"b.obj\"", """
        test.fdo:1:10: error: the object 'x' is not declared above
          <$>. [#] x
                   ^
        """);

    [Fact]
    public void Transformation_UsedBeforeItsDeclaration_IsUnknown() => Fails("v 1 2 3\n<$>. [#, t.1] \"b.obj\"\nt.a. (a, #, #)", """
        test.fdo:2:10: error: the transformation 't' is not declared above
          <$>. [#, t.1] "b.obj"
                   ^
        """);

    [Fact]
    public void Recursive_OnAnUnknownBase_IsRefused() => Fails("x. \"b.obj\"\nz<y>. [#] x\n<$>. z 2", """
        test.fdo:2:3: error: the object 'y' is not declared above
          z<y>. [#] x
            ^
        """);

    [Fact]
    public void Recursive_UsedInItsOwnBody_IsCalledByItsBase() => Fails("x. \"b.obj\"\nz<x>. [#] z\n<$>. z 2", """
        test.fdo:2:11: error: within its own declaration, the recursive 'z' is called by the name of its base, 'x'
          z<x>. [#] z
                    ^
        """);

    [Theory]
    [InlineData("19", "vector 19 of 2: it is not declared above, and numbers stand in parentheses")]
    [InlineData("0", "vector 0 of 2: vectors are numbered from 1, and numbers stand in parentheses")]
    [InlineData("3", "vector 3 of 2: it is not declared above, and numbers stand in parentheses")]
    public void Call_WithAVectorNumberOutOfRange_SaysHowManyThereAre(string number, string message) =>
        Fails(Head + $"<$>. [t.{number}] x", $"""
        test.fdo:6:9: error: {message}
          <$>. [t.{number}] x
                  ^
        """);

    [Fact]
    public void Call_WithAHugeVectorNumber_IsOutOfRange() =>
        Assert.Contains("test.fdo:6:9: error: vector ",
        Errors.MessageOf(() => Samples.ParseFractal(Head + "<$>. [t.99999999999999999999] x")),
        StringComparison.Ordinal);

    [Fact]
    public void Function_WithAVectorNumberOutOfRange_SaysHowManyThereAre() => Fails("v 1 1 1\nt. (1, 2, #)\n<$>. [t.] \"b.obj\"", """
        test.fdo:2:8: error: vector 2 of 1: it is not declared above the call in line 3, and numbers stand in parentheses
          t. (1, 2, #)
                 ^
        """);

    [Fact]
    public void Function_CalledAboveItsVector_SaysWhichCall() => Fails("t. (2, 1, #)\nv 1 1 1\n<$>. [t.] \"b.obj\"\nv 2 2 2", """
        test.fdo:1:5: error: vector 2 of 1: it is not declared above the call in line 3, and numbers stand in parentheses
          t. (2, 1, #)
              ^
        """);

    [Fact]
    public void Function_NeverCalledWithAVectorThatIsNeverDeclared_IsRefused() => Fails("t. (#, 1, 2)\nv 1 1 1\n<$>. \"b.obj\"", """
        test.fdo:1:11: error: vector 2 of 1: it is not declared, and numbers stand in parentheses
          t. (#, 1, 2)
                    ^
        """);

    [Fact]
    public void Function_WithAVectorBelowIt_TakesItWhenItIsCalled()
    {
        var fractal = Samples.ParseFractal("t.a. (2, #, a)\nv 1 2 3\nv 4 5 6\nx. \"b.obj\"\n<$>. [t.1] x");
        var set = Assert.IsType<TransformationSet>(Assert.Single(fractal.Description.Steps));
        Assert.Equal(new(new(4, 5, 6), new(0, 0, 0), new(1, 2, 3)), Assert.Single(set.Transformations));
    }

    // The paper's names are strings. A hyphen before a letter belongs to a name, and before a digit it does not.
    [Fact]
    public void Names_WithHyphens_AreNames()
    {
        var fractal = Samples.ParseFractal(
            "v .5 .5 .5\nmove-up.by-x. (by-x, #, #)\nmy-base. \"b.obj\"\nmy-tree<my-base>. [move-up.1] my-base\n<$>. my-tree 3");
        Assert.Equal(3, Assert.IsType<Repetition>(Assert.Single(fractal.Description.Steps)).Count);
        Assert.Throws<SourceException>(() => Samples.ParseFractal("x. \"b.obj\"\nz<x>. [#] x\n<$>. z-5"));
    }

    [Theory]
    [InlineData("t.1.2", "'t' takes 1 argument, not 2")]
    [InlineData("t.", "'t' takes 1 argument, not 0")]
    [InlineData("t", "'t' takes 1 argument, not 0")]
    [InlineData("t.1.2.1", "'t' takes 1 argument, not 3")]
    [InlineData("t.1.2.1.2.1", "'t' takes 1 argument, not 5")]
    public void Call_WithTheWrongNumberOfArguments_SaysBoth(string call, string message)
    {
        var error = Errors.ThrownBy(() => Samples.ParseFractal(Head + $"<$>. [#, {call}] x")).Diagnostic;
        // A bare name may also be read as a missing dot.
        var isMissingDot = error.Message.StartsWith("unexpected ']': a dot is missing behind 't'", StringComparison.Ordinal);
        Assert.True(error.Message == message || (call == "t" && isMissingDot), error.Message);
        Assert.Equal(6, error.Line);
    }

    [Fact]
    public void Depth_OfANonRecursive_IsRefused() => Fails("x. \"b.obj\"\n<$>. x 6", """
        test.fdo:2:8: error: 'x' is no recursive, so it has no depth
          <$>. x 6
                 ^
        """);

    [Fact]
    public void Depth_OfAFlattenedRecursive_IsRefused() => Fails(Head + "w. z 2\n<$>. w 3", """
        test.fdo:7:8: error: 'w' is no recursive, so it has no depth
          <$>. w 3
                 ^
        """);

    [Fact]
    public void Depth_BelowZero_IsRefused() => Fails(Head + "<$>. z -1", """
        test.fdo:6:8: error: the depth of a recursive must not be negative
          <$>. z -1
                 ^
        """);

    [Theory]
    [InlineData("1000001")]
    [InlineData("2147483648")]
    [InlineData("99999999999999999999999")]
    public void Depth_BeyondTheLimit_NamesIt(string depth)
    {
        Fails(Head + $"<$>. z {depth}", $"""
            test.fdo:6:8: error: the depth is more than the limit of {FractalLimits.Depth.Value}
              <$>. z {depth}
                     ^
            """);
        Assert.True(Errors.ThrownBy(() => Samples.ParseFractal(Head + $"<$>. z {depth}")).Diagnostic.IsLimitExceeded);
    }

    [Fact]
    public void Depth_WithAFraction_IsRefused() =>
        Assert.StartsWith("test.fdo:6:9: error: unexpected '.", Errors.MessageOf(() => Samples.ParseFractal(Head + "<$>. z 2.5")),
        StringComparison.Ordinal);

    [Fact]
    public void Recursive_NotBuiltOnItsBase_IsRefused() => Fails("x. \"b.obj\"\ny. \"b.obj\"\nz<x>. [#] y\n<$>. z 2", """
        test.fdo:3:7: error: the body of the recursive 'z' is not built on its base 'x'
          z<x>. [#] y
                ^
        """);

    [Fact]
    public void Recursive_OfARoundWithoutLevels_IsItsBase()
    {
        var fractal = Samples.ParseFractal("x. \"b.obj\"\nr<x>. [#] x\ns<x>. r 0\n<$>. s");
        Assert.False(fractal.Description.IsInfinite);
        Assert.Equal(0, fractal.Description.Steps.Sum(step => step.LevelCount));
    }

    [Fact]
    public void Recursive_OnSomethingBelowItsBase_IsRefused() => Fails("x. \"b.obj\"\ny. [#] x\nz<y>. [#] x\n<$>. z 2", """
        test.fdo:3:7: error: the body of the recursive 'z' is not built on its base 'y'
          z<y>. [#] x
                ^
        """);

    [Fact]
    public void Name_DeclaredTwice_IsRefused() => Fails("x. \"a.obj\"\nx. \"b.obj\"\n<$>. x", """
        test.fdo:2:1: error: the object 'x' is declared twice, first in line 1
          x. "b.obj"
          ^
        """);

    [Fact]
    public void Handedness_DeclaredTwice_IsRefused() => Fails("handed left\nhanded right\n<$>. \"b.obj\"", """
        test.fdo:2:1: error: the handedness is declared twice, first in line 1
          handed right
          ^
        """);

    [Fact]
    public void Composition_DeclaredTwice_IsRefused() => Fails("# a\ncomposition affine\ncomposition componentwise\n<$>. \"b.obj\"", """
        test.fdo:3:1: error: the composition is declared twice, first in line 2
          composition componentwise
          ^
        """);

    [Fact]
    public void Function_DeclaredTwice_IsRefused() => Fails("t. (#, #, #)\nt.a. (a, #, #)\n<$>. \"b.obj\"", """
        test.fdo:2:1: error: the transformation 't' is declared twice, first in line 1
          t.a. (a, #, #)
          ^
        """);

    [Fact]
    public void Function_WithAParameterTwice_IsRefused() => Fails("t.a.a. (a, #, #)", """
        test.fdo:1:5: error: the parameter 'a' is named twice
          t.a.a. (a, #, #)
              ^
        """);

    [Fact]
    public void Function_WithFourParameters_IsRefused() => Fails("t.a.b.c.d. (a, b, c)", """
        test.fdo:1:9: error: a transformation has at most 3 parameters
          t.a.b.c.d. (a, b, c)
                  ^
        """);

    [Theory]
    [InlineData("t. (#, #)", 9)]
    [InlineData("t. (#, #, #, #)", 12)]
    [InlineData("t. (#, #, #", 12)]
    [InlineData("t.a. (a, #, #) #", 16)]
    public void Function_OfTheWrongShape_PointsAtTheFault(string line, int column)
    {
        var error = Errors.ThrownBy(() => Samples.ParseFractal(line + "\n<$>. \"b.obj\"")).Diagnostic;
        Assert.Equal((1, column), (error.Line, error.Column));
        Assert.StartsWith("unexpected ", error.Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("v 1 2", 6, "end of line")]
    [InlineData("v 1 2 3 4", 9, "'4'")]
    [InlineData("v 1 2 x", 7, "'x'")]
    [InlineData("v 1 2,, 3", 7, "','")]
    [InlineData("v (1, 2, 3)", 3, "'('")]
    [InlineData("v 1 nan 2", 5, "'nan'")]
    [InlineData("v 1 Infinity 2", 5, "'Infinity'")]
    [InlineData("v 1 0x10 2", 6, "'x10'")]
    public void Vector_OfTheWrongShape_PointsAtTheFault(string line, int column, string unexpected)
    {
        var error = Errors.ThrownBy(() => Samples.ParseFractal(line + "\n<$>. \"b.obj\"")).Diagnostic;
        Assert.Equal((1, column), (error.Line, error.Column));
        Assert.StartsWith($"unexpected {unexpected}", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Vector_BeyondADouble_IsRefused() => Fails("v 1 1e400 2", """
        test.fdo:1:5: error: the number 1e400 is beyond the range of a double
          v 1 1e400 2
              ^
        """);

    [Fact]
    public void Vector_WithCommaDecimals_HasTooManyNumbers() =>
        Assert.StartsWith("test.fdo:1:",
        InCulture.Run("de-DE", () => Errors.MessageOf(() => Samples.ParseFractal("v 0,5 0,5 0,5\n<$>. \"b.obj\""))),
        StringComparison.Ordinal);

    [Theory]
    [InlineData("x. \"Base.sdo\"")]
    [InlineData("x. \"Base\"")]
    [InlineData("x. \"\"")]
    public void BaseFile_ThatIsNoMesh_IsRefused(string line) => Fails(line + "\n<$>. x", $"""
        test.fdo:1:4: error: expected the name of a mesh ({FileKinds.MeshEndings}) or fractal (.fdo): that is the base of a fractal
          {line}
             ^
        """);

    [Fact]
    public void BaseFile_WithoutItsClosingQuote_PointsAtTheEndOfTheLine() =>
        Assert.StartsWith("test.fdo:1:10: error: unexpected end of line, expected '\"'",
        Errors.MessageOf(() => Samples.ParseFractal("x. \"b.obj\n<$>. x")), StringComparison.Ordinal);

    [Fact]
    public void Scale_OfZero_IsSingular() => Assert.StartsWith(
        "test.fdo:3:7: error: the scale (1, 0, 1) is singular",
        Errors.MessageOf(() => Samples.ParseFractal("v 1 0 1\nt.a. (#, #, a)\n<$>. [t.1] \"b.obj\"")), StringComparison.Ordinal);

    [Fact]
    public void Infinite_Componentwise_IsRefused() => Assert.Contains(
        "infinite fractal can't be composed componentwise",
        Errors.MessageOf(() => Samples.ParseFractal("composition componentwise\n" + Head + "<$>. z")), StringComparison.Ordinal);

    [Theory]
    [InlineData("composition sideways", 13)]
    [InlineData("composition", 12)]
    [InlineData("composition affine affine", 20)]
    public void Composition_OfTheWrongShape_PointsAtTheFault(string line, int column)
    {
        var error = Errors.ThrownBy(() => Samples.ParseFractal(line + "\n<$>. \"b.obj\"")).Diagnostic;
        Assert.Equal((1, column), (error.Line, error.Column));
    }

    [Fact]
    public void Garbage_AtTheStartOfALine_PointsAtIt()
    {
        var error = Errors.MessageOf(() => Samples.ParseFractal("v 1 2 3\n  § what\n"));
        Assert.StartsWith("test.fdo:2:3: error: unexpected '§', expected ", error, StringComparison.Ordinal);
        Assert.EndsWith("\n    § what\n    ^", error, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("\n")]
    [InlineData("\r\n")]
    public void Error_AfterAnyLineBreaks_HasTheRightLine(string lineBreak)
    {
        var error =
            Errors.ThrownBy(() => Samples.ParseFractal($"# one{lineBreak}{lineBreak}v 1 2 3{lineBreak}<$>. y{lineBreak}")).Diagnostic;
        Assert.Equal((4, 6, "<$>. y"), (error.Line, error.Column, error.SourceLine));
    }

    [Theory]
    [InlineData(0, "the object has more than the limit of 1000 steps, or of 32 recursives inside each other")]
    [InlineData(1, null)]
    [InlineData(2, "the object has more than the limit of 1000 steps, or of 32 recursives inside each other")]
    [InlineData(3, "the object has more than the limit of 1000 steps, or of 32 recursives inside each other")]
    [InlineData(4, null)]
    [InlineData(5, "unexpected '[', expected '#', '(' or the name of a transformation")]
    [InlineData(6, null)]
    public void Parse_OfEnormousFiles_GivesAResultOrAShortMessageInLinearTime(int kind, string? message)
    {
        const int count = 100_000;
        var text = kind switch
        {
            0 => "<$>. " + Repeat("[#] ", count) + "\"b.obj\"",
            1 => Repeat("v 1 2 3\n", count) + "<$>. \"b.obj\"",
            2 => "x0. \"b.obj\"\n" + Lines(count, i => $"x{i + 1}. [#] x{i}\n") + $"<$>. x{count}",
            3 => "x0. \"b.obj\"\n" + Lines(count, i => $"r{i}<x{i}>. [#] x{i}\nx{i + 1}. r{i} 2\n") + $"<$>. x{count}",
            4 => "t. (#, #, #)\n<$>. [" + Repeat("t., ", count) + "#] \"b.obj\"",
            5 => "<$>. " + Repeat("[", count),
            _ => Repeat("# comment\n", count) + "x. \"b.obj\"\n" + Lines(count, i => $"z{i}<x>. [#] x\n") + "<$>. z0 1000",
        };
        // It takes half a second at most. The square of the lines would be ten thousand million.
        var error = ProcessorTime.RunWithin(15, () => Record.Exception(() => Samples.ParseFractal(text)));
        Assert.Equal(message, (error as SourceException)?.Diagnostic.Message ?? error?.ToString());
    }

    [Fact]
    public void Parse_OfManySteps_NamesTheLimit()
    {
        var error =
            Errors.ThrownBy(() => Samples.ParseFractal($"<$>. {Repeat("[#] ", (int)FractalLimits.Steps.Value + 1)}\"b.obj\"")).Diagnostic;
        Assert.True(error.IsLimitExceeded);
        Assert.Contains($"{FractalLimits.Steps.Value}", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Parse_OfRecursivesInRecursives_NamesTheLimit()
    {
        var error =
            Errors.ThrownBy(
                () => Samples.ParseFractal("x. \"b.obj\"\ny0. [#] x\n" + Lines(40, i => $"z{i}<x>. [#] y{i}\ny{i + 1}. z{i} 1\n")
                    + "<$>. y40")).Diagnostic;
        Assert.True(error.IsLimitExceeded);
        Assert.Contains($"{FractalLimits.Nesting.Value}", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Parse_OfMillionsToThePowerOfMillions_NamesTheLimit()
    {
        var error =
            Errors.ThrownBy(
                () => Samples.ParseFractal("x. \"b.obj\"\nz<x>. [#, #] x\ny. z 1000000\nw<x>. [#] y\n<$>. w 1000000")).Diagnostic;
        Assert.True(error.IsLimitExceeded);
        Assert.Contains($"{FractalLimits.Levels.Value}", error.Message, StringComparison.Ordinal);
    }

    private const string Language = """
        k0 = 2  // a base
        k = (1 + sin(30))^2/max(k0, 3) from 0 to 9
        up = (0, k, -1)
        m.matrix (1) up (0, 0, 2) (k)
        t.p.n. (p, (n*2, 0, mod(n, 7)), (0.5))
        z<box>. [t.up.(3)^-1..2 * m., #, t.(1, 2, 3).k] [t.up.(k - 1)] box
        <$>. [m.^-2..(k0), t.up.(0)*m.] z (k0*2)
        """;

    private const string Sums = """
        b. box
        l. "leaf.obj" + (b + "inner.fdo")
        g. ((0, 1, 0), #, (1/2))
        turn. (#, (0, 120, 0), #)
        z<l>. [g.] l + [turn.^0..2] ([g.] l + b) + ball
        leader<l>, bough<b>. [g.] l + [turn., #] [g.] b + z 2, [g.] b + l
        y. (z (3 + 1) + leader 2)
        <$>. [g.] y + bough 5 + b
        """;

    [Fact]
    public void Parse_OfAnyText_EndsInAResultOrOneProperError() => CheckMutations(Samples.AppendixB, 3000);

    [Fact]
    public void Parse_OfAnyExpressions_EndsInAResultOrOneProperError() => CheckMutations(Language, 3000);

    [Fact]
    public void Parse_OfAnySums_EndsInAResultOrOneProperError() => CheckMutations(Sums, 3000);

    [Theory]
    [InlineData(Samples.AppendixB)]
    [InlineData(Language)]
    [InlineData(Sums)]
    [Trait("Category", "Soak")]
    public void Parse_OfAMillionTexts_EndsInAResultOrOneProperError(string original) => CheckMutations(original, 1_000_000);

    private static void CheckMutations(string original, int count)
    {
        var parsedCount = 0;
        Seeded.Run(count, random =>
        {
            var text = new StringBuilder(original);
            for (var change = random.Next(1, 6); change > 0; change--)
            {
                const string characters = "\0\t\n\r \"#$(),-.0159<>[]aetuvxyz§\uD83D=+*/^kmpsin";
                var offset = random.Next(text.Length);
                _ = random.Next(4) switch
                {
                    0 => text.Remove(offset, Math.Min(random.Next(1, 20), text.Length - offset)),
                    1 => text.Insert(offset, characters[random.Next(characters.Length)]),
                    2 => text.Insert(offset, original.AsSpan(random.Next(original.Length - 10), random.Next(1, 10))),
                    _ => text.Replace(text[offset], characters[random.Next(characters.Length)], offset, 1),
                };
            }

            try
            {
                Assert.NotEmpty(Samples.ParseFractal(text.ToString()).BaseFile);
                parsedCount++;
            }
            catch (SourceException error)
            {
                Assert.Matches(@"^test\.fdo:[1-9]\d*:[1-9]\d*: error: \S", error.Message);
            }
        });
        // Both happen, so that neither check is empty.
        Assert.InRange(parsedCount, count / 100, count - (count / 30));
    }

    private static string Repeat(string text, int count) => new StringBuilder().Insert(0, text, count).ToString();

    private static string Lines(int count, Func<int, string> line) => string.Concat(Enumerable.Range(0, count).Select(line));

    [Fact]
    public void Function_WithAnUnknownOutput_IsTheManualsExample() => Errors.AssertMessage(
        """
        assets/fractals/tree.fdo:4:12: error: unexpected 'x': no parameter and no vector above has this name
          t.a.b. (a, x, b)
                     ^
        """,
        () => FractalParser.Parse(new("assets/fractals/tree.fdo", "# tree\nv 1 1 1\n\nt.a.b. (a, x, b)\n")));

    [Theory]
    [InlineData("t.a. (a, #)", 11)]
    [InlineData("t.a. (a, #, #, #)", 14)]
    [InlineData("t.a. a, #, #", 6)]
    [InlineData("t.a. (a, #, #", 14)]
    public void Function_WithParametersAndOfTheWrongShape_PointsAtTheFault(string line, int column)
    {
        var error = Errors.ThrownBy(() => Samples.ParseFractal(line + "\n<$>. \"b.obj\"")).Diagnostic;
        Assert.Equal((1, column), (error.Line, error.Column));
        Assert.StartsWith("unexpected ", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Comment_BeforeACarriageReturnAlone_EndsThere() =>
        Assert.Equal("b.obj", Samples.ParseFractal("# comment\r<$>. \"b.obj\"\r").BaseFile);
}
