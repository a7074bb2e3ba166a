using FractalEngine.App.Window.Tools;
using FractalEngine.Core;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Lines;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.State;

/// <summary>Selects, measures and focuses on what is clicked in the frame of a document.</summary>
internal sealed class SelectionTool(Document document)
{
    // A drag is longer than this, pixels.
    private const double MaxClickDistance = 4;

    private static readonly TimeSpan DoubleClickTime = TimeSpan.FromSeconds(0.4);

    private static readonly Colour BoxColour = new(0.55, 0.75, 1);

    private readonly CachedLines<(LoadedScene Scene, int Level)> _boxes =
        new(static shown => BoxLines.OfLevel(shown.Scene, shown.Level, BoxColour));

    private readonly CachedLines<(LoadedScene Scene, Selection? Selected)> _normals = new(static shown =>
        shown.Selected is null ? NormalLines.OfMeshes(shown.Scene)
        : shown.Selected.Instance is var (mesh, map) ? NormalLines.Of(mesh, map) : []);

    private Picker _picker = new();
    private Document _document = document;
    private (double X, double Y)? _press;
    private bool _focuses;
    private (double X, double Y, TimeSpan Time)? _lastClick;

    /// <summary>What is selected; null for nothing.</summary>
    public Selection? Selected { get; set; }

    /// <summary>Measures distances between clicks.</summary>
    public MeasureTool Measure { get; } = new();

    /// <summary>The level whose bounding boxes are shown: 0 for whole objects, −1 for none.</summary>
    public int BoxLevel { get; set; } = -1;

    /// <summary>Whether normals are shown: those of the selected instance, or of all meshes where nothing is selected.</summary>
    public bool ShowsNormals { get; set; }

    public HandleKind Handles { get; private set; }

    /// <summary>Distance of the handles from the middle of the object, as a part of the frame's height.</summary>
    public double HandleReach { get; set; } = 0.1;

    /// <summary>Shows handles at the selected object, or none where these are shown already.</summary>
    /// <returns>A message for the user.</returns>
    public string ToggleHandles(HandleKind kind)
    {
        Handles = Handles == kind ? HandleKind.None : kind;
        return Handles == HandleKind.None ? "no handles"
            : _document.File.Kind != FileKind.Scene ? "save this as a scene first: then its objects can be moved"
            : Selected is null ? "click an object: its handles appear"
            : "drag a handle; Ctrl snaps, and the panel of the selection takes numbers";
    }

    /// <summary>Goes on in the same document after its files were changed.</summary>
    public void ContinueIn(Document next)
    {
        _document = next;
        // The one before holds what it has searched.
        _picker = new();
        var objects = next.File.Scene.Objects;
        Selected = Selected is { } selected && selected.ObjectIndex < objects.Length
            ? selected.ContinueIn(objects[selected.ObjectIndex]) : null;
    }

    /// <summary>Moves what is selected with its object.</summary>
    /// <param name="scene">The scene with its bodies and moving objects where they are now.</param>
    public void Follow(LoadedScene scene)
    {
        if (Selected is { Viewpoint: null } selected && selected.ObjectIndex < scene.Objects.Length
            && scene.Objects[selected.ObjectIndex] is var placed && ReferenceEquals(placed.Model, selected.Object.Model)
            && placed.ObjectToWorld != selected.Object.ObjectToWorld)
        {
            Selected = selected.ContinueIn(placed);
        }
    }

    /// <summary>Processes an event: a click selects, and a double click makes the point the centre of the orbit.</summary>
    /// <param name="windowEvent">Any event of the window.</param>
    /// <param name="size">Size of the frame in pixels.</param>
    /// <param name="now">The present time.</param>
    /// <returns>A message for the user; null for events without an effect.</returns>
    public string? Handle(WindowEvent windowEvent, (int Width, int Height) size, TimeSpan now)
    {
        switch (windowEvent)
        {
            case MousePressed { Button: MouseButton.Left, Modifiers: KeyModifiers.None or KeyModifiers.Control } pressed
                when !_document.Physics.IsWalking:
                _press = (pressed.X, pressed.Y);
                _focuses = pressed.Modifiers == KeyModifiers.Control;
                return null;
            case MousePressed:
                _press = null;
                return null;
            case MouseReleased { Button: MouseButton.Left } released when _press is var (x, y):
                _press = null;
                return Math.Abs(released.X - x) + Math.Abs(released.Y - y) > MaxClickDistance ? null
                    : _focuses ? Focus((x, y), size) : Click((x, y), size, now);
            default:
                return null;
        }
    }

