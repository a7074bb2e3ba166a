using System.Globalization;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.App.Window.Drawing;

/// <summary>Names views for the status line.</summary>
internal static class ViewName
{
    // A hundredth of a degree. Angles of a file have fewer digits than that.
    private const double MaxDeviation = 2e-4;

    private static readonly (Vector Direction, string Name)[] Directions =
    [
        (Vector.K, "front"), (-Vector.K, "back"), (-Vector.I, "right"), (Vector.I, "left"), (-Vector.J, "top"), (Vector.J, "bottom"),
    ];

    /// <summary>Returns the name of a view, such as "front, perspective", and how deep it is in a fractal.</summary>
    /// <param name="camera">Camera of the view.</param>
    /// <param name="projection">Projection of the view.</param>
    /// <param name="depth">Number of levels between the whole fractal and the camera.</param>
    /// <param name="log10Magnification">Decimal logarithm of the magnification there.</param>
    public static string Of(Camera camera, Projection projection, int depth, double log10Magnification)
    {
        // Rotations are those of a left-handed camera in every scene.
        var forward = camera.Rotation.LocalAxes().V3;
        var direction = Directions.FirstOrDefault(candidate => (candidate.Direction - forward).Length() < MaxDeviation).Name;
        var name = projection == Projection.Perspective ? "perspective" : "orthographic";
        var view = direction is null ? name : $"{direction}, {name}";
        return depth == 0
            ? view
            : string.Create(CultureInfo.InvariantCulture, $"{view} · depth {depth:N0}, {Magnification(log10Magnification)}");
    }

    /// <summary>Formats a magnification: "3.2 times", or "10^12.3 times" where the number would be long.</summary>
    public static string Magnification(double log10Magnification) => log10Magnification < 4
        ? string.Create(CultureInfo.InvariantCulture, $"{Math.Pow(10, log10Magnification):0.##} times")
        : string.Create(CultureInfo.InvariantCulture, $"10^{log10Magnification:F1} times");
}
