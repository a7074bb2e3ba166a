using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Fdo.Writing;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Fdo;

/// <summary>Names, expressions, powers, products and matrices of fractal files.</summary>
public class FractalLanguageTests
{
    [Theory]
    [InlineData("1/3", 1 / 3.0)]
    [InlineData("2 + 3*4 - 5", 9)]
    [InlineData("(2 + 3)*4", 20)]
    [InlineData("2^3^2", 512)]
    [InlineData("-2^2", -4)]
    [InlineData("2^-1", 0.5)]
    [InlineData("8/4/2", 1)]
    [InlineData("1 - 2 - 3", -4)]
    [InlineData("--3", 3)]
    [InlineData("1 + 4*sin(30) + 4*sin(330) + 2*cos(60) + 2*cos(240) + tan(225) + tan(-45)", 1)]
    [InlineData("mod(1e17, 3)", 1)]
    [InlineData("mod(1, 0.1)", 0.09999999999999995)]
    [InlineData("sin(30)", 0.5)]
    [InlineData("cos(60) + sin(180)", 0.5)]
    [InlineData("tan(45)", 1)]
    [InlineData("sqrt(2)^2", 2)]
    [InlineData("abs(-3) + floor(-0.5)", 2)]
    [InlineData("min(3, 2) + 10*max(3, 2)", 32)]
    [InlineData("mod(-1, 5) + mod(7, -5)", 1)]
    [InlineData("2*pi", 2 * Math.PI)]
    [InlineData("1e-3", 1e-3)]
    [InlineData("  7  // seven", 7)]
    public void Expression_HasItsValue(string expression, double expected)
    {
        var value = ScaleOf($"a = {expression}\nt. (#, #, (a))\n").X;
        Assert.Equal(expected, value, 4e-16 * Math.Abs(expected));
    }

    [Fact]
    public void Numbers_ThatAreWritten_KeepTheirBits() => Seeded.Run(500, static random =>
    {
        var number = BitConverter.Int64BitsToDouble(random.NextInt64());
        number = double.IsFinite(number) && Math.Abs(number) is > 1e-99 and < 1e99 ? number : random.NextDouble();
        var scale = ScaleOf(FormattableString.Invariant($"a = {number:R}\nt. (#, #, ({number:R}, a, a))\n"));
        Assert.Equal(new(number, number, number), scale);
    });

    [Theory]
    [InlineData(" 1/3 ", 1 / 3.0)]
    [InlineData("-2.5e3", -2500)]
    [InlineData("max(sqrt(2), 0)*pi", 4.442882938158366)]
    public void Number_ThatStandsAlone_IsComputed(string text, double expected) => Assert.Equal(expected, NumberExpression.Compute(text));

    [Theory]
    [InlineData("", "unexpected end of file, expected '(', the name of a number or a number")]
    [InlineData("1 2", "unexpected '2', expected the end of the line")]
    [InlineData("x", "the number 'x' is not declared above")]
    [InlineData("1/0", "division by zero")]
    public void Text_ThatIsNoNumber_IsRefused(string text, string message) => Assert.StartsWith(
        message, Assert.Throws<SourceException>(() => NumberExpression.Compute(text)).Diagnostic.Message, StringComparison.Ordinal);

    [Theory]
    [InlineData("t.1.", "(1, 2, 3)")]
    [InlineData("t.up", "(4, 5, 6)")]
    [InlineData("t.(7, 1 + 7, 3^2)", "(7, 8, 9)")]
    [InlineData("t.(k/2)", "(5, 5, 5)")]
    public void Argument_IsAVectorOfAnyKind(string call, string expected)
    {
        var map = Assert.Single(SetOf($"v 1 2 3\nk = 10\nup = (4, 5, 6)\nt.a. (a, #, #)\nx. box\n<$>. [{call}] x\n").Transformations);
        Assert.Equal(expected, map.Position.ToString());
    }

