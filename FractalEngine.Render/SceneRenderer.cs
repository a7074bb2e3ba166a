using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Passes;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Render;

/// <summary>
/// A prepared scene on the GPU. Uploaded once; each object is one instanced draw call for each of its materials, whether it shows a mesh or
/// a fractal. Objects can move: then only their own matrix is uploaded again.
/// </summary>
public sealed class SceneRenderer : IDisposable
{
    // Natural logarithm. From deeper down lights with a place look the same.
    private const double MaxLogLightScale = 14;

    // Of the palette: coral.
    private const int SphereColourIndex = 2;

    private readonly MeshPass _meshPass;
    private readonly LightBlock _lightBlock;
    private TransparentOrder _transparentOrder;
    private readonly TextureSet _textureSet;
    private readonly EffectiveCulling _effectiveCulling = new();
    private readonly Dictionary<DrawableModel, ModelBuffers> _modelBuffers = [];
    private readonly ObjectBlock[] _objectBlocks;
    private readonly AffineMap[] _objectMaps;
    private readonly BoundingBox[] _objectBounds;
    private SceneCuller? _culler;
    private BoundingBox? _bounds;
    private SphereBatch? _sphereBatch;
    private IReadOnlyList<SphereInstance> _spheres = [];
    private (RedundancyCounts Uploads, RedundancyCounts State) _countsBefore;
    private (RedundancyCounts Uploads, RedundancyCounts State) _countsAfter;
    private int _backFaceCulledCount;

    /// <summary>Uploads a scene. On the context's thread.</summary>
    /// <exception cref="Gl.GlException">The GPU's memory does not suffice.</exception>
    public SceneRenderer(RenderContext context, DrawableScene scene)
    {
        context.MakeCurrent();
        (Scene, Context) = (scene, context);
        _objectMaps = [.. scene.Objects.Select(item => item.Map)];
        _objectBounds = [.. scene.Source.Objects.Select(placed => placed.Bounds)];
        _meshPass = new(context);
        _lightBlock = new(context.Resources, scene.Source.Scene.Lights, scene.Source.Bounds);
        _objectBlocks = [.. scene.Objects.Select(item => new ObjectBlock(context.Resources, item.Name))];
        (_transparentOrder, _textureSet) = (new([]), new());
        try
        {
            Upload();
        }
        catch
        {
            Dispose();
            throw;
        }
    }

    /// <summary>What is drawn.</summary>
    public DrawableScene Scene { get; private set; }

    /// <summary>
    /// A box that holds all objects where they are now, world space; of those that move all the time only as far as they stay near. What
    /// falls out of the scene goes out of sight beyond the far plane, and does not take the planes with it.
    /// </summary>
    public BoundingBox Bounds => _bounds ??= SceneBounds.Compute(Scene, _objectBounds, _spheres);

    /// <summary>Balls beside the scene's objects. Those far out of the scene are not drawn.</summary>
    public IReadOnlyList<SphereInstance> Spheres
    {
        get => _spheres;
        set
        {
            var mayChangeBounds = value.Count > 0 || _spheres.Count > 0;
            (_spheres, _bounds) = (value, mayChangeBounds ? null : _bounds);
        }
    }

    /// <summary>Lines beside the scene's objects.</summary>
    public IReadOnlyList<LineSegment> Lines { get; set; } = [];

    /// <summary>
    /// What the last picture took, where instances are chosen (<see cref="RenderSettings.Culling"/>). Counted out when it is asked for.
    /// </summary>
    public FrameStatistics Statistics => new(
        Culler.InstanceCount, Culler.TriangleCount, Culler.Statistics, Culler.MinProjectedSize, Culler.CullCount, Culler.UploadedBytes,
        Culler.CullWaitTime,
        new(
            Scene.Objects.Length, _backFaceCulledCount, Scene.Models.Length, Scene.Models.Count(static model => model.IsPlaceholder),
            Scene.Textures.Length,
            Scene.Models.Sum(static model => (long)model.DegenerateTriangleCount), _countsAfter.Uploads - _countsBefore.Uploads,
            _countsAfter.State - _countsBefore.State));

    /// <summary>Sub-fractals of fewer pixels were drawn as one copy in the last picture.</summary>
    public double MinProjectedSize => Culler.MinProjectedSize;

    /// <summary>Buffers moved to the GPU since the context was opened, and those that were there already.</summary>
    public RedundancyCounts UploadCounts => Context.Resources.UploadFilter.Counts;

    /// <summary>Bindings and uniforms since the context was opened, and those that held already.</summary>
    public RedundancyCounts StateChangeCounts => Context.Resources.State.Filter.Counts;

    internal RenderContext Context { get; }

