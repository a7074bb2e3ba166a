using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Shadows;
using FractalEngine.Render.Upload;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Render.Frame;

/// <summary>
/// Draws the objects of a scene: opaque batches, loose spheres, then transparent batches from back to front. Each object is one instanced
/// draw call for each of its materials, whether it shows a mesh or a fractal.
/// </summary>
/// <remarks>
/// Frustum culling happens in two places. Fractals and static meshes come here as the instances that <see cref="SceneCuller"/> kept.
/// Meshes that physics moves are tested here, each box by <see cref="View.MayIntersectFrustum"/>.
/// </remarks>
/// <param name="context">Current context.</param>
/// <param name="scene">Scene to draw.</param>
/// <param name="buffers">Buffers of the same scene, filled before the first frame.</param>
/// <param name="transforms">Current transforms of its objects; read for each frame.</param>
internal sealed class ObjectsPass(
    RenderContext context, DrawableScene scene, SceneBuffers buffers, ObjectTransforms transforms) : IDisposable
{
    // Natural logarithm. In smaller units than this, point lights look the same.
    private const double MaxLogLightScale = 14;

    private readonly MeshPass _meshPass = new(context, scene.Source);
    private readonly LightBlock _lightBlock = new(context.Resources, scene.Source);
    private readonly ObjectBlocks _objectBlocks = new(context.Resources, scene.Objects.Length);
    private readonly DepthOrder _opaqueOrder = DepthOrder.Of(scene, static _ => true);
    private readonly ShadowPass _shadowPass = new(context, scene, buffers, transforms);
    private readonly SkyPass? _skyPass =
        scene.Source.Scene is { Sky: not null, Background: null } ? new(context.Resources, scene.Source.Scene) : null;

    private readonly AirPass? _airPass =
        scene.Source.Scene.Fog is { IsLit: true } ? new(context, scene.Source) : null;

    private readonly LampsPass? _lampsPass =
        LightBlock.SurfacesOf(scene.Source).IsEmpty ? null : new(context, LightBlock.LightsOf(scene.Source).Length);

    private DrawableScene _scene = scene;
    private DepthOrder _transparentOrder = DepthOrder.Of(scene, static model => model.HasTransparentBatches);
    private SphereBatch? _sphereBatch;
    private GlossMaps? _glossMaps;
    private ReflectionProbe? _probe;
    private bool _hasSkyParts;

    /// <summary>Bounds of the surfaces of lamps, world space; empty where there are none.</summary>
    public BoundingBox LampBounds { get; } = LightBlock.SurfacesOf(scene.Source);

    /// <summary>Number of objects that the last frame drew with one face of their triangles culled.</summary>
    public int BackFaceCulledCount { get; private set; }

    /// <summary>Depth maps of lights: drawn for the last frame, and kept from an earlier one.</summary>
    public RedundancyCounts ShadowMapCounts => new(_shadowPass.DrawnMapCount, _shadowPass.MapCount - _shadowPass.DrawnMapCount);

    /// <summary>Depth maps that the last frame did not need, and objects that it drew into none.</summary>
    public (int Maps, int Casters) SkippedShadows => (_shadowPass.SkippedMapCount, _shadowPass.SkippedCasterCount);

    /// <summary>Draws another preparation of the same scene from now on.</summary>
    public void SetScene(DrawableScene prepared)
    {
        _scene = prepared;
        _objectBlocks.ForgetColours();
        _transparentOrder = DepthOrder.Of(prepared, static model => model.HasTransparentBatches);
        _shadowPass.SetScene(prepared);
        _probe?.Forget();
    }

    /// <summary>Notes that an object stands elsewhere now.</summary>
    public void ObjectMoved(int index, AffineMap map)
    {
        _shadowPass.ObjectMoved(index, map);
        _probe?.Forget();
    }

    /// <summary>Notes that spheres stand elsewhere now.</summary>
    public void SpheresMoved() => _probe?.Forget();

    /// <summary>Returns the probe that has to be drawn before a frame; null for none.</summary>
    public ReflectionProbe? ProbeBefore(in FrameView frame, RenderSettings settings)
    {
        if (!_scene.HasGloss || _scene.Source.Scene.Probe is not { } position || settings.Wireframe || frame.View.DeepZoom is not null)
        {
            return null;
        }

        _probe ??= new(context, position);
        return _probe.Shows(settings) ? null : _probe;
    }

    /// <summary>Draws the depth maps of the lights, where they are not up to date.</summary>
    public void UpdateShadows(
        in FrameView frame, IReadOnlyList<SphereInstance> spheres, BoundingBox bounds, RenderSettings settings) =>
        _shadowPass.Update(in frame, LightScaleOf(frame.View), spheres, bounds, settings);

    /// <summary>Draws all objects into the bound framebuffer's viewport.</summary>
    /// <param name="frame">View of the frame.</param>
    /// <param name="spheres">Spheres beside the objects, not drawn in a deep zoom.</param>
    /// <param name="settings">Style and optimisations.</param>
    public void Draw(in FrameView frame, IReadOnlyList<SphereInstance> spheres, RenderSettings settings)
    {
        var view = frame.View;
        var probe = view.DeepZoom is null ? _probe?.Place : null;
        _lightBlock.Bind(GlState.LightBinding, view.Camera.Position, LightScaleOf(view), settings, probe, frame.IsProbe);
        if (_skyPass is not null && view.Background is null && !frame.IsProbe)
        {
            _skyPass.Draw(in frame);
        }

        _shadowPass.Bind();
        if (_scene.HasGloss)
        {
            (_glossMaps ??= new(context.Resources, _scene.Source.Scene)).Bind();
            if (probe is not null)
            {
                _probe!.BindTextures();
            }
        }

        _hasSkyParts = EffectiveCulling.HasSkyVisibility(settings);
        _meshPass.Begin(in frame, settings.Wireframe, FrameFeatures(settings), _shadowPass.DistantLights);
        DrawOpaque(in frame, settings);
        if (spheres.Count > 0 && view.DeepZoom is null)
        {
            _meshPass.Cull(CullFace.None);
            _meshPass.InnerFace = frame.Section is { HasCap: true } ? CullFace.Back : CullFace.None;
            _meshPass.UseMaterial(null, Colour.White, MeshFeatures.CameraRelative);
            _sphereBatch ??= new(context.Resources);
            _sphereBatch.Draw(spheres, view.Camera.Position, SphereInstance.Colour);
        }

        if (!settings.Wireframe)
        {
            (view.DeepZoom is null ? _lampsPass : null)?.Draw(in frame);
            DrawTransparent(view);
        }

        _meshPass.End();
    }

    /// <summary>Adds the light that the air scatters to a frame that is drawn otherwise.</summary>
    public void DrawAir(in FrameView frame, Framebuffer target, RenderSettings settings)
    {
        if (!settings.Wireframe)
        {
            _airPass?.Draw(in frame, target, FrameFeatures(settings), _shadowPass.DistantLights);
        }
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(
        _objectBlocks, _skyPass, _lampsPass, _airPass, _shadowPass, _sphereBatch, _glossMaps, _probe, _lightBlock, _meshPass);

    private MeshFeatures FrameFeatures(RenderSettings settings) =>
        (settings.Shading == Shading.PerPixel ? MeshFeatures.PerPixel : 0) | (_lightBlock.HasAtmosphere ? MeshFeatures.Atmosphere : 0)
        | (_shadowPass.HasShadows ? MeshFeatures.Shadows : 0)
        | (_shadowPass.HasPointShadows ? MeshFeatures.PointShadows : 0)
        | (_shadowPass.HasSlices ? MeshFeatures.ShadowSlices : 0);

    private static double LightScaleOf(View view) =>
        view.DeepZoom is { } zoom ? Math.Exp(Math.Min(-zoom.LogUnit, MaxLogLightScale)) : 1;

    private void DrawOpaque(in FrameView frame, RenderSettings settings)
    {
        BackFaceCulledCount = 0;
        foreach (var i in _opaqueOrder.SortFrontToBack(frame.View.Camera, transforms.Bounds))
        {
            var item = _scene.Objects[i];
            if (item.IsDynamic && frame.Offset == default && settings.Culling is { FrustumCulling: true }
                && !frame.View.MayIntersectFrustum(transforms.Bounds[i], frame.Aspect))
            {
                continue;
            }

            var culledFace = frame.IsProbe ? InnerFaceOf(i)
                : settings.Wireframe || !settings.BackFaceCulling ? CullFace.None : FaceToCull(i, in frame);
            BackFaceCulledCount += culledFace == CullFace.None ? 0 : 1;
            _meshPass.Cull(culledFace);
            _meshPass.InnerFace = frame.Section is { HasCap: true } ? InnerFaceOf(i) : CullFace.None;
            BindObjectBlock(i, frame.View);
            if (settings.Wireframe)
            {
                _meshPass.UseMaterial(null, Colour.White, FeaturesOf(i, CullFace.None));
                DrawInstances(i, buffers.BuffersOf(item.Model).WholeMesh);
            }
            else
            {
                DrawBatches(
                    i, drawsTransparent: false,
                    FeaturesOf(i, culledFace) | (HidesSides(i, culledFace, in frame) ? MeshFeatures.CoveredSides : MeshFeatures.None));
            }
        }
    }

    /// <summary>
    /// Draws the transparent batches, the farthest object first, and of each object the faces that point away first. The colours of a
    /// convex object then blend in the right order. Triangles within one side and instances of a fractal are not sorted.
    /// </summary>
    private void DrawTransparent(View view)
    {
        MeshPass.BeginTransparent();
        _meshPass.InnerFace = CullFace.None;
        foreach (var index in _transparentOrder.SortBackToFront(view.Camera, transforms.Bounds))
        {
            BindObjectBlock(index, view);
            var isMirrored = transforms.ObjectToWorld[index].Linear.Determinant() < 0;
            _meshPass.Cull(isMirrored ? CullFace.Back : CullFace.Front);
            DrawBatches(index, drawsTransparent: true, FeaturesOf(index, CullFace.None));
            _meshPass.Cull(isMirrored ? CullFace.Front : CullFace.Back);
            DrawBatches(index, drawsTransparent: true, FeaturesOf(index, CullFace.None));
        }

        MeshPass.EndTransparent();
    }

    /// <summary>Draws the batches of an object that are opaque, or those that are transparent.</summary>
    private void DrawBatches(int index, bool drawsTransparent, MeshFeatures instanceFeatures)
    {
        var item = _scene.Objects[index];
        foreach (ref readonly var batch in item.Model.Batches.AsSpan())
        {
            if (batch.IsTransparent == drawsTransparent)
            {
                buffers.BindTexture(batch.Material);
                _meshPass.UseMaterial(
                    batch.Material, item.Tint, instanceFeatures, batch.Material is null ? item.SurfaceGradient : null);
                DrawInstances(index, batch);
            }
        }
    }

    private void DrawInstances(int index, DrawableBatch batch)
    {
        if (buffers.Culler.SelectsInstances(index))
        {
            buffers.Culler.Draw(index, batch);
        }
        else
        {
            buffers.BuffersOf(_scene.Objects[index].Model).Draw(batch);
        }
    }

    private void BindObjectBlock(int index, View view)
    {
        if (buffers.Culler.SelectsInstances(index))
        {
            _objectBlocks.BindRelative(_scene.Objects[index]);
        }
        else
        {
            _objectBlocks.Bind(index, _scene.Objects[index], transforms.ObjectToWorld[index], view.Camera.Position);
        }
    }

    private MeshFeatures FeaturesOf(int index, CullFace culledFace) =>
        (buffers.Culler.SelectsInstances(index) ? MeshFeatures.CameraRelative : MeshFeatures.None)
        | (_hasSkyParts && buffers.Culler.HasSkyParts(index) ? MeshFeatures.SkyParts : MeshFeatures.None)
        | (culledFace == CullFace.Back ? MeshFeatures.FrontFacesOnly : MeshFeatures.None)
        | (_scene.Objects[index].Model.Colours.IsEmpty ? MeshFeatures.None : MeshFeatures.VertexColours);

    /// <summary>Returns the face of an object's triangles that is certainly invisible; none where both may be seen.</summary>
    private CullFace FaceToCull(int index, in FrameView frame)
    {
        var orientation = Math.Sign(transforms.ObjectToWorld[index].Linear.Determinant());
        var isCulled = buffers.Culler.SelectsInstances(index);
        var windingSign = orientation
            * (isCulled ? buffers.Culler.WindingSign(index) : _scene.Objects[index].Model.WindingSign);
        // A solid that the near plane or a section cuts shows its inner side. Culling has tested its instances one by one.
        return isCulled || (frame.Section is null && frame.View.IsBeyondDepth(transforms.Bounds[index], frame.Near))
            ? GlState.BackFacesOf(windingSign)
            : CullFace.None;
    }

    /// <summary>
    /// Tells whether sides that neighbours cover may be left out. A neighbour that the near plane, a section or a probe leaves out covers
    /// nothing.
    /// </summary>
    private bool HidesSides(int index, CullFace culledFace, in FrameView frame) =>
        culledFace != CullFace.None && buffers.Culler.HasCoveredSides(index) && frame is { IsProbe: false, Section: null }
        && frame.View.DeepZoom is null && frame.View.IsBeyondDepth(transforms.Bounds[index], frame.Near);

    /// <summary>Returns the face of an object's triangles that lies inside; none for open surfaces.</summary>
    private CullFace InnerFaceOf(int index) =>
        GlState.BackFacesOf(Math.Sign(transforms.ObjectToWorld[index].Linear.Determinant()) * _scene.Objects[index].Model.SolidSign.Value);
}