    [Fact]
    public void Function_OfNumbersAndVectors_IsComputedForEachCall()
    {
        var set = SetOf("""
            up = (0, 1, 0)
            k = 3
            t.p.n. (p, (0, 90*n, k), (1/n))
            x. box
            <$>. [t.up.(2), t.(1, 0, 0).k] x
            """);
        Assert.Equal(
            [new(new(0, 1, 0), new(0, 180, 3), new(0.5, 0.5, 0.5)), new(new(1, 0, 0), new(0, 270, 3), new(1 / 3.0, 1 / 3.0, 1 / 3.0))],
            set.Transformations.ToArray());
    }

    [Fact]
    public void Parameters_HideNumbersAndFunctions()
    {
        var set = SetOf("sin = 2\na = 5\nt.a.sin. ((a, sin, 0), #, #)\nu. ((a, sin, 0), #, #)\nx. box\n<$>. [t.(7).(8), u.] x\n");
        Assert.Equal([new(7, 8, 0), new(5, 2, 0)], set.Transformations.Select(static map => map.Position));
    }

    /// <summary>Powers and products are those of the maps, in the order in which they stand, the right one first.</summary>
    [Fact]
    public void PowersAndProducts_AreThoseOfTheMaps()
    {
        const string Maps = "t. ((1, 2, 0), (0, 30, 10), (0.9, 0.8, -0.7))\nu. ((0, 0, 3), (45, 0, 0), #)\nx. box\n";
        var t = SetOf($"{Maps}<$>. [t.] x\n").Maps[0];
        var u = SetOf($"{Maps}<$>. [u.] x\n").Maps[0];
        var set = SetOf($"{Maps}<$>. [t.^2, t.^-2..2 * u., t. * u.^(1+1) * t., #*u., t.^0] x\n");
        AffineMap[] expected =
        [
            t * t, t.Inverse() * t.Inverse() * u, t.Inverse() * u, u, t * u, t * t * u, t * u * u * t, u, AffineMap.Identity,
        ];
        Assert.Equal(expected.Length, set.Maps.Length);
        Assert.False(set.HasTransformations);
        for (var i = 0; i < expected.Length; i++)
        {
            foreach (var point in (Vector[])[Vector.Zero, Vector.I, Vector.J, Vector.K])
            {
                Assert.True((expected[i] * point - (set.Maps[i] * point)).Length() < 1e-14, $"map {i}");
            }
        }
    }

    /// <summary>A map without a name is what a function with its outputs returns, in all that is made of maps.</summary>
    [Theory]
    [InlineData("[((1, 2, 0), #, (0.5))]", "t. ((1, 2, 0), #, (0.5))", "[t.]")]
    [InlineData("[(1, up (k)),#, ( # , (10, 20, 30) ,2 )]", "t. (1, up, (k))\nu. (#, (10, 20, 30), 2)", "[t., #, u.]")]
    [InlineData("[(#, _up, #)]", "t._p. (#, _p, #)", "[t._up]")]
    [InlineData("[((1, 0, 0), #, #)^-2..2 * (#, (0, 30, 0), #)^2]", "t. ((1, 0, 0), #, #)\nu. (#, (0, 30, 0), #)", "[t.^-2..2 * u.^2]")]
    [InlineData("[(((k*k, 0, 0), #, #) * (#, up, #))^0..9]", "t. ((k*k, 0, 0), #, #)\nu. (#, up, #)\n", "[(t. * u.)^0..9]")]
    public void Map_WithoutAName_IsWhatAFunctionReturns(string unnamed, string functions, string named)
    {
        const string Values = "v 1 2 3\nv 2 2 2\nk = 0.5\nup = (0, 1, 0)\n_up = (0, 2, 0)\n";
        var expected = SetOf($"{Values}{functions}\n<$>. {named} box\n");
        var actual = SetOf($"{Values}<$>. {unnamed} box\n");
        Assert.Equal<IEnumerable<AffineMap>>(expected.Maps, actual.Maps);
        Assert.Equal(expected.HasTransformations, actual.HasTransformations);
    }

