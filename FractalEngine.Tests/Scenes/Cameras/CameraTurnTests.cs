using FractalEngine.App.Jobs;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Cameras;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Scenes.Cameras;

/// <summary>Tests how a camera turns along its list, and where it can't turn evenly.</summary>
public sealed class CameraTurnTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    /// <summary>Two opposite directions have no middle; the turn happens at once, a millionth about it.</summary>
    [Theory]
    [InlineData(0.25, 1)]
    [InlineData(0.5 - 0.75e-6, 1)]
    [InlineData(0.5 + 0.25e-6, 1)]
    [InlineData(0.5 + 0.75e-6, -1)]
    [InlineData(0.75, -1)]
    public void At_BetweenOppositeDirections_LooksAlongTheNearer(double time, int sign) =>
        Near.Equal(sign * Vector.K, Read("(0, 0, 0) # 60", "(0, 0, 0) (0, 3.141592653589793, 0) 60").At(time).LocalAxes.V3, 1e-6);

    /// <summary>The same for what is up.</summary>
    [Theory]
    [InlineData(0.25, 1)]
    [InlineData(0.5 + 0.25e-6, 1)]
    [InlineData(0.5 + 0.75e-6, -1)]
    [InlineData(0.75, -1)]
    public void At_BetweenOppositeSidesUp_TakesTheNearer(double time, int sign) =>
        Near.Equal(sign * Vector.J, Read("(0, 0, 0) # 60", "(0, 0, 0) (0, 0, 3.141592653589793) 60").At(time).LocalAxes.V2, 1e-6);

    [Fact]
    public void At_HalfOfAQuarterTurn_HasTurnedAnEighthAndHalfOfTheAngle()
    {
        var camera = Read("(0, 0, 0) # 40", "(0, 0, 0) (0, 1.5707963267948966, 0) 60").At(0.5);
        // The rotation is computed from sines and cosines and back.
        Near.Equal(new Vector(0, Math.PI / 4, 0), camera.Rotation, 1e-12);
        Assert.Equal(50, camera.FieldOfView);
    }

    [Theory]
    [InlineData(-1, 0)]
    [InlineData(0, 0)]
    [InlineData(0.5, 2)]
    [InlineData(1, 7)]
    [InlineData(9, 7)]
    public void At_ACameraOfTheList_IsThatCamera(double time, double x)
    {
        var camera = Read("(0, 0, 0) # 40", "(2, 0, 0) # 50", "(7, 0, 0) # 60").At(2 * time);
        Near.Equal(new Vector(x, 0, 0), camera.Position, 1e-12);
        Near.Equal(40 + (20 * Math.Clamp(time, 0, 1)), camera.FieldOfView, 1e-12);
    }

    private CameraPath Read(params string[] lines) =>
        CameraText.ReadPath(_folder.Write("cameras.txt", string.Join('\n', lines)), Handedness.Left);
}
