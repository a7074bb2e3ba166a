using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Tools;

/// <summary>A measured distance between two points.</summary>
/// <param name="Kind">What was measured.</param>
/// <param name="First">What was clicked first.</param>
/// <param name="Second">What was clicked then.</param>
/// <param name="From">The first point, in the frame that <paramref name="Viewpoint"/> tells.</param>
/// <param name="To">The second point, likewise.</param>
/// <param name="What">What was measured, for the user.</param>
/// <param name="Viewpoint">Address of the camera that the points are about, in its unit; null for points in world space.</param>
internal sealed record Dimension(
    MeasureKind Kind, Selection First, Selection Second, Vector From, Vector To, string What, FractalAddress? Viewpoint = null)
{
    /// <summary>Colour of measured lines and of the point that was clicked first.</summary>
    public static readonly Colour LineColour = new(0.45, 1, 0.55);

    /// <summary>Distance of the points, in the unit of their frame.</summary>
    public double Length => (To - From).Length();

    /// <summary>The length in scene units for people, with six digits.</summary>
    public string LengthText => ScaledNumber.Format(Length, Viewpoint?.LogUnit ?? 0, 6);

    /// <summary>The line between the points, in their frame.</summary>
    public LineSegment Line => new(From, To, LineColour);
}