    /// <summary>A product in parentheses has the powers that its maps have not: the step of a screw about an axis elsewhere.</summary>
    [Fact]
    public void Product_InParentheses_HasPowers()
    {
        const string Maps = "t. ((1, 2, 0), (0, 30, 10), (0.9, 0.8, -0.7))\nu. ((0, 0, 3), (45, 0, 0), #)\n";
        var set = SetOf($"{Maps}<$>. [(t. * u.)^-1..2, u. * (t.^2 * (u. * t.)^2)^1, (u.^0..1 * t.) * u.] box\n");
        var (t, u) = (SetOf($"{Maps}<$>. [t.] box\n").Maps[0], SetOf($"{Maps}<$>. [u.] box\n").Maps[0]);
        AffineMap[] expected = [(t * u).Inverse(), AffineMap.Identity, t * u, t * u * t * u, u * t * t * u * t * u * t, t * u, u * t * u];
        Assert.Equal(expected.Length, set.Maps.Length);
        for (var i = 0; i < expected.Length; i++)
        {
            foreach (var point in (Vector[])[Vector.Zero, Vector.I, Vector.J, Vector.K])
            {
                Assert.True((expected[i] * point - (set.Maps[i] * point)).Length() < 1e-13, $"map {i}");
            }
        }
    }

    /// <summary>Powers of a range are made one after the other, as levels of a recursion are composed.</summary>
    [Fact]
    public void Staircase_OfPowersAndOfLevels_IsTheSame()
    {
        const string Up = "up. ((0.3, 0.2, 0), (0, 15, 0), #)\n";
        var powers = FractalOf($"{Up}<$>. [up.^0..48] box\n");
        var levels = FractalOf($"{Up}z<box>. [#, up.] box\n<$>. z 48\n");
        foreach (var fractal in (Fractal[])[powers, levels])
        {
            Assert.Equal(49, DistinctInstances.Count(fractal));
        }

        Assert.True((powers.Bounds.Minimum - levels.Bounds.Minimum).Length() < 1e-12);
        Assert.True((powers.Bounds.Maximum - levels.Bounds.Maximum).Length() < 1e-12);
    }

    /// <summary>Turns that come back are the same maps again, and few instances are left of many powers.</summary>
    [Theory]
    [InlineData("((1, 0, 0), (0, 30, 0), #)", "[t.^0..23]", 12)]
    [InlineData("((1, 0, 0), (0, 30, 0), #)", "[t.^-60..59]", 12)]
    [InlineData("((1, 0, 0), (0, 45, 0), #)", "[t.^0..15]", 8)]
    [InlineData("(#, (0, 15, 0), #)", "[t.^0..47]", 24)]
    [InlineData("((1, 0, 0), (0, 7.2, 0), #)", "[t.^0..99]", 50)]
    [InlineData("((1, 0.3, 0), (10, 20, 30), #)", "[t.^-10..10] [t.^-10..10]", 41)]
    [InlineData("((1e-20, 0, 0), (0, 1e-11, 0), #)", "[t.^0..99]", 100)]
    public void Powers_ThatComeBack_AreTheSameInstances(string map, string sets, int expected) =>
        Assert.Equal(expected, DistinctInstances.Count(FractalOf($"t. {map}\n<$>. {sets} box\n")));

    /// <summary>A function means what it meant where it stands, whatever the file declares below it.</summary>
    [Fact]
    public void Function_KnowsTheNamesAboveIt()
    {
        var set = SetOf("""
            k = 2
            u.p. ((pi*p, mod(5, 3*p), k*p), #, #)
            pi = 1
            mod = 0
            x. box
            <$>. [u.(1)] x
            """);
        Assert.Equal(new(Math.PI, 2, 2), set.Transformations[0].Position);
    }

    [Fact]
    public void Powers_OfAMapThatFlattens_AreRefusedFromOneOn()
    {
        const string Map = "m.matrix (1, 0.3, 0.1) (0.2, 0.1, 0) (0, 0.12, 1) (0)\n";
        var accepted = Enumerable.Range(0, 60).Select(static power =>
        {
            try
            {
                return SetOf($"{Map}<$>. [m.^{power}] box\n").Maps.Length == 1;
            }
            catch (SourceException exception)
            {
                Assert.Contains("the map is flat to rounding", exception.Message, StringComparison.Ordinal);
                return false;
            }
        }).ToArray();
        Assert.Equal(accepted.OrderDescending(), accepted);
        Assert.InRange(accepted.Count(static isAccepted => isAccepted), 8, 30);
    }

