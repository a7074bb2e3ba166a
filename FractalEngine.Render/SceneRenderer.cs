using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Frame;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Upload;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Render;

/// <summary>
/// Holds a prepared scene on the GPU, moves its objects and culls its instances; <see cref="FrameRenderer"/> draws it. Meshes are uploaded
/// once. Of a moved object only the matrix is uploaded again.
/// </summary>
public sealed class SceneRenderer : IDisposable
{
    private readonly SceneBuffers _buffers;
    private ObjectTransforms _transforms;
    private ObjectsPass _objectsPass;
    private readonly DerivedCulling _effectiveCulling;
    private BoundingBox? _bounds;
    private bool _hasMoved;
    private bool _isDisposed;
    private IReadOnlyList<SphereInstance> _spheres = [];
    private RedundancyCounts _frameUploads;
    private RedundancyCounts _frameStateChanges;
    private int _frameDrawCalls;

    /// <summary>Uploads a scene, on the context's thread.</summary>
    /// <param name="context">Context to draw in. It must outlive this renderer.</param>
    /// <param name="scene">Scene to draw, prepared on any thread.</param>
    /// <exception cref="GlException">The GPU's memory does not suffice.</exception>
    public SceneRenderer(RenderContext context, DrawableScene scene)
    {
        context.MakeCurrent();
        Scene = scene;
        Context = context;
        _effectiveCulling = new(settings => EffectiveCulling.Of(settings, context.MaxSampleCount));
        _transforms = new(scene);
        _buffers = new(context.Resources);
        _objectsPass = new(context, scene, _buffers, _transforms);
        Gl.GlObject.DisposeOnFailure(this, () => _buffers.Upload(scene));
    }

    /// <summary>Scene that is drawn, as far as it is prepared.</summary>
    public DrawableScene Scene { get; private set; }

    /// <summary>
    /// Bounds of all objects at their current positions, world space. Dynamic objects and spheres count only while they
    /// stay near; <see cref="ClipPlanes"/> follows the objects wherever they are in view.
    /// </summary>
    public BoundingBox Bounds => _bounds ??= SceneBounds.Compute(Scene, _transforms.Bounds, _spheres);

    /// <summary>Spheres that are drawn beside the scene's objects. Those far outside the scene are not visible.</summary>
    public IReadOnlyList<SphereInstance> Spheres
    {
        get => _spheres;
        set
        {
            if (value.Count > 0 || _spheres.Count > 0)
            {
                _bounds = null;
                _objectsPass.SpheresMoved();
            }

            _spheres = value;
        }
    }

    /// <summary>Lines that are drawn over the scene: in world space, or in a deep zoom in the frame of its roots.</summary>
    public IReadOnlyList<LineSegment> Lines { get; set; } = [];

    /// <summary>A box, world space, in which lines are seen though no object is there: the clip planes enclose it.</summary>
    public BoundingBox LineBounds { get; set; } = BoundingBox.Empty;

    /// <summary>
    /// Counts and times of the last frame, where instances are culled (<see cref="RenderSettings.Culling"/>). Reading it costs a pass over
    /// the scene's objects.
    /// </summary>
    public FrameStatistics Statistics => new(
        Culler.InstanceCount, Culler.TriangleCount, Culler.Statistics, Culler.MinProjectedSize, Culler.CullCount, Culler.UploadedBytes,
        Culler.CullWaitTime, OptimisationStatistics)
    {
        DrawCallCount = _frameDrawCalls,
    };

    /// <summary>Size in pixels below which the last frame drew a sub-fractal as one instance.</summary>
    public double MinProjectedSize => Culler.MinProjectedSize;

    /// <summary>Buffer uploads since the context was opened: performed, and skipped as redundant.</summary>
    public RedundancyCounts UploadCounts => Context.Resources.UploadFilter.Counts;

    /// <summary>Bindings and uniforms since the context was opened: performed, and skipped as redundant.</summary>
    public RedundancyCounts StateChangeCounts => Context.Resources.State.Filter.Counts;

    internal RenderContext Context { get; }

    /// <summary>Culls the instances of the scene and holds the visible ones.</summary>
    internal SceneCuller Culler => _buffers.Culler;

    private OptimisationStatistics OptimisationStatistics => new(
        Scene.Objects.Length, _objectsPass.BackFaceCulledCount, Scene.Models.Length,
        Scene.Models.Count(static model => model.IsPlaceholder), Scene.Textures.Length,
        Scene.Models.Sum(static model => (long)model.DegenerateTriangleCount), _frameUploads, _frameStateChanges)
    {
        ShadowMaps = _objectsPass.ShadowMapCounts,
        SkippedShadowMaps = _objectsPass.SkippedShadows.Maps,
        SkippedCasters = _objectsPass.SkippedShadows.Casters,
        SkippedBakes = Scene.Models.Count(static model => model.HasOpenSky && model.LodHierarchy is { IsSkyBaked: false }),
    };

    /// <summary>Replaces the models by those of a further preparation of the same scene, on the context's thread.</summary>
    /// <param name="scene">Same scene, with more of its models prepared. Objects keep their current positions.</param>
    /// <exception cref="GlException">
    /// The driver refuses something, or the GPU's memory does not suffice: nothing has changed.
    /// </exception>
    public void Update(DrawableScene scene)
    {
        MakeCurrent();
        _buffers.Upload(scene);
        _objectsPass.SetScene(scene);
        Scene = scene;
        for (var i = 0; i < scene.Objects.Length; i++)
        {
            Culler.Move(i, _transforms.ObjectToWorld[i]);
        }
    }

