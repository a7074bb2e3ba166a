using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Tests.Scenes;

/// <summary>Tests numbers of scenes right at their limits, and options that are nearly their defaults.</summary>
public sealed class SceneRangeTests
{
    private const string Singular = "is singular: each factor must lie between 1e-100 and 1e100 in size";

    [Theory]
    [InlineData("(1e-100, 1e100, -1e-100)")]
    [InlineData("(-1e100, 1e-100, 1e100)")]
    public void Scale_AtItsLimits_IsRead(string scale) => Parse($"o \"a.obj\" (#, #, {scale})");

    [Theory]
    [InlineData("(9.9e-101, 1, 1)")]
    [InlineData("(1, 9.9e-101, 1)")]
    [InlineData("(1, 1, 9.9e-101)")]
    [InlineData("(1.1e100, 1, 1)")]
    [InlineData("(1, -1.1e100, 1)")]
    [InlineData("(1, 1, 1.1e100)")]
    public void Scale_BeyondItsLimits_IsRefusedAtItsPlace(string scale)
    {
        var fault = Fault($"o \"a.obj\" (#, #, {scale})");
        Assert.Equal((1, 18), (fault.Line, fault.Column));
        Assert.EndsWith(Singular, fault.Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("shape balls 64")]
    [InlineData("friction 0 damping 0 rolling 0 spinning 0")]
    [InlineData("shrink 1 1e-300")]
    [InlineData("mass 1e300")]
    public void Body_AtItsLimits_IsRead(string options) => Parse($"p \"a.obj\" # 1 {options}");

    [Theory]
    [InlineData("shape balls 65", 27, "a body has 1 to 64 balls")]
    [InlineData("shape balls 64.5", 27, "a body has 1 to 64 balls")]
    [InlineData("mass -1", 20, "the mass must be positive")]
    [InlineData("inertia 0.6667", 23, "the inertia must be positive and at most 2/3")]
    [InlineData("shrink 1 -1", 24, "the smallest scale must be more than 0 and no more than 1")]
    public void Body_BeyondItsLimits_IsRefusedAtItsPlace(string options, int column, string message)
    {
        var fault = Fault($"p \"a.obj\" # 1 {options}");
        Assert.Equal((1, column, message), (fault.Line, fault.Column, fault.Message));
    }

    [Theory]
    [InlineData("1 2 slope 0")]
    [InlineData("1 2 speed 0 jump 0 step 0")]
    [InlineData("0.002 2")]
    public void Player_AtItsLimits_IsRead(string numbers) => Parse($"player (0, 1, 0) {numbers}");

    /// <summary>Radians are multiples of 15 degrees within a thousandth, up to a whole turn.</summary>
    [Theory]
    [InlineData("1.5723", true)]
    [InlineData("1.5724", false)]
    [InlineData("-1.5693", true)]
    [InlineData("-1.5691", false)]
    [InlineData("6.289", true)]
    [InlineData("6.29", false)]
    [InlineData("0.2618", true)]
    [InlineData("0.13", false)]
    public void Rotation_OfAnObject_IsHintedWhereItLooksLikeRadians(string angle, bool isHinted)
    {
        Assert.Equal(isHinted ? 1 : 0, Parse($"o \"a.obj\" (#, ({angle}, 0, 0), #)").Warnings.Length);
        Assert.Equal(isHinted ? 1 : 0, Parse($"o \"a.obj\" (#, (0, 0, {angle}), #)").Warnings.Length);
    }

    /// <summary>A rotation looks like degrees if a number is more than a whole turn, by more than rounding.</summary>
    [Theory]
    [InlineData("6.289", false)]
    [InlineData("6.29", true)]
    [InlineData("-6.289", false)]
    [InlineData("-6.29", true)]
    public void Rotation_OfACamera_IsHintedWhereItLooksLikeDegrees(string angle, bool isHinted) =>
        Assert.Equal(isHinted ? 1 : 0, Parse($"c # (0, {angle}, 0) 60").Warnings.Length);

    [Theory]
    [InlineData(1, "p \"a.obj\" # 0.5 shape balls 1\n")]
    [InlineData(2, "p \"a.obj\" # 0.5 shape balls 2\n")]
    [InlineData(64, "p \"a.obj\" # 0.5 shape balls 64\n")]
    public void Write_OfABodyOfBalls_StatesTheirNumber(int count, string text) => Assert.Equal(text, Write(BodyShape.Balls(count)));

    [Fact]
    public void Write_OfABallOrACapsule_StatesOnlyTheCapsule()
    {
        Assert.Equal("p \"a.obj\" # 0.5\n", Write(BodyShape.Ball));
        Assert.Equal("p \"a.obj\" # 0.5 shape capsule\n", Write(BodyShape.Capsule));
    }

    private static string Write(BodyShape shape) => SceneWriter.Write(
        new Scene { Objects = [new PhysicsObject("a.obj", Transformation.Identity, 0.5) { Shape = shape }] });

    private static ParsedScene Parse(string line) => SceneParser.Parse(new("test.sdo", line + "\n"));

    private static Diagnostic Fault(string line) => Assert.Throws<SourceException>(() => { Parse(line); }).Diagnostic;
}