    [Fact]
    public void Calls_OfLongFunctions_AreLimited()
    {
        var sum = string.Join('+', Enumerable.Repeat("p", 10_000));
        var calls = string.Join(',', Enumerable.Repeat("t.(0)", 600));
        var exception = Assert.Throws<SourceException>(
            () => FractalParser.Parse(new("a.fdo", $"t.p. (({sum}, 0, 0), #, #)\n<$>. [{calls}] box\n")));
        Assert.Contains("more than the limit of 5000000 terms of expressions in all calls", exception.Message, StringComparison.Ordinal);
        Assert.True(exception.Diagnostic.IsLimitExceeded);
    }

    [Fact]
    public void Matrix_IsGivenByItsColumns()
    {
        var set = SetOf("shear = (1/2, 1, 0)\nm.matrix (1, 0, 0) shear (0, 0, 2) (7, 8, 9)\nx. box\n<$>. [m.] x\n");
        Assert.Equal(new AffineMap(new(Vector.I, new(0.5, 1, 0), new(0, 0, 2)), new(7, 8, 9)), Assert.Single(set.Maps));
    }

    [Fact]
    public void Fractal_OfAnyMaps_IsWrittenAndReadAsItIs()
    {
        var text = "m.matrix (1, 0, 0) (0.1, 1, 0) (0, 0, 1) (0, 1e-17, 3)\nt. ((1, 0, 0), (0, 30, 0), (1/3))\n"
            + "z<ball>. [#, m., t.^-1 * m.] [t.] ball\n<$>. z 3\n";
        var parsed = FractalParser.Parse(new("a.fdo", text));
        var written = FractalWriter.Write(parsed.Description, [.. parsed.Bases.Select(static one => one.File)]);
        var again = FractalParser.Parse(new("b.fdo", written));
        Assert.Equal(parsed.Description, again.Description);
        Assert.Equal("ball", again.BaseFile);
    }

    [Fact]
    public void File_WithAShape_KeepsIt()
    {
        using var folder = new TemporaryFolder();
        File.WriteAllText(folder["a.fdo"], "z<cone>. [#] [#] cone\n<$>. z 2\n");
        var fractal = FractalFile.Read(folder["a.fdo"]);
        FractalFile.Write(folder["b.fdo"], fractal);
        Assert.Equal(["a.fdo", "b.fdo"], Directory.EnumerateFiles(folder[""]).Select(Path.GetFileName).Order());
        Assert.Same(fractal.BaseMesh, FractalFile.Read(folder["b.fdo"]).BaseMesh);
    }

    /// <summary>What a file declares wins over a shape, a keyword and a function of the same name.</summary>
    [Fact]
    public void Names_OfTheFile_WinOverShapesKeywordsAndFunctions()
    {
        var parsed = FractalParser.Parse(new("a.fdo", """
            v = 2
            pi = 3
            from = 1 from 0 to 2
            composition = v*pi
            box. "b.obj"
            t.matrix. (matrix, #, (composition))
            <$>. [t.(from)] box
            """));
        Assert.Equal("b.obj", parsed.BaseFile);
        Assert.Equal(new(Vector.One, Vector.Zero, new(6, 6, 6)), ((TransformationSet)parsed.Description.Steps[0]).Transformations[0]);
        Assert.Equal(["v", "pi", "from", "composition"], parsed.NumberNames.ToArray());
    }

    [Fact]
    public void Values_ThatAreSet_TakeThePlaceOfThoseOfTheFile()
    {
        var source = "k = 2\nhalf = k/2\nt. (#, #, (half))\n<$>. [t.] box\n";
        var parsed = FractalParser.Parse(new("a.fdo", source), new Dictionary<string, double> { ["k"] = 10 });
        Assert.Equal(5, ((TransformationSet)parsed.Description.Steps[0]).Transformations[0].Scale.X);
    }

