using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>The knob in the middle of the section plane, which drags it along its normal.</summary>
internal sealed class SectionHandle(WindowActions actions)
{
    // Of the size of the scene: what a drag is rounded to, with Ctrl and without.
    private const double CoarseGrid = 0.1;
    private const double FineGrid = 1e-3;

    private static readonly Colour Ground = new(0.45, 0.24, 0.08);

    private SectionPlane _startPlane;
    private Vector _startMiddle;
    private double _start;
    private (double X, double Y) _startPixel;

    /// <summary>Adds the knob while the scene is cut open.</summary>
    public void Build(UserInterface ui)
    {
        if (actions.Document is not { VisibleDepth: 0, Physics.IsWalking: false, LatestView: { } view } document
            || document.Section.Shown is not { } plane)
        {
            return;
        }

        var bounds = document.File.Scene.Bounds;
        var pointer = new PointerMath(view, ui.Width, ui.Height);
        if (pointer.Project(SectionTool.MiddleOf(plane, bounds)) is not var (x, y))
        {
            return;
        }

        var handle = ui.Handle("↔", "section", x, y, Ground);
        ui.Tooltip("drag to move the section plane; Ctrl snaps to a grid");
        if (handle.Begins)
        {
            _startPlane = plane;
            _startMiddle = SectionTool.MiddleOf(plane, bounds);
            _start = pointer.AlongAxis(handle.X, handle.Y, _startMiddle, plane.Normal) ?? 0;
            _startPixel = (handle.X, handle.Y);
        }

        var wasShown = document.Section.ShowsEdges;
        document.Section.ShowsEdges = handle.IsHeld;
        if (handle.IsHeld)
        {
            var grid = PlacementDrag.PowerOfTen((handle.IsControlHeld ? CoarseGrid : FineGrid) * bounds.FiniteDiagonalOr(1));
            var distance = _startPlane.Distance + Moved(handle, pointer);
            var moved = _startPlane with { Distance = Math.Round(Math.Round(distance / grid) * grid, 12) };
            if (moved != plane)
            {
                document.Section.Set(moved);
                actions.RequestDraw();
            }
        }

        if (wasShown != document.Section.ShowsEdges)
        {
            actions.RequestDraw();
        }
    }

    /// <summary>Returns how far the plane was dragged. Where the eye looks along the normal, a drag upwards comes nearer.</summary>
    private double Moved(UiHandle handle, PointerMath pointer)
    {
        if (pointer.AlongAxis(handle.X, handle.Y, _startMiddle, _startPlane.Normal) is { } along)
        {
            return along - _start;
        }

        var towardsEye = -Math.Sign(Vector.Dot(pointer.DirectionTo(_startMiddle), _startPlane.Normal));
        return towardsEye * pointer.LengthOf(_startPixel.Y - handle.Y, _startMiddle);
    }
}
