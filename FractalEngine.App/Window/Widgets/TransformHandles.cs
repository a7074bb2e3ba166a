using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.State;
using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>
/// The handles of the selected object: knobs at the ends of its axes or on rings around it, which move, turn and scale it. Each drag is
/// one step that can be undone, and changes the numbers of the object's line in the scene.
/// </summary>
internal sealed class TransformHandles(WindowActions actions)
{
    // Pixels at scale 1 from the middle of the object to a handle.
    private const double Reach = 80;

    // Handles closer to the middle than this part of their reach can't be dragged with precision.
    private const double MinReachRatio = 0.25;

    // Of the length of an axis: what a drag without Ctrl is rounded to, so that files have few digits.
    private const double FineGrid = 1e-3;

    private PlacementDrag? _drag;
    private Vector _startPoint;
    private double _start;
    private double _length;

    /// <summary>Adds the handles, where an object of a scene is selected.</summary>
    public void Build(UserInterface ui)
    {
        if (actions.Document is not { VisibleDepth: 0, Physics.IsWalking: false, LatestView: { } view } document
            || document.Tool is not { Handles: not HandleKind.None and var kind }
            || HandleLines.SelectedObject(document) is not { } selected)
        {
            _drag = null;
            return;
        }

        var (index, declared, middle) = selected;
        var pointer = new PointerMath(view, ui.Width, ui.Height);
        if (pointer.Project(middle) is not var (middleX, middleY))
        {
            return;
        }

        var reach = Reach * ui.Scale / pointer.FrameHeight;
        if (reach != document.Tool.HandleReach)
        {
            document.Tool.HandleReach = reach;
            actions.RequestDraw();
        }

        var length = _drag is null ? pointer.LengthOf(Reach * ui.Scale, middle) : _length;
        var isHeld = false;
        for (var axis = kind == HandleKind.Turn ? 2 : 3; axis >= 0; axis--)
        {
            var end = axis == 3 ? middle : middle + (length * HandleLines.DirectionOf(kind, axis, declared.Placement));
            if (pointer.Project(end) is not var (x, y) || (axis < 3 && IsTooShort(x - middleX, y - middleY, ui.Scale)))
            {
                continue;
            }

            var handle = ui.Handle(HandleLines.Looks[axis].Label, $"handle {axis}", x, y, HandleLines.Looks[axis].Colour);
            ui.Tooltip(HelpOf(kind, axis));
            if (handle.Begins)
            {
                Begin(kind, axis == 3 ? -1 : axis, declared.Placement, middle, length, handle, pointer);
            }

            isHeld |= handle.IsHeld;
            if (handle.IsHeld && _drag is { } drag && Moved(drag, handle, pointer) is { } placement && placement != declared.Placement)
            {
                actions.ChangeObject(index, present => present.MovedTo(placement));
            }

            if (handle.IsHeld && _drag is not null)
            {
                ui.Mark(TextOf(kind, declared.Placement), middleX, middleY + (Reach * ui.Scale));
            }
        }

        _drag = isHeld ? _drag : null;
    }

    private static bool IsTooShort(double x, double y, double scale) =>
        Math.Sqrt((x * x) + (y * y)) < MinReachRatio * Reach * scale;

    private void Begin(
        HandleKind kind, int axis, Transformation placement, Vector middle, double length, UiHandle handle, PointerMath pointer)
    {
        _drag = new(kind, axis, placement, middle);
        _length = length;
        _startPoint = PointAt(_drag, handle, pointer) ?? middle;
        _start = ParameterAt(_drag, handle, pointer) ?? 0;
    }

    /// <summary>Returns the placement that a drag has led to; null where the pointer means no place.</summary>
    private Transformation? Moved(PlacementDrag drag, UiHandle handle, PointerMath pointer)
    {
        var grid = handle.IsControlHeld ? PlacementDrag.PowerOfTen(_length) : PlacementDrag.PowerOfTen(FineGrid * _length);
        if (drag is { Kind: HandleKind.Move, Axis: < 0 })
        {
            return PointAt(drag, handle, pointer) is { } point ? drag.Move(point - _startPoint, grid) : null;
        }

        if (ParameterAt(drag, handle, pointer) is not { } parameter)
        {
            return null;
        }

        return drag.Kind switch
        {
            HandleKind.Move => drag.Move((parameter - _start) * PlacementDrag.UnitAxis(drag.Axis), grid),
            HandleKind.Turn => drag.Turn(180 / Math.PI * (parameter - _start), handle.IsControlHeld),
            _ => drag.Scale(drag.Axis < 0 ? 1 + (parameter - _start) : parameter / _start, handle.IsControlHeld),
        };
    }

    /// <summary>Returns the point in the plane of the frame through the middle.</summary>
    private static Vector? PointAt(PlacementDrag drag, UiHandle handle, PointerMath pointer) =>
        pointer.OnPlane(handle.X, handle.Y, drag.Middle, pointer.Forward);

    /// <summary>Returns the distance along an axis, the angle about it in radians, or for a whole scale the part of the reach.</summary>
    private static double? ParameterAt(PlacementDrag drag, UiHandle handle, PointerMath pointer)
    {
        if (drag.Axis < 0)
        {
            return pointer.Project(drag.Middle) is var (x, y) ? (handle.X - x - (handle.Y - y)) / Reach : null;
        }

        if (drag.Kind != HandleKind.Turn)
        {
            return pointer.AlongAxis(handle.X, handle.Y, drag.Middle, HandleLines.DirectionOf(drag.Kind, drag.Axis, drag.Placement));
        }

        if (pointer.OnPlane(handle.X, handle.Y, drag.Middle, PlacementDrag.UnitAxis(drag.Axis)) is not { } point)
        {
            return null;
        }

        var arm = point - drag.Middle;
        return Math.Atan2(
            Vector.Dot(arm, PlacementDrag.UnitAxis((drag.Axis + 2) % 3)), Vector.Dot(arm, PlacementDrag.UnitAxis((drag.Axis + 1) % 3)));
    }

    private static string TextOf(HandleKind kind, Transformation placement)
    {
        var (x, y, z) = kind switch
        {
            HandleKind.Move => placement.Position,
            HandleKind.Turn => placement.Rotation,
            _ => placement.Scale,
        };
        return $"{PanelWidgets.Number(x)}, {PanelWidgets.Number(y)}, {PanelWidgets.Number(z)}";
    }

    private static string HelpOf(HandleKind kind, int axis) => (kind, axis) switch
    {
        (HandleKind.Move, 3) => "move in the plane of the frame; Ctrl snaps to a grid",
        (HandleKind.Move, _) => $"move along {HandleLines.Looks[axis].Label}; Ctrl snaps to a grid",
        (HandleKind.Turn, _) => $"turn about {HandleLines.Looks[axis].Label}; Ctrl snaps to 15 degrees",
        (_, 3) => "scale, to the right and up for larger; Ctrl snaps to tenths",
        _ => $"scale along the object's {HandleLines.Looks[axis].Label}; Ctrl snaps to tenths",
    };
}