    /// <summary>The instances that were chosen for the last picture, and what that took.</summary>
    internal SceneCuller Culler => _culler!;

    /// <summary>
    /// Takes over what has been prepared since: the same scene with other models. Objects stay where they are. On the context's thread.
    /// </summary>
    /// <exception cref="Gl.GlException">The GPU's memory does not suffice.</exception>
    public void Update(DrawableScene scene)
    {
        Context.MakeCurrent();
        _culler?.Dispose();
        _culler = null;
        foreach (var model in _modelBuffers.Keys.Except(scene.Models).ToArray())
        {
            _modelBuffers[model].Dispose();
            _modelBuffers.Remove(model);
        }

        Scene = scene;
        Upload();
        for (var i = 0; i < _objectMaps.Length; i++)
        {
            Culler.Move(i, _objectMaps[i]);
        }
    }

    /// <summary>Where an object is now.</summary>
    /// <param name="index">Its place in the scene, from 0.</param>
    public AffineMap MapOf(int index) => _objectMaps[index];

    /// <summary>Moves an object.</summary>
    /// <param name="index">Its place in the scene, from 0.</param>
    /// <param name="map">From the model's frame to world space.</param>
    public void Move(int index, AffineMap map)
    {
        if (_objectMaps[index] != map)
        {
            _objectMaps[index] = map;
            _objectBounds[index] = Scene.Objects[index].Model.Bounds.Transform(map);
            Culler.Move(index, map);
            _bounds = Scene.Objects[index].IsDynamic ? _bounds : null;
        }
    }

    /// <summary>Chooses the instances that a picture needs, without drawing it. On the context's thread.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Of the picture, pixels.</param>
    /// <param name="height">Of the picture, pixels.</param>
    /// <param name="settings">What is left out.</param>
    public void Cull(View view, int width, int height, RenderSettings settings)
    {
        Context.MakeCurrent();
        Context.ApplySettings(settings);
        var (_, _, viewportWidth, viewportHeight) = view.Viewport(width, height);
        Cull(view, (viewportWidth, viewportHeight), view.EffectiveAspect(width, height), LinesPass.BoundsIncludingLines(Bounds, settings),
            settings);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _culler?.Dispose();
        foreach (var buffers in _modelBuffers.Values)
        {
            buffers.Dispose();
        }

        foreach (var block in _objectBlocks)
        {
            block.Dispose();
        }

        _sphereBatch?.Dispose();
        _textureSet.Dispose();
        _lightBlock.Dispose();
        _meshPass.Dispose();
    }

    /// <summary>Draws into the bound framebuffer's viewport.</summary>
    internal void Draw(View view, (int Width, int Height) viewportSize, double aspect, BoundingBox bounds, RenderSettings settings,
        View? nextView)
    {
        _countsBefore = (UploadCounts, StateChangeCounts);
        Cull(view, viewportSize, aspect, bounds, settings);
        if (nextView is not null && _effectiveCulling.Resolve(settings) is { } nextCulling)
        {
            Culler.StartSpeculativeCull(
                SceneCuller.ToCullingView(nextView, viewportSize.Width, viewportSize.Height, aspect, nextView.ClipPlanes(bounds)),
                nextCulling, nextView.DeepZoom);
        }

        _meshPass.Begin(view, aspect, bounds, settings.Wireframe, settings.Shading);
        _lightBlock.Bind(MeshPass.LightBinding, view.Camera.Position, view.DeepZoom is { } zoom
            ? Math.Exp(Math.Min(-zoom.LogUnit, MaxLogLightScale))
            : 1);
        _backFaceCulledCount = 0;
        for (var i = 0; i < _objectBlocks.Length; i++)
        {
            if (Scene.Objects[i].IsDynamic && settings.Culling is { FrustumCulling: true }
                && !view.MayIntersectFrustum(_objectBounds[i], aspect))
            {
                continue;
            }

            var culledFace = settings.Wireframe || !settings.BackFaceCulling ? null : FaceToCull(i, view, bounds);
            _backFaceCulledCount += culledFace is null ? 0 : 1;
            _meshPass.Cull(culledFace);
            BindObjectBlock(i, view);
            if (settings.Wireframe)
            {
                _meshPass.UseMaterial(null, Colour.White, FeaturesOf(i, null));
                DrawInstances(i, _modelBuffers[Scene.Objects[i].Model].WholeMesh);
            }
            else
            {
                DrawBatches(i, drawsTransparent: false, FeaturesOf(i, culledFace));
            }
        }

        if (Spheres.Count > 0 && view.DeepZoom is null)
        {
            _meshPass.Cull(null);
            _meshPass.UseMaterial(null, Colour.White, MeshFeatures.CameraRelative);
            (_sphereBatch ??= new(Context.Resources)).Draw(Spheres, view.Camera.Position, ObjectPalette.ColourOf(SphereColourIndex));
        }

        if (!settings.Wireframe)
        {
            DrawTransparent(view);
        }

        _meshPass.End();
        _countsAfter = (UploadCounts, StateChangeCounts);
    }

