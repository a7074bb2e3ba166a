using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Panels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Tools;

/// <summary>
/// The handles of the selected object: knobs at the ends of its axes or on rings around it, which move, turn and scale it. Each drag is
/// one step that can be undone, and changes the numbers of the object's line in the scene.
/// </summary>
/// <param name="actions">The window with the document.</param>
internal sealed class TransformHandles(WindowActions actions)
{
    // Pixels at scale 1 from the middle of the object to a handle.
    private const double Reach = 80;

    // Handles closer to the middle than this part of their reach can't be dragged with precision.
    private const double MinReachRatio = 0.25;

    // Of the length of an axis: what a drag without Ctrl is rounded to, so that files have few digits.
    private const double FineGrid = 1e-3;

    private static readonly (string Label, Colour Colour)[] Looks =
        [("x", new(0.62, 0.16, 0.16)), ("y", new(0.16, 0.42, 0.12)), ("z", new(0.16, 0.30, 0.66)), ("o", new(0.36, 0.33, 0.10))];

    private PlacementDrag? _drag;
    private Vector _startPoint;
    private double _start;
    private double _length;

    /// <summary>Adds the handles, where an object of a scene is selected.</summary>
    public void Build(UserInterface ui)
    {
        if (actions.Document is not { VisibleDepth: 0, Physics.IsWalking: false, LatestView: { } view } document
            || document.Tool is not { Handles: not HandleKind.None and var kind } || SelectedObject(document) is not { } selected)
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
            var end = axis == 3 ? middle : middle + (length * DirectionOf(kind, axis, declared.Placement));
            if (pointer.Project(end) is not var (x, y) || (axis < 3 && IsTooShort(x - middleX, y - middleY, ui.Scale)))
            {
                continue;
            }

            var handle = ui.Handle(Looks[axis].Label, $"handle {axis}", x, y, Looks[axis].Colour);
            ui.Tooltip(HelpOf(kind, axis));
            if (handle.Begins)
            {
                Begin(kind, axis == 3 ? -1 : axis, declared.Placement, middle, length, handle, pointer);
            }

            isHeld |= handle.IsHeld;
            if (handle.IsHeld && _drag is { } drag && Moved(drag, handle, pointer) is { } placement && placement != declared.Placement)
            {
                actions.ChangeObject(ui, index, present => present.MovedTo(placement));
            }

            if (handle.IsHeld && _drag is not null)
            {
                ui.Mark(TextOf(kind, declared.Placement), middleX, middleY + (Reach * ui.Scale));
            }
        }

        _drag = isHeld ? _drag : null;
    }

    /// <summary>Adds the lines from the middle of the selected object to its handles, or the rings that they turn on.</summary>
    /// <param name="document">The document shown.</param>
    /// <param name="view">Its view, world space.</param>
    /// <param name="lines">The list that is added to, world space.</param>
    public static void AddLines(Document document, View view, List<LineSegment> lines)
    {
        if (document.Tool.Handles == HandleKind.None || SelectedObject(document) is not var (_, declared, middle))
        {
            return;
        }

        const int RingSegments = 48;
        var depth = view.Camera.ToCameraSpace(middle).Z;
        if (view.Projection == Projection.Perspective && !(depth > 0))
        {
            return;
        }

        var frameHeight = 2 * (view.Projection == Projection.Perspective
            ? depth * view.Camera.HalfHeightAtUnitDepth : 0.5 * view.OrthographicHeight);
        for (var axis = 0; axis < 3; axis++)
        {
            var colour = LineColour(Looks[axis].Colour);
            var length = frameHeight * document.Tool.HandleReach;
            if (document.Tool.Handles != HandleKind.Turn)
            {
                lines.Add(new(middle, middle + (length * DirectionOf(document.Tool.Handles, axis, declared.Placement)), colour));
                continue;
            }

            var first = PlacementDrag.UnitAxis((axis + 1) % 3);
            var second = PlacementDrag.UnitAxis((axis + 2) % 3);
            for (var i = 0; i < RingSegments; i++)
            {
                lines.Add(new(OnRing(i), OnRing(i + 1), colour));
            }

            Vector OnRing(int i)
            {
                var (sine, cosine) = Math.SinCos(2 * Math.PI * i / RingSegments);
                return middle + (length * ((cosine * first) + (sine * second)));
            }
        }
    }

    /// <summary>Returns the selected object of a scene, and its middle; null where none can be placed.</summary>
    private static (int Index, SceneObject Declared, Vector Middle)? SelectedObject(Document document)
    {
        var objects = document.File.Scene.Objects;
        if (document.File.Kind != FileKind.Scene || document.Tool.Selected is not { ObjectIndex: var index } || index >= objects.Length)
        {
            return null;
        }

        var placed = objects[index];
        var bounds = placed.Model.Bounds;
        var middle = bounds.IsEmpty || !bounds.Size.IsFinite() ? placed.ObjectToWorld.Translation : placed.ObjectToWorld * bounds.Centre;
        return (index, document.File.Scene.Scene.Objects[index], middle);
    }

    private static Vector DirectionOf(HandleKind kind, int axis, Transformation placement) => kind switch
    {
        HandleKind.Move => PlacementDrag.UnitAxis(axis),
        HandleKind.Turn => PlacementDrag.UnitAxis((axis + 1) % 3),
        _ => placement.Rotation.LocalAxesFromDegrees() * PlacementDrag.UnitAxis(axis),
    };

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
            return pointer.AlongAxis(handle.X, handle.Y, drag.Middle, DirectionOf(drag.Kind, drag.Axis, drag.Placement));
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
        (HandleKind.Move, _) => $"move along {Looks[axis].Label}; Ctrl snaps to a grid",
        (HandleKind.Turn, _) => $"turn about {Looks[axis].Label}; Ctrl snaps to 15 degrees",
        (_, 3) => "scale, to the right and up for larger; Ctrl snaps to tenths",
        _ => $"scale along the object's {Looks[axis].Label}; Ctrl snaps to tenths",
    };

    /// <summary>Lightens the colour of a knob, since lines are thin.</summary>
    private static Colour LineColour(Colour colour) =>
        new(Math.Min(1, 0.25 + (1.3 * colour.Red)), Math.Min(1, 0.25 + (1.3 * colour.Green)), Math.Min(1, 0.25 + (1.3 * colour.Blue)));
}
