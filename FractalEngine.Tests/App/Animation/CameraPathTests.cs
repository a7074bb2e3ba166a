using FractalEngine.App.Jobs;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Animation;

/// <summary>Tests that a camera goes along its list as a Catmull-Rom spline does.</summary>
public sealed class CameraPathTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    /// <summary>The slope at a camera is half of the way between its neighbours; the ends of the list stand for themselves.</summary>
    [Theory]
    [InlineData(0.1)]
    [InlineData(0.3)]
    [InlineData(0.5)]
    [InlineData(0.7)]
    [InlineData(0.95)]
    public void At_AnyTime_IsOnTheSplineOfItsFourCameras(double time)
    {
        double[] places = [0, 1, 9, 4, 25, 7, 36];
        string list = string.Join('\n', places.Select(x => FormattableString.Invariant($"({x}, 0, 5) (0, 3, 0) 60")));
        var path = CameraText.ReadPath(_folder.Write("path.txt", list), Handedness.Right);
        double scaled = time * (places.Length - 1);
        int index = (int)scaled;
        double t = scaled - index;
        double Place(int i) => places[Math.Clamp(i, 0, places.Length - 1)];
        double slope = (Place(index + 1) - Place(index - 1)) / 2, nextSlope = (Place(index + 2) - Place(index)) / 2;
        double expected = (((2 * t * t * t) - (3 * t * t) + 1) * Place(index)) + (((t * t * t) - (2 * t * t) + t) * slope)
            + (((3 * t * t) - (2 * t * t * t)) * Place(index + 1)) + (((t * t * t) - (t * t)) * nextSlope);
        // A few roundings of numbers up to 100.
        Near.Equal(new Vector(expected, 0, 5), path.At(time * path.Duration).Position, 1e-12);
    }
}
