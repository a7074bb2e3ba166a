using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Fdo;

public class FractalParserTests
{
    // Vectors 1 to 4 and functions of 0 to 3 parameters; each test adds its own declarations.
    private const string Head =
        "v 1 2 3\nv 10 20 30\nv 0 90 0\nv 2 2 2\nr. (1, #, #)\ns.a. (a, #, #)\nt.a.b. (a, 3, b)\nu.a.b.c. (a, b, c)\nx. \"Base.obj\"\n";

    private static FractalDescription Parse(string text) => Samples.ParseFractal(text).Description;

    /// <summary>Returns the sets along one chain of the result, outermost first.</summary>
    private static IReadOnlyList<Transformation>[] ParseLevels(string text) => [.. NaiveFractal.Levels(Parse(Head + text).Steps)];

    private static Transformation SingleTransformation(string call) => Assert.Single(Assert.Single(ParseLevels($"<$>. [{call}] x")));

    [Fact]
    public void Parse_OfAppendixB_GivesItsLevels()
    {
        var description = Parse(Samples.AppendixB);
        Assert.Equal("FractalBase.obj", Samples.ParseFractal(Samples.AppendixB).BaseFile);
        Assert.Equal(Composition.Affine, description.Composition);
        var levels = NaiveFractal.Levels(description.Steps).ToList();
        Assert.Equal(12, levels.Count);
        Assert.Equal(
            [Transformation.Identity, U(10, 10, 135, 45), U(10, -10, 135, -45), U(-10, 10, -135, 45), U(-10, -10, -135, -45)], levels[0]);
        Assert.Equal([Transformation.Identity, T(1, 1), T(1, -1), T(-1, 1), T(-1, -1)], levels[1]);
        Assert.Equal(levels[0], levels[10]);
        Assert.Equal(levels[1], levels[11]);

        static Transformation U(double x, double y, double pitch, double yaw) => new(new(x, y, -10), new(pitch, yaw, 0), 0.1 * Vector.One);
        static Transformation T(double x, double y) => new(new(x, y, -2), Vector.Zero, 0.5 * Vector.One);
    }

    [Theory]
    [InlineData("v 1 2 3")]
    [InlineData("v 1, 2, 3")]
    [InlineData("v 1,2,3")]
    [InlineData("v\t1\t2 ,\t3  ")]
    [InlineData("  v 1 2 3")]
    [InlineData("v +1.0 .2e1 30.E-1")]
    public void Vector_WithAnySeparators_IsRead(string line) =>
        Assert.Equal(new(1, 2, 3),
        Assert.Single(NaiveFractal.Levels(Parse($"{line}\nm.a. (a, #, #)\n<$>. [m.1] \"b.obj\"").Steps).Single()).Position);

    [Fact]
    public void Call_WithNumbers_BindsVectorsInOrder()
    {
        Assert.Equal(new(new(10, 20, 30), Vector.Zero, Vector.One), SingleTransformation("s.2"));
        Assert.Equal(new(new(10, 20, 30), new(0, 90, 0), new(2, 2, 2)), SingleTransformation("t.2.4"));
        Assert.Equal(new(new(1, 2, 3), new(0, 90, 0), new(2, 2, 2)), SingleTransformation("u.1.3.4"));
    }

    [Fact]
    public void Call_OfAFunctionWithoutParameters_IsItsNameAndADot() => Assert.Equal(Samples.Move(1, 2, 3), SingleTransformation("r."));

    [Theory]
    [InlineData("[#,s.1,t.2.4]x")]
    [InlineData("[ # , s.1 , t.2.4 ]  x")]
    [InlineData("[\t#,\ts.1,\tt.2.4\t]\tx")]
    public void Set_WithAnyBlanks_KeepsItsOrder(string set) =>
        Assert.Equal([Transformation.Identity, SingleTransformation("s.1"), SingleTransformation("t.2.4")],
        Assert.Single(ParseLevels($"<$>. {set}")));

    [Fact]
    public void Set_BeforeASet_IsAppliedAfterIt() =>
        Assert.Equal([[SingleTransformation("s.1")], [SingleTransformation("s.2")]], ParseLevels("<$>. [s.1] [s.2] x"));

    [Fact]
    public void Set_OnANamedObject_IsAppliedAfterItsSets() =>
        Assert.Equal([[SingleTransformation("s.1")], [SingleTransformation("s.2")]], ParseLevels("y. [s.2] x\n<$>. [s.1] y"));

    [Fact]
    public void Set_DirectlyOnAFile_NeedsNoName() =>
        Assert.Equal("other.obj", Samples.ParseFractal(Head + "<$>. [s.1] \"other.obj\"").BaseFile);

    [Fact]
    public void Result_OfAFile_IsTheMeshItself()
    {
        var description = Parse("<$>. \"Base.obj\"");
        Assert.Equal("Base.obj", Samples.ParseFractal("<$>. \"Base.obj\"").BaseFile);
        Assert.Equal(1, new Fractal(description, Samples.Triangle).InstanceCount);
    }

    [Fact]
    public void Assignment_IsTheSameObject() => Assert.Equal([[SingleTransformation("s.1")]], ParseLevels("y. [s.1] x\nz. y\n<$>. z"));