    /// <summary>Shows another scene, on the context's thread. Models and textures that both scenes have stay on the GPU.</summary>
    /// <param name="scene">A scene whose objects stand where it declares them.</param>
    /// <exception cref="GlException">
    /// The driver refuses something, or the GPU's memory does not suffice: nothing has changed.
    /// </exception>
    public void Replace(DrawableScene scene)
    {
        MakeCurrent();
        var transforms = new ObjectTransforms(scene);
        var objectsPass = new ObjectsPass(Context, scene, _buffers, transforms);
        Gl.GlObject.DisposeOnFailure(objectsPass, () => _buffers.Upload(scene));
        _objectsPass.Dispose();
        _objectsPass = objectsPass;
        _transforms = transforms;
        Scene = scene;
        _bounds = null;
        _hasMoved = false;
        Spheres = [];
        Lines = [];
    }

    /// <summary>Moves an object of the scene.</summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="map">Map from the model's frame to world space.</param>
    public void Move(int index, AffineMap map)
    {
        var (first, count) = Scene.ItemsOf(index).GetOffsetAndLength(Scene.Objects.Length);
        for (var item = first; item < first + count; item++)
        {
            MoveItem(item, map);
        }
    }

    private void MoveItem(int index, AffineMap map)
    {
        if (_transforms.ObjectToWorld[index] == map)
        {
            return;
        }

        var item = Scene.Objects[index];
        _transforms.Set(index, map, item.Model.Bounds);
        Culler.Move(index, map);
        _objectsPass.ObjectMoved(index, map);
        _hasMoved = true;
        if (!item.IsDynamic)
        {
            _bounds = null;
        }
    }

    /// <summary>Returns the depths of the near and far clip planes of a frame.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <param name="settings">Whether grid and axes are drawn.</param>
    /// <returns>
    /// Those of <see cref="View.ClipPlanes"/>, unless they would cut away an object in view: then planes that enclose all objects in view,
    /// up to a ratio of 10¹². In scene units.
    /// </returns>
    public (double Near, double Far) ClipPlanes(View view, int width, int height, RenderSettings settings) => SceneClipPlanes.Of(
        view, view.EffectiveAspect(width, height),
        BoundingBox.Union(LinesPass.BoundsIncludingLines(Bounds, settings), BoundingBox.Union(_objectsPass.LampBounds, LineBounds)),
        settings.Grid || settings.Axes || !_objectsPass.LampBounds.IsEmpty || !LineBounds.IsEmpty, _transforms.Bounds, _spheres,
        _hasMoved ? SceneBounds.GridOf(Scene) : 0);

    /// <summary>Culls the instances for a frame without drawing it, on the context's thread.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <param name="settings">Culling and other optimisations.</param>
    public void Cull(View view, int width, int height, RenderSettings settings)
    {
        MakeCurrent();
        Context.ApplySettings(settings);
        CullFrame(FrameView.Create(view, width, height, ClipPlanes(view, width, height, settings)), settings);
    }

    /// <summary>Deletes the scene's buffers and shaders. Harmless when repeated.</summary>
    public void Dispose()
    {
        _isDisposed = true;
        Gl.GlObject.DisposeAll(_buffers, _objectsPass);
    }

    /// <summary>Makes the context current, as whatever calls GL must do first.</summary>
    /// <exception cref="ObjectDisposedException">The renderer or its context was disposed.</exception>
    internal void MakeCurrent()
    {
        ObjectDisposedException.ThrowIf(_isDisposed, this);
        Context.MakeCurrent();
    }

    /// <summary>Draws the depth maps of the lights, where they are not up to date. Binds a framebuffer of its own.</summary>
    /// <param name="frame">View of the frame.</param>
    /// <param name="settings">Style and optimisations.</param>
    internal void UpdateShadows(in FrameView frame, RenderSettings settings) =>
        _objectsPass.UpdateShadows(in frame, _spheres, Bounds, settings);

    /// <summary>Returns the reflection probe that has to be drawn before a frame; null for none.</summary>
    internal ReflectionProbe? ProbeBefore(in FrameView frame, RenderSettings settings) => _objectsPass.ProbeBefore(in frame, settings);

    /// <summary>Draws into the bound framebuffer's viewport.</summary>
    /// <param name="frame">View of the frame.</param>
    /// <param name="nextFrame">Probable view of the next frame, which is culled on other threads meanwhile; null for none.</param>
    /// <param name="settings">Style and optimisations.</param>
    internal void Draw(in FrameView frame, FrameView? nextFrame, RenderSettings settings)
    {
        var uploadsBefore = UploadCounts;
        var stateChangesBefore = StateChangeCounts;
        var drawCallsBefore = Context.Resources.State.DrawCallCount;
        CullFrame(in frame, settings);
        if (nextFrame is { } next && _effectiveCulling.Of(settings) is { } culling)
        {
            Culler.StartSpeculativeCull(next.ToCullingView(), culling, next.View.DeepZoom);
        }

        _objectsPass.Draw(in frame, _spheres, settings);
        _frameUploads = UploadCounts - uploadsBefore;
        _frameStateChanges = StateChangeCounts - stateChangesBefore;
        _frameDrawCalls = (int)(Context.Resources.State.DrawCallCount - drawCallsBefore);
    }

    /// <summary>Adds the light that the air scatters, after all else.</summary>
    internal void DrawAir(in FrameView frame, Gl.Framebuffer target, RenderSettings settings) =>
        _objectsPass.DrawAir(in frame, target, settings);

    private void CullFrame(in FrameView frame, RenderSettings settings)
    {
        if (_effectiveCulling.Of(settings) is { } culling)
        {
            Culler.Cull(frame.ToCullingView(), culling, frame.View.DeepZoom);
        }
    }
}
