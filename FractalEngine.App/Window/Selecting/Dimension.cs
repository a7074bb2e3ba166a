using System.Globalization;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render;

namespace FractalEngine.App.Window.Selecting;

/// <summary>A measured distance between two points of the world.</summary>
/// <param name="From">The first point, world space.</param>
/// <param name="To">The second point, world space.</param>
/// <param name="What">What was measured, for the user.</param>
internal sealed record Dimension(Vector From, Vector To, string What)
{
    private static readonly Colour LineColour = new(0.45, 1, 0.55);

    /// <summary>Distance of the points, scene units.</summary>
    public double Length => (To - From).Length();

    /// <summary>The length for people, with six digits.</summary>
    public string LengthText => Length.ToString("G6", CultureInfo.InvariantCulture);

    /// <summary>The line between the points.</summary>
    public LineSegment Line => new(From, To, LineColour);
}
