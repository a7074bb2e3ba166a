using FractalEngine.Core.Geometry;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry;

public class ColourTests
{
    [Theory]
    [InlineData(0, 0)]
    [InlineData(1, 1)]
    [InlineData(0.5, 0.21404114048223255)]
    [InlineData(0.04045, 0.0031308049535603713)]
    public void ToLinear_FollowsTheStandardsCurve(double encoded, double linear) =>
        // The standard's two pieces meet to about 1e-8 at 0.04045.
        Near.Equal(linear, new Colour(encoded, 0, 0).ToLinear().Red, 3e-8);

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void ToString_InAnyCulture_WritesPoints(string culture) =>
        Assert.Equal("(0.5, 0.25, 1)", InCulture.Run(culture, () => new Colour(0.5, 0.25, 1).ToString()));
}
