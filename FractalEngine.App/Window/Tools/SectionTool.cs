using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Tools;

/// <summary>The plane that cuts the scene of a window open. It is a property of the view, and belongs to no file.</summary>
/// <param name="plane">The plane that the command line asks for; null for none.</param>
internal sealed class SectionTool(SectionPlane? plane)
{
    private static readonly Colour LineColour = new(0.95, 0.60, 0.35);

    private SectionPlane? _plane = plane;

    /// <summary>Whether the scene is cut open.</summary>
    public bool IsOn { get; private set; } = plane is not null;

    /// <summary>Whether the edges of the plane are shown, as while it is dragged.</summary>
    public bool ShowsEdges { get; set; }

    /// <summary>The plane that cuts the scene open; null for none.</summary>
    public SectionPlane? Shown => IsOn ? _plane : null;

    /// <summary>Cuts the scene open, or closes it. The plane stays where it was the last time.</summary>
    /// <param name="bounds">Bounds of the scene, through whose middle a plane goes that nobody has placed.</param>
    /// <param name="camera">The camera, which a plane that nobody has placed faces.</param>
    /// <returns>A message for the user.</returns>
    public string Toggle(BoundingBox bounds, Camera camera)
    {
        IsOn = !IsOn;
        _plane ??= Facing(bounds, camera);
        return IsOn ? "cut open: drag the knob, or set the plane in the panel of the view" : "not cut open";
    }

    /// <summary>Cuts the scene open along a plane.</summary>
    public void Set(SectionPlane plane)
    {
        _plane = plane;
        IsOn = true;
    }

    /// <summary>Shows the other side of the plane.</summary>
    /// <returns>A message for the user.</returns>
    public string Flip()
    {
        _plane = _plane?.Flipped;
        return "the other side of the section";
    }

    /// <summary>Fills solids where they are cut, or leaves them hollow.</summary>
    /// <returns>A message for the user.</returns>
    public string ToggleCap()
    {
        _plane = _plane is { } present ? present with { HasCap = !present.HasCap } : null;
        return _plane is { HasCap: true } ? "solids are filled where they are cut" : "solids are hollow where they are cut";
    }

    /// <summary>Returns the point of the plane that is nearest to the middle of a scene.</summary>
    public static Vector MiddleOf(SectionPlane plane, BoundingBox bounds)
    {
        var centre = CentreOf(bounds);
        return centre - (plane.SignedDistance(centre) * plane.Normal);
    }

    /// <summary>Adds the edges of a square in the plane, about as wide as the scene, while they are shown. World space.</summary>
    public void AddLines(BoundingBox bounds, List<LineSegment> lines)
    {
        if (!ShowsEdges || Shown is not { } plane)
        {
            return;
        }

        var first = Vector.Cross(plane.Normal, Math.Abs(plane.Normal.Y) < 0.9 ? Vector.J : Vector.I).UnitVector();
        var second = Vector.Cross(plane.Normal, first);
        // Within the scene's own sphere, so that the clip planes leave them whole.
        var reach = 0.35 * bounds.FiniteDiagonalOr(1);
        var middle = MiddleOf(plane, bounds);
        var across = reach * (first + second);
        var down = reach * (first - second);
        lines.Add(new(middle + across, middle + down, LineColour));
        lines.Add(new(middle + down, middle - across, LineColour));
        lines.Add(new(middle - across, middle - down, LineColour));
        lines.Add(new(middle - down, middle + across, LineColour));
    }

    /// <summary>Makes the plane through the middle of a scene along the axis that points most towards the camera.</summary>
    private static SectionPlane Facing(BoundingBox bounds, Camera camera)
    {
        var (x, y, z) = -camera.LocalAxes.V3;
        var largest = Math.Max(Math.Abs(x), Math.Max(Math.Abs(y), Math.Abs(z)));
        // Added to zero, so that no component is a negative zero.
        var normal = Vector.Zero + (Math.Abs(x) == largest ? Math.Sign(x) * Vector.I
            : Math.Abs(y) == largest ? Math.Sign(y) * Vector.J
            : Math.Sign(z) * Vector.K);
        return SectionPlane.Of(normal, Vector.Dot(normal, CentreOf(bounds)));
    }

    private static Vector CentreOf(BoundingBox bounds) => bounds.IsEmpty || !bounds.Size.IsFinite() ? Vector.Zero : bounds.Centre;
}
