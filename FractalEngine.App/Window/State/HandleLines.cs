using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.State;

/// <summary>The handles of the selected object as they are drawn in the scene: lines and rings, at whose ends are the knobs.</summary>
internal static class HandleLines
{
    /// <summary>Label and colour of the knobs along x, y and z, and of the one in the middle.</summary>
    public static readonly (string Label, Colour Colour)[] Looks =
        [("x", new(0.62, 0.16, 0.16)), ("y", new(0.16, 0.42, 0.12)), ("z", new(0.16, 0.30, 0.66)), ("o", new(0.36, 0.33, 0.10))];

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

        var frameHeight = 2 * view.HalfHeightAt(depth);
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
    public static (int Index, SceneObject Declared, Vector Middle)? SelectedObject(Document document)
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

    /// <summary>Returns the direction from the middle to the knob of an axis, world space.</summary>
    public static Vector DirectionOf(HandleKind kind, int axis, Transformation placement) => kind switch
    {
        HandleKind.Move => PlacementDrag.UnitAxis(axis),
        HandleKind.Turn => PlacementDrag.UnitAxis((axis + 1) % 3),
        _ => placement.Rotation.LocalAxesFromDegrees() * PlacementDrag.UnitAxis(axis),
    };

    /// <summary>Lightens the colour of a knob, since lines are thin.</summary>
    private static Colour LineColour(Colour colour) =>
        new(Math.Min(1, 0.25 + (1.3 * colour.Red)), Math.Min(1, 0.25 + (1.3 * colour.Green)), Math.Min(1, 0.25 + (1.3 * colour.Blue)));
}
