using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Upload;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Render.Shadows;

/// <summary>The shadows of a scene: which maps a frame needs, drawn where they are not up to date.</summary>
/// <remarks>
/// Maps that fit the view and maps of the whole scene are kept apart, so that a camera which moves and rests in turn finds the latter as
/// they were. In a deep zoom all is relative to the camera, and maps fit the view.
/// </remarks>
/// <param name="context">The context; nothing is allocated in it until a light casts shadows.</param>
/// <param name="scene">The scene.</param>
/// <param name="buffers">Its buffers.</param>
/// <param name="transforms">Where its objects are.</param>
internal sealed class ShadowPass(
    RenderContext context, DrawableScene scene, SceneBuffers buffers, ObjectTransforms transforms) : IDisposable
{
    // In a deep zoom, shadows fall up to so many times farther than the near plane: fifty times the distance of the closest surface.
    private const double DeepZoomReach = 2500;

    private readonly ImmutableArray<Emitter> _lights = LightBlock.LightsOf(scene.Source);
    private readonly bool _isAirLit = scene.Source.Scene.Fog is { IsLit: true };
    private readonly ShadowFit _fit = new();
    private readonly ShadowMaps _fittedMaps = new(context.Resources);
    private readonly ShadowMaps _wholeMaps = new(context.Resources);
    private readonly CasterSelection _fittedCasters = new();
    private readonly CasterSelection _wholeCasters = new();
    private readonly ShadowBlock _block = new(context.Resources, context.HasReversedDepth);
    private readonly CasterRenderer _casters = new(context.Resources, scene, buffers, transforms);
    private Action<ShadowView>? _drawStanding;
    private readonly List<int> _movingObjects = [.. MovingObjectsOf(scene)];
    private SceneCuller? _lastCuller;
    private readonly DerivedCulling _shadowCulling = new(EffectiveCulling.OfShadows);
    private CullingSettings? _culling;
    private DeepZoom? _zoom;
    private bool _fitsToView;
    private bool _hasMoving;
    private IReadOnlyList<SphereInstance> _lastSpheres = [];
    private long _version;
    private long _movingVersion;

    private ShadowMaps Maps => _fitsToView ? _fittedMaps : _wholeMaps;

    private CasterSelection Selection => _fitsToView ? _fittedCasters : _wholeCasters;

    /// <summary>Whether the frame has lights with shadows.</summary>
    public bool HasShadows { get; private set; }

    /// <summary>Whether any of them has a position.</summary>
    public bool HasPointShadows { get; private set; }

    /// <summary>Whether any parallel light has several depth maps.</summary>
    public bool HasSlices { get; private set; }

    /// <summary>Lights with a position that are so far away that their shadows are parallel: bit i for light i.</summary>
    public int DistantLights { get; private set; }

    /// <summary>Number of depth maps of the frame.</summary>
    public int MapCount { get; private set; }

    /// <summary>Number of depth maps that the frame does not need.</summary>
    public int SkippedMapCount { get; private set; }

    /// <summary>Number of objects that no depth map of the frame needs.</summary>
    public int SkippedCasterCount { get; private set; }

    /// <summary>Number of depth maps that were drawn for the frame; the others were kept.</summary>
    public int DrawnMapCount { get; private set; }

    /// <summary>Draws another preparation of the same scene from now on.</summary>
    public void SetScene(DrawableScene prepared)
    {
        _casters.Scene = prepared;
        _movingObjects.Clear();
        _movingObjects.AddRange(MovingObjectsOf(prepared));
        _version++;
    }

    /// <summary>Notes that an object stands elsewhere now.</summary>
    public void ObjectMoved(int index, AffineMap map)
    {
        if (_casters.Scene.Objects[index].IsDynamic)
        {
            _movingVersion++;
        }
        else
        {
            _version++;
            _lastCuller?.Move(index, map);
        }
    }

    /// <summary>Draws the maps that are not up to date. Another framebuffer is bound then.</summary>
    /// <param name="frame">View of the frame.</param>
    /// <param name="unitsPerSceneUnit">1, or more where the frame is drawn in a smaller unit.</param>
    /// <param name="spheres">Spheres beside the objects.</param>
    /// <param name="bounds">Bounds of all that is drawn, world space.</param>
    /// <param name="settings">Whether there are shadows, and whether they fit the view.</param>
    public void Update(
        in FrameView frame, double unitsPerSceneUnit, IReadOnlyList<SphereInstance> spheres, BoundingBox bounds, RenderSettings settings)
    {
        HasShadows = false;
        HasPointShadows = false;
        HasSlices = false;
        (MapCount, DrawnMapCount, SkippedMapCount, SkippedCasterCount) = (0, 0, 0, 0);
        if (!settings.Shadows || settings.Wireframe || settings.Shading != Shading.PerPixel || _lights.IsEmpty)
        {
            return;
        }

        _zoom = frame.View.DeepZoom;
        var origin = _zoom is null ? frame.View.Camera.Position : Vector.Zero;
        var reach = Math.Min(frame.Far, DeepZoomReach * frame.Near);
        var casters = _zoom is null ? bounds : new BoundingBox(-frame.Far * Vector.One, frame.Far * Vector.One);
        var fitsToView = settings.FitShadowsToView || _zoom is not null;
        // Nothing of the air of a scene is seen within a deep zoom.
        var isAirLit = _isAirLit && _zoom is null;
        var receivers = _zoom is null ? StandingBounds(bounds) : new(-reach * Vector.One, reach * Vector.One);
        _fit.Fit(_lights, in frame, origin, unitsPerSceneUnit, receivers, casters, fitsToView, settings.LightCulling, isAirLit);
        DistantLights = _fit.DistantLights;
        SkippedMapCount = _fit.SkippedCount;
        foreach (var view in _fit.Views)
        {
            HasShadows |= !view.IsIdle;
            HasPointShadows |= view.IsPerspective && !view.IsIdle;
        }

        if (_fit.Views.Count == 0)
        {
            return;
        }

        foreach (var (first, count) in _fit.Ranges)
        {
            HasSlices |= count > 1 && !_fit.Views[first].IsPerspective;
        }

        _fitsToView = fitsToView;
        Selection.Update(
            _casters.Scene, transforms.Bounds, spheres, bounds, in frame, _fit, fitsToView,
            settings.CasterCulling && _zoom is null && !isAirLit);
        SkippedCasterCount = Selection.SkippedCount;
        if (!Selection.HasCasters && spheres.Count == 0)
        {
            // Faces that turn away from a light are still dark, as those of lights with maps.
            SkippedMapCount += _fit.Views.Count;
            _fit.Clear();
        }

        MapCount = _fit.Views.Count;
        if (MapCount > 0)
        {
            DrawMaps(in frame, spheres, settings);
        }

        _block.Upload(_fit.Ranges, _fit.Views, Maps.Corners, Maps.TextureSize, origin);
    }

    /// <summary>Binds the maps and their views, where the frame has any.</summary>
    public void Bind()
    {
        if (HasShadows)
        {
            _block.Bind();
        }

        if (MapCount > 0)
        {
            Maps.BindTexture(GlState.ShadowTextureUnit, _hasMoving);
        }
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_fittedMaps, _wholeMaps, _block, _casters);

    private void DrawMaps(in FrameView frame, IReadOnlyList<SphereInstance> spheres, RenderSettings settings)
    {
        _fit.CutViews(_zoom is null ? frame.View.Section : frame.Section);
        RefreshCuller();
        for (var i = 0; i < _casters.Scene.Objects.Length; i++)
        {
            buffers.ShadowCuller.Include(i, Selection.IsSelected(i));
        }

        _culling = _shadowCulling.Of(settings);
        CasterRenderer.BeginMaps(frame.Section is not null);
        Maps.DrawStanding(_fit.Views, _culling, _zoom, _version + Selection.Version, settings.ReuseBuffers, _drawStanding ??= DrawStanding);
        DrawnMapCount = Maps.DrawnCount;
        _hasMoving = _zoom is null && (_movingObjects.Count > 0 || spheres.Count > 0);
        if (_hasMoving)
        {
            // A list of spheres may change within.
            _movingVersion += spheres.Count > 0 || _lastSpheres.Count > 0 || !settings.ReuseBuffers ? 1 : 0;
            _lastSpheres = spheres;
            DrawMoving(spheres);
        }

        CasterRenderer.EndMaps();
    }

    /// <summary>Bounds of what stands; all bounds where nothing does.</summary>
    private static IEnumerable<int> MovingObjectsOf(DrawableScene scene) =>
        Enumerable.Range(0, scene.Objects.Length).Where(i => scene.Objects[i].IsDynamic);

    private BoundingBox StandingBounds(BoundingBox bounds)
    {
        if (_movingObjects.Count == 0)
        {
            return bounds;
        }

        var standing = BoundingBox.Empty;
        for (var i = 0; i < _casters.Scene.Objects.Length; i++)
        {
            standing = _casters.Scene.Objects[i].IsDynamic ? standing : BoundingBox.Union(standing, transforms.Bounds[i]);
        }

        return standing.IsEmpty ? bounds : standing;
    }

    /// <summary>Notes when models were uploaded anew: their culler then has the places that the scene declares.</summary>
    private void RefreshCuller()
    {
        var culler = buffers.ShadowCuller;
        if (culler == _lastCuller)
        {
            return;
        }

        _lastCuller = culler;
        _version++;
        for (var i = 0; i < _casters.Scene.Objects.Length; i++)
        {
            culler.Move(i, transforms.ObjectToWorld[i]);
        }
    }

    private void DrawStanding(ShadowView view)
    {
        _casters.Begin(in view);
        _casters.DrawStatic(_culling, _zoom?.AboutEye(view.Position), Selection);
    }

    private void DrawMoving(IReadOnlyList<SphereInstance> spheres)
    {
        if (!Maps.TryBeginMoving(_movingVersion + Selection.Version))
        {
            return;
        }

        for (var i = 0; i < _fit.Views.Count; i++)
        {
            var view = _fit.Views[i];
            Maps.SelectMap(i, in view);
            _casters.Begin(in view);
            foreach (var index in _movingObjects)
            {
                if (Selection.IsSelected(index) && Maps.TryMark(i, in view, transforms.Bounds[index]))
                {
                    _casters.DrawWhole(index);
                }
            }

            var hasSpheres = false;
            for (var j = 0; j < spheres.Count; j++)
            {
                hasSpheres |= Maps.TryMark(i, in view, spheres[j].Bounds);
            }

            if (hasSpheres)
            {
                _casters.DrawSpheres(spheres);
            }
        }
    }
}