    [Fact]
    public void Recursive_Flattened_RepeatsWhatItAddsToItsBase() =>
        Assert.Equal([[SingleTransformation("s.1")], [SingleTransformation("s.1")], [SingleTransformation("s.1")],
        [SingleTransformation("s.2")]], ParseLevels("a. [s.2] x\nz<a>. [s.1] a\nw. z 3\n<$>. w"));

    [Fact]
    public void Recursive_WithTwoSetsInItsBody_RepeatsBothInOrder() =>
        Assert.Equal([[SingleTransformation("s.1")], [SingleTransformation("s.2")], [SingleTransformation("s.1")],
        [SingleTransformation("s.2")]], ParseLevels("y. [s.2] x\nz<x>. [s.1] y\n<$>. z 2"));

    [Fact]
    public void Recursive_AtDepthZero_IsItsBase() =>
        Assert.Equal([[SingleTransformation("s.2")]], ParseLevels("a. [s.2] x\nz<a>. [s.1] a\n<$>. z 0"));

    [Fact]
    public void Recursive_UnderASet_HasTheSetOnce() =>
        Assert.Equal([[SingleTransformation("s.2")], [SingleTransformation("s.1")], [SingleTransformation("s.1")]],
        ParseLevels("z<x>. [s.1] x\n<$>. [s.2] z 2"));

    [Fact]
    public void Recursive_InsideAnotherFlattened_IsRepeatedWhole() => Assert.Equal(
        [[SingleTransformation("s.2")], [SingleTransformation("s.1")], [SingleTransformation("s.1")], [SingleTransformation("s.2")],
        [SingleTransformation("s.1")], [SingleTransformation("s.1")]],
        ParseLevels("z<x>. [s.1] x\nw<x>. [s.2] z 2\n<$>. w 2"));

    [Fact]
    public void Recursive_OnAFlattenedOne_StartsFromIt() =>
        Assert.Equal([[SingleTransformation("s.2")], [SingleTransformation("s.2")], [SingleTransformation("s.1")]],
        ParseLevels("z<x>. [s.1] x\ny. z 1\nw<y>. [s.2] y\n<$>. w 2"));

    [Fact]
    public void Recursive_BuiltOnItsBaseThroughAssignments_IsAccepted() =>
        Assert.Equal([[SingleTransformation("s.2")], [SingleTransformation("s.1")]],
        ParseLevels("y. x\ny2. [s.1] y\ny3. y2\nz<x>. [s.2] y3\n<$>. z 1"));

    [Fact]
    public void Result_OfARecursiveWithoutADepth_IsInfinite()
    {
        Assert.True(Parse(Head + "z<x>. [s.1] x\n<$>. z").IsInfinite);
        Assert.True(Parse(Head + "z<x>. [s.1] x\ny. z\n<$>. y").IsInfinite);
    }

    [Theory]
    [InlineData("composition affine\n", Composition.Affine)]
    [InlineData("composition componentwise\n", Composition.Componentwise)]
    [InlineData("", Composition.Affine)]
    public void Composition_InTheFile_IsRead(string line, Composition expected) =>
        Assert.Equal(expected, Parse(line + Head + "<$>. x").Composition);

    [Theory]
    [InlineData("# comment\n\n   \n\t# comment behind blanks\n#\n")]
    [InlineData("\r\n# comment\r\n\r\n")]
    [InlineData("\uFEFF")]
    public void Parse_WithCommentsAndEmptyLines_IgnoresThem(string before) =>
        Assert.Equal("b.obj", Samples.ParseFractalBytes(before + "<$>. \"b.obj\"\n# the end").BaseFile);

    [Fact]
    public void Parse_WithAnyLineBreaks_IsTheSame()
    {
        var expected = NaiveFractal.Levels(Parse(Samples.AppendixB).Steps).SelectMany(level => level);
        Assert.Equal(expected, NaiveFractal.Levels(Parse(Samples.AppendixB.ReplaceLineEndings("\r\n")).Steps).SelectMany(level => level));
        Assert.Equal(expected, NaiveFractal.Levels(Parse(Samples.AppendixB + "\n").Steps).SelectMany(level => level));
    }

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Parse_InAnyCulture_ReadsPoints(string culture) => Assert.Equal(
        0.5 * Vector.One, InCulture.Run(culture, () => NaiveFractal.Levels(Parse(Samples.AppendixB).Steps).Last()[1].Scale));

    [Fact]
    public void Depth_OfAGoogolInstances_IsReadAtOnceAndCountedExactly()
    {
        const string text = Head + "z<x>. [#, s.1, s.2, s.3, s.4, r., t.1.4, t.2.4, t.3.4, u.1.2.4] x\n<$>. z 100";
        // Nothing is expanded.
        var count = Allocation.RunWithin(1_000_000, () => new Fractal(Parse(text), Samples.Triangle).InstanceCount);
        Assert.Equal(System.Numerics.BigInteger.Pow(10, 100), count);
    }

    [Fact]
    public void Offsets_PointAtTheBaseFileAndTheResult()
    {
        var file = Samples.ParseFractal("x. \"b.obj\"\n<$>. x\n");
        Assert.Equal('"', file.Source.Text[file.Bases[0].Offset]);
        Assert.Equal(2, file.Source.Diagnose(file.ResultOffset, "").Line);
    }
}
