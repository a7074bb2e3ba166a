using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Tests.Render;

namespace FractalEngine.Tests.Scenes.Lights;

/// <summary>Colours of a white square under one light, compared with the light's formula.</summary>
[Collection(GlTests.Name)]
public sealed class LightTests
{
    [SkippableTheory]
    [InlineData(0)]
    [InlineData(30)]
    [InlineData(60)]
    [InlineData(75)]
    public void Directional_AtAnAngle_GivesItsCosine(double degrees)
    {
        var (sine, cosine) = Math.SinCos(degrees * Math.PI / 180);
        AssertLinear(cosine, RedOfLitSquare(new DirectionalLight(new(sine, 0, cosine), Colour.White, 1)));
    }

    [SkippableFact]
    public void Directional_FromBehind_LightsOnlyTheOtherSide()
    {
        var light = new DirectionalLight(new(0, 0, -1), Colour.White, 0.5);
        AssertLinear(0, RedOfLitSquare(light));
        var behind = new Camera(new(0, 0, 5), new(0, Math.PI, 0), 60);
        AssertLinear(0.5, RedOfLitSquare(light, behind));
    }

    [SkippableFact]
    public void Ambient_AnyStrength_GivesColourTimesIntensity() => AssertLinear(0.25, RedOfLitSquare(new AmbientLight(Colour.White, 0.25)));

    [SkippableTheory]
    [InlineData(1.0, 1.0)]
    [InlineData(2.0, 0.25)]
    public void Point_AtADistance_FallsWithItsSquare(double distance, double factor)
    {
        // At a tenth of the range the light has its full intensity. At two tenths the smooth end takes 0.3 % of it.
        var light = new PointLight(new(0, 0, -distance), Colour.White, 0.8, 10);
        AssertLinear(0.8 * factor, RedOfLitSquare(light), 0.006);
    }

    [SkippableFact]
    public void Point_BeyondItsRange_GivesNothing() =>
        AssertLinear(0, RedOfLitSquare(new PointLight(new(0, 0, -3), Colour.White, 100, 2.9)));

    [SkippableTheory]
    [InlineData(0, 1)]
    [InlineData(17, 1)] // inside nine tenths of the half angle
    [InlineData(21, 0)] // outside the cone
    public void Spot_RotatedAway_EndsAtItsAngle(double degrees, double factor)
    {
        var (sine, cosine) = Math.SinCos(degrees * Math.PI / 180);
        AssertLinear(0.7 * factor, RedOfLitSquare(new SpotLight(new(0, 0, -1), new(sine, 0, cosine), 40, Colour.White, 0.7, 10)));
    }

    [SkippableFact]
    public void Lights_OfSeveralColours_AddUpInLinearLight()
    {
        var green1 = new DirectionalLight(Vector.K, new(0, 1, 0), 0.3);
        var green2 = new DirectionalLight(Vector.K, new(0, 1, 0), 0.2);
        var scene = new Scene { Lights = [new AmbientLight(new(1, 0, 0), 0.2), green1, green2] };
        var (red, green, blue, _) = CentrePixel(scene, Camera.Default);
        AssertLinear(0.2, red);
        AssertLinear(0.5, green);
        Assert.Equal(0, blue);
    }

    private static byte RedOfLitSquare(Light light, Camera? camera = null) =>
        CentrePixel(new Scene { Lights = [light] }, camera ?? Camera.Default).Red;

    private static (byte Red, byte Green, byte Blue, byte Alpha) CentrePixel(Scene scene, Camera camera) => RenderScenes.Draw(
        // The square is small, so that the light's angle and distance hardly vary over it.
        RenderScenes.Scene(scene with { Background = Colour.Black },
        (RenderScenes.Model(RenderScenes.Square(0.01)), Transformation.Identity, Colour.White)),
        new(camera with { FieldOfView = 1 }, Projection.Perspective), 40, 30)[20, 15];

    /// <summary>Allows half a step of 8 bits, and the variation of the light over the square.</summary>
    private static void AssertLinear(double expected, byte found, double tolerance = 0.005) =>
        Assert.InRange(new Colour(found / 255.0, 0, 0).ToLinear().Red, expected - tolerance, expected + tolerance);
}