    [Fact]
    public void Numbers_AreListedWithTheirNamesEndsAndRoles()
    {
        var numbers = FractalNumber.FindAll(new("a.fdo", """
            lean = 1/2 from 0 to 90
            up = (0, lean, 2)
            s. (up, (1, 2, 3), (0.6))
            z<box>. [s.] box
            <$>. z 3
            """));
        Assert.Equal(
            [
                "Named lean 0 7+3 0.5 (0, 90) False", "Position up 0 30+1 0 null False", "Position up 2 39+1 2 null False",
                "Rotation s 0 51+1 1 null False", "Rotation s 1 54+1 2 null False", "Rotation s 2 57+1 3 null False",
                "Scale s 0 62+3 0.6 null True", "Depth z 0 92+1 3 null False",
            ],
            numbers.Select(static number => FormattableString.Invariant(
                $"{number.Role} {number.Name} {number.Component} {number.Offset}+{number.Length} {number.Value} ")
                + $"{(number.Range is { } range ? FormattableString.Invariant($"({range.From}, {range.To})") : "null")} {number.IsEven}"));
    }

    [Theory]
    [InlineData("a = 1/0", "1:6: error: division by zero")]
    [InlineData("a = 10^999", "1:7: error: the result is beyond the range of a double")]
    [InlineData("a = 1e300*1e300", "1:10: error: the result is beyond the range of a double")]
    [InlineData("a = (-8)^(1/3)", "1:9: error: the result is no real number")]
    [InlineData("a = 0^-1", "1:6: error: division by zero: 0 has no negative powers")]
    [InlineData("a = mod(1, 0)", "1:5: error: the result is no real number")]
    [InlineData("a = tan(90)", "1:5: error: the result is beyond the range of a double")]
    [InlineData("a = a + 1", "1:5: error: the number 'a' is not declared above")]
    [InlineData("lean = 1\nb = leen", "2:5: error: the number 'leen' is not declared above: did you mean 'lean'?")]
    [InlineData("lean = 1\nt.a. (a, #, #)\n<$>. [t.leen] box", "3:9: error: the value 'leen' is not declared above")]
    [InlineData(
        "side = (0, 1, 0)\nt. (sied, #, #)",
        "2:5: error: unexpected 'sied': no parameter and no vector above has this name: did you mean 'side'?")]
    [InlineData("a = 1\nt. (a, #, #)", "2:5: error: 'a' is a number, and here stands a vector: '(a)' has it three times")]
    [InlineData("a = (1, 2, 3)\nb = a", "2:5: error: 'a' is a vector, and here stands a number")]
    [InlineData("t.a. ((a), a, #)", "1:12: error: the parameter 'a' is used as a vector and as a number")]
    [InlineData("t.a. ((a), #, #)\n<$>. [t.(1, 2, 3)] box", "2:9: error: here stands a number, and this is a vector")]
    [InlineData("b = (1, 2, 3)\nt.a. ((a), #, #)\n<$>. [t.b] box", "3:9: error: 'b' is a vector, and 'a' of 't' is a number")]
    [InlineData("v 1 1 1\nt.a. ((a), #, #)\n<$>. [t.1] box", "3:9: error: the parameter 'a' of 't' is a number, as in 't.(1)'")]
    [InlineData("t.a. ((1/a), #, #)\n<$>. [t.(0)] box", "1:9: error: division by zero, in the call in line 2")]
    [InlineData(
        "<$>. [((1, 0, 0), #)] box",
        "1:20: error: unexpected ')': a map has a position, a rotation and a scale, as in '((1, 0, 0), #, (0.5))'")]
    [InlineData("<$>. [((1, 0, 0) #)] box", "1:19: error: unexpected ')': a map has a position, a rotation and a scale")]
    [InlineData("<$>. [(#, #, (0))] box", "1:7: error: the scale (0, 0, 0) is singular")]
    [InlineData("<$>. [(2, #, #)] box\nv 1 2 3", "1:8: error: vector 2 of 0: it is not declared above the call in line 1")]
    [InlineData("t. (#, #, #)\n<$>. [(t.^0..2 * t.)^2] box", "2:21: error: a power is that of one map, not of 3")]
    [InlineData("t. (#, #, #)\n<$>. [t.^1.5] box", "2:11: error: unexpected '.': the power of a map is a whole number")]
    [InlineData("t. (#, #, #)\n<$>. [t.^(0.5)] box", "2:10: error: the power of a map is a whole number, not 0.5")]
    [InlineData("t. (#, #, #)\n<$>. [t.^2..1] box", "2:9: error: a range of powers begins at the smaller one")]
    [InlineData(
        "t. (#, #, (0.5))\n<$>. [t.^-400] box",
        "2:9: error: the map is beyond all sizes: it must make the axes between 1e-100 and 1e100 long")]
    [InlineData("m.matrix (1, 0, 0) (2, 0, 0) (0, 0, 1) (0)", "1:10: error: the map is flat to rounding, so that it has no inverse")]
    [InlineData("t. (#, #, #)\n<$>. [t.^0..999999] box", "2:9: error: the file has more than the limit of 200000")]
    [InlineData("t. (#, #, #)\n<$>. [t.^9999999] box", "2:10: error: the power is more than the limit of 1000000")]
    [InlineData("z<box>. [#] box\n<$>. z (-1)", "2:8: error: a depth is a whole number that is not negative, not -1")]
    [InlineData("a = 1 from 2 to 2", "1:14: error: a slider begins at the smaller number")]
    [InlineData("a = 1\na = 2", "2:1: error: the value 'a' is declared twice, first in line 1")]
    public void Mistake_IsNamedWhereItStands(string text, string message) =>
        Assert.StartsWith(
            $"a.fdo:{message}",
            Assert.Throws<SourceException>(() => FractalParser.Parse(new("a.fdo", text))).Message,
            StringComparison.Ordinal);