    /// <summary>Selects the next larger part, see <see cref="Selection.Up"/>.</summary>
    /// <returns>A message for the user.</returns>
    public string Up()
    {
        Selected = Selected?.Up();
        return Selected is { } selected ? $"selected {selected.Title}" : "nothing is selected";
    }

    /// <summary>Whether any lines are drawn over the scene.</summary>
    public bool HasLines => Selected is not null || !Measure.Dimensions.IsEmpty || Measure.HasFirstPoint || WorldLines().Count > 0;

    /// <summary>Lists the lines that belong to the scene, world space.</summary>
    public List<LineSegment> WorldLines()
    {
        var lines = new List<LineSegment>();
        var scene = _document.Physics.CurrentScene;
        if (BoxLevel >= 0)
        {
            lines.AddRange(_boxes.Of((scene, BoxLevel)));
        }

        if (ShowsNormals && Selected is not { Viewpoint: not null })
        {
            lines.AddRange(_normals.Of((scene, Selected)));
        }

        return lines;
    }

    /// <summary>Adds the lines around the selection and those of the distances, in the frame that is drawn.</summary>
    public void AddDrawnLines(List<LineSegment> lines)
    {
        if (Selected is { } selected && _document.MapToDrawnFrame(selected.Viewpoint) is { } map)
        {
            var own = new List<LineSegment>();
            selected.AddLines(own);
            if (ShowsNormals && selected.Viewpoint is not null)
            {
                own.AddRange(_normals.Of((_document.File.Scene, selected)));
            }

            lines.AddRange(own.Select(line => line with { From = map(line.From), To = map(line.To) }));
        }

        Measure.AddLines(lines, _document.MapToDrawnFrame);
    }

    /// <summary>Focuses the camera's lens on the point under a pixel.</summary>
    private string Focus((double X, double Y) pixel, (int Width, int Height) size)
    {
        try
        {
            if (Pick(_document.Physics.CurrentScene, pixel, size) is not { Viewpoint: null } clicked)
            {
                return "nothing is there to focus on";
            }

            var camera = _document.FlyingCamera.Camera;
            var depth = camera.ToCameraSpace(clicked.Point).Z;
            _document.MoveCamera((flying, _) => flying.SetLens(camera.Aperture, depth), 1);
            var hint = camera.Aperture > 0 ? "" : "; an aperture above 0 blurs the rest";
            return string.Create(System.Globalization.CultureInfo.InvariantCulture, $"in focus: depth {depth:G4}{hint}");
        }
        catch (Exception exception) when (exception is FractalEngineException or InvalidOperationException)
        {
            return exception.Message;
        }
    }

    private string Click((double X, double Y) pixel, (int Width, int Height) size, TimeSpan now)
    {
        var isDouble = _lastClick is var (x, y, time) && now - time < DoubleClickTime
            && Math.Abs(pixel.X - x) + Math.Abs(pixel.Y - y) <= MaxClickDistance;
        _lastClick = isDouble ? null : (pixel.X, pixel.Y, now);
        var scene = _document.Physics.CurrentScene;
        Selection? clicked;
        try
        {
            clicked = Pick(scene, pixel, size);
            if (Measure.IsActive && !isDouble)
            {
                return clicked is null ? "nothing is there" : Measure.Click(clicked, scene);
            }

            if (!isDouble || clicked is null)
            {
                Selected = clicked;
                return clicked is null ? "nothing selected" : $"selected {clicked.Title}";
            }
        }
        catch (Exception exception) when (exception is FractalEngineException or InvalidOperationException)
        {
            return exception.Message;
        }

        if (_document.FlyingCamera.ToCameraFrame(clicked.Point, clicked.Viewpoint) is { } point)
        {
            _document.MoveCamera((camera, _) => camera.FocusOn(point), 1);
        }

        return "orbiting around the point";
    }

    private Selection? Pick(LoadedScene scene, (double X, double Y) pixel, (int Width, int Height) size)
    {
        var view = View.Of(scene with { Scene = _document.GetCurrentScene() }, (double)size.Width / size.Height) with
        {
            Section = _document.Section.Shown,
            HorizontalShift = _document.Area.HorizontalShift,
            // Within a fractal, the frame has clip planes by what is around the camera.
            FixedClipPlanes = _document.VisibleDepth > 0 ? null : _document.File.Scene.Scene.Clip,
        };
        var camera = _document.FlyingCamera;
        return _document.VisibleDepth > 0 && !Picker.IsExactAt(camera.Log10Magnification)
            ? _picker.PickDeep(scene, camera.WithDeepZoom(view), camera.Address!, pixel, size)
            : _picker.Pick(scene, view, pixel, size);
    }
}
