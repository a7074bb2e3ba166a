using FractalEngine.App.Cameras;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.State;

/// <content>What is drawn: the view with its lines, and the maps to its frame.</content>
internal sealed partial class Document
{
    /// <summary>The view of the last frame; null before the first.</summary>
    public View? LatestView { get; private set; }

    /// <summary>Moves what is drawn to its present place, and returns the view of the present camera.</summary>
    /// <remarks>Bodies move to their interpolated positions, and the fractal to that of the paper's zoom where it is enabled.</remarks>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="isBesidePanels">False for a view in the middle of the frame, as if there were no panels.</param>
    public View UpdateView(double aspect, bool isBesidePanels = true) => LatestView = ComputeView(aspect, isBesidePanels);

    private View ComputeView(double aspect, bool isBesidePanels)
    {
        Physics.ApplyTo(Renderer);
        Tool.Measure.Follow(Physics.CurrentScene, Physics.IsRunning);
        Tool.Follow(Physics.CurrentScene);
        var view = View.Of(File.Scene with { Scene = GetCurrentScene() }, aspect) with
        {
            Section = Section.Shown,
            HorizontalShift = isBesidePanels ? Area.HorizontalShift : 0,
        };
        AddLines(view);
        if (Physics.IsWalking)
        {
            return view;
        }

        if (!IsTrailEnabled)
        {
            return FlyingCamera.WithDeepZoom(view);
        }

        Renderer.Move(0, Trail!.Update(File.Scene.Objects[0].ObjectToWorld, view.Camera.Position));
        return view;
    }

    /// <summary>Adds the lines of what is selected and measured to those of the bodies, in the frame of the view.</summary>
    private void AddLines(View view)
    {
        var lines = Tool.WorldLines();
        Section.AddLines(File.Scene.Bounds, lines);
        HandleLines.AddLines(this, view, lines);
        lines.AddRange(Renderer.Lines);
        if (VisibleDepth > 0 && MapToDrawnFrame(null) is { } map)
        {
            lines = lines.ConvertAll(line => line with { From = map(line.From), To = map(line.To) });
        }

        Tool.AddDrawnLines(lines);
        if (lines.Count > 0 || Renderer.Lines.Count > 0)
        {
            Renderer.Lines = lines;
        }
    }

    /// <summary>Returns the map from points of the world, or about another camera in the fractal, to the frame that is drawn.</summary>
    /// <param name="viewpoint">Address of that other camera, in whose unit the points are; null for points in world space.</param>
    /// <returns>Null where a double can't tell both places.</returns>
    public Func<Vector, Vector>? MapToDrawnFrame(FractalAddress? viewpoint) =>
        FlyingCamera.MapToDrawnFrame(viewpoint, isDeep: VisibleDepth > 0);

    /// <summary>Returns a camera as it is saved and shown: without the negative zeros that mirroring and turning leave.</summary>
    public static Camera WithoutNegativeZeros(Camera camera) =>
        camera with { Position = camera.Position + Vector.Zero, Rotation = camera.Rotation + Vector.Zero };

    /// <summary>Returns the scene with the present camera and projection.</summary>
    public Scene GetCurrentScene() => File.Scene.Scene with
    {
        Camera = Camera,
        Projection = FlyingCamera.Projection,
        OrthographicHeight = FlyingCamera.OrthographicHeight,
    };
}