    /// <summary>Moves to the GPU what is not there yet.</summary>
    private void Upload()
    {
        _transparentOrder = new([.. Enumerable.Range(0, Scene.Objects.Length).Where(i => Scene.Objects[i].Model.HasTransparentBatches)]);
        _textureSet.Upload(Context.Resources, Scene.Textures);
        foreach (var model in Scene.Models.Where(model => !_modelBuffers.ContainsKey(model)))
        {
            _modelBuffers.Add(model, new(Context.Resources, model));
        }

        _culler = new(Context.Resources, Scene, _modelBuffers);
    }

    private void Cull(View view, (int Width, int Height) viewportSize, double aspect, BoundingBox bounds, RenderSettings settings)
    {
        if (_effectiveCulling.Resolve(settings) is { } culling)
        {
            Culler.Update(SceneCuller.ToCullingView(view, viewportSize.Width, viewportSize.Height, aspect, view.ClipPlanes(bounds)),
                culling, view.DeepZoom);
        }
    }

    private void BindObjectBlock(int index, View view)
    {
        var (item, map) = (Scene.Objects[index], _objectMaps[index]);
        // Chosen instances are in world axes about the camera already.
        var modelToWorld = Culler.SelectsInstances(index)
            ? AffineMap.Translate(view.Camera.Position)
            : new AffineMap(map.Linear, map * item.Model.Origin);
        _objectBlocks[index].Bind(MeshPass.ObjectBinding, modelToWorld, item.Colour, item.Gradient?.EndColour
            ?? item.Colour, view.Camera.Position);
    }

    private MeshFeatures FeaturesOf(int index, bool? culledFace) =>
        (Culler.SelectsInstances(index) ? MeshFeatures.CameraRelative : MeshFeatures.None) | (culledFace == false
        ? MeshFeatures.FrontFacesOnly
        : MeshFeatures.None);

    private void DrawInstances(int index, DrawableBatch batch)
    {
        if (Culler.SelectsInstances(index))
        {
            Culler.Draw(index, batch);
        }
        else
        {
            _modelBuffers[Scene.Objects[index].Model].Draw(batch);
        }
    }

    /// <summary>Draws those materials of an object that are opaque, or those that are not.</summary>
    private void DrawBatches(int index, bool drawsTransparent, MeshFeatures instanceFeatures)
    {
        var item = Scene.Objects[index];
        foreach (ref readonly var batch in item.Model.Batches.AsSpan())
        {
            if (batch.IsTransparent == drawsTransparent)
            {
                _textureSet.Bind(batch.Material);
                _meshPass.UseMaterial(batch.Material, item.Tint, instanceFeatures);
                DrawInstances(index, batch);
            }
        }
    }

    /// <summary>
    /// Draws what is transparent, the farthest object first, and of each object first the sides that look away: then the colours of a
    /// convex one mix in the right order. Triangles of one side and instances of a fractal are not sorted.
    /// </summary>
    private void DrawTransparent(View view)
    {
        MeshPass.BeginTransparent();
        foreach (var index in _transparentOrder.SortBackToFront(view.Camera, _objectBounds))
        {
            BindObjectBlock(index, view);
            var cullsFrontFirst = _objectMaps[index].Linear.Determinant() >= 0;
            _meshPass.Cull(cullsFrontFirst);
            DrawBatches(index, drawsTransparent: true, FeaturesOf(index, null));
            _meshPass.Cull(!cullsFrontFirst);
            DrawBatches(index, drawsTransparent: true, FeaturesOf(index, null));
        }

        MeshPass.EndTransparent();
    }

    /// <summary>The side of an object's triangles that certainly is not seen: true for the front, null where both may be.</summary>
    private bool? FaceToCull(int index, View view, BoundingBox bounds)
    {
        var orientation = Math.Sign(_objectMaps[index].Linear.Determinant());
        if (Culler.SelectsInstances(index))
        {
            var visibleSign = Culler.WindingSign(index) * orientation;
            return visibleSign == 0 ? null : visibleSign < 0;
        }

        var modelSign = Scene.Objects[index].Model.WindingSign * orientation;
        return modelSign != 0 && view.IsBeyondNearPlane(_objectBounds[index], bounds) ? modelSign < 0 : null;
    }
}