    [Theory]
    [InlineData('(')]
    [InlineData('-')]
    public void Expression_OfAnyDepth_EndsInAnError(char character)
    {
        var text = $"a = {new string(character, 100_000)}1";
        Assert.Throws<SourceException>(() => FractalParser.Parse(new("a.fdo", text)));
        var powers = $"a = {string.Concat(Enumerable.Repeat("1^", 100_000))}1";
        Assert.Throws<SourceException>(() => FractalParser.Parse(new("a.fdo", powers)));
    }

    [Theory]
    [InlineData("m.matrix (1, 0, 0) (0, 1, 0) (0, 0, 1) (1)\n<$>. [m.] box")]
    [InlineData("t. ((1), #, #)\n<$>. [t.^2] box")]
    [InlineData("t. ((1), #, #)\n<$>. [t. * t.] box")]
    public void OtherMaps_AreNotComposedComponentwise(string text) => Assert.Contains(
        "can't be composed componentwise",
        Assert.Throws<SourceException>(
            () => FractalParser.Parse(new("a.fdo", $"composition componentwise\n{text}"))).Message,
        StringComparison.Ordinal);

    [Fact]
    public void Shapes_FitACubeOfSideOne_AndFaceOutwards()
    {
        foreach (var name in BaseShapes.Names)
        {
            Assert.True(BaseShapes.TryFind(name, out var mesh));
            Assert.Equal(name, BaseShapes.NameOf(mesh));
            Assert.InRange(mesh.Bounds.Maximum.MaxAbsComponent(), 0.49, 0.5000001);
            Assert.InRange(mesh.Bounds.Minimum.MaxAbsComponent(), 0.49, 0.5000001);
            for (var face = 0; face < mesh.FaceCount; face++)
            {
                var (a, b, c) = mesh.Face(face);
                var normal = Vector.Cross(b - a, c - a);
                Assert.True(normal.Length() > 1e-4, $"face {face} of {name} has no area");
                Assert.True(Vector.Dot(normal, name == "plate" ? Vector.J : a) > 0, $"face {face} of {name} looks inwards");
            }
        }
    }

    private static Fractal FractalOf(string text)
    {
        var parsed = FractalParser.Parse(new("a.fdo", text));
        Assert.True(BaseShapes.TryFind(parsed.BaseFile, out var mesh));
        return new(parsed.Description, mesh);
    }

    private static TransformationSet SetOf(string text) =>
        Assert.IsType<TransformationSet>(Assert.Single(FractalParser.Parse(new("a.fdo", text)).Description.Steps));

    private static Vector ScaleOf(string declarations) => SetOf($"{declarations}<$>. [t.] box\n").Transformations[0].Scale;
}
