using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Passes;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Render;

/// <summary>
/// A prepared scene on the GPU. Uploaded once; each object is one instanced draw call for each of its materials, whether it shows a mesh or a
/// fractal. Objects can move: then only their own matrix is uploaded again.
/// </summary>
public sealed class SceneRenderer : IDisposable
{
    // Natural logarithm. From deeper down lights with a place look the same.
    private const double DeepestLight = 14;

    // Of the palette: coral.
    private const int BallColour = 2;

    private readonly MeshPass _pass;
    private readonly LightBlock _lights;
    private TransparentOrder _transparent;
    private readonly TextureSet _textures;
    private readonly AdaptedDetail _adapted = new();
    private readonly Dictionary<DrawableModel, ModelBuffers> _models = [];
    private readonly ObjectBlock[] _blocks;
    private readonly AffineMap[] _maps;
    private readonly BoundingBox[] _boxes;
    private SceneDetail? _detail;
    private BoundingBox? _bounds;
    private BallInstances? _balls;
    private IReadOnlyList<LooseBall> _looseBalls = [];
    private (ChangeCounts Uploads, ChangeCounts State) _before;
    private (ChangeCounts Uploads, ChangeCounts State) _after;
    private int _oneSided;

    /// <summary>Uploads a scene. On the context's thread.</summary>
    /// <exception cref="Gl.GlException">The GPU's memory does not suffice.</exception>
    public SceneRenderer(RenderContext context, DrawableScene scene)
    {
        context.MakeCurrent();
        (Scene, Context) = (scene, context);
        _maps = [.. scene.Objects.Select(item => item.Map)];
        _boxes = [.. scene.Source.Objects.Select(placed => placed.Bounds)];
        _pass = new(context);
        _lights = new(context.Resources, scene.Source.Scene.Lights, scene.Source.Bounds);
        _blocks = [.. scene.Objects.Select(item => new ObjectBlock(context.Resources, item.Name))];
        (_transparent, _textures) = (new([]), new());
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
    /// A box that holds all objects where they are now, world space; of those that move all the time only as far as they stay near. What falls out of the scene
    /// goes out of sight beyond the far plane, and does not take the planes with it.
    /// </summary>
    public BoundingBox Bounds => _bounds ??= SceneBounds.Of(Scene, _boxes, _looseBalls);

    /// <summary>Balls beside the scene's objects. Those far out of the scene are not drawn.</summary>
    public IReadOnlyList<LooseBall> Balls
    {
        get => _looseBalls;
        set
        {
            var isChange = value.Count > 0 || _looseBalls.Count > 0;
            (_looseBalls, _bounds) = (value, isChange ? null : _bounds);
        }
    }

    /// <summary>Lines beside the scene's objects.</summary>
    public IReadOnlyList<LineSegment> Lines { get; set; } = [];

    /// <summary>What the last picture took, where instances are chosen (<see cref="RenderSettings.Detail"/>). Counted out when it is asked for.</summary>
    public FrameStatistics Statistics => new(
        Detail.InstanceCount, Detail.TriangleCount, Detail.Cost, Detail.PixelSize, Detail.Choices, Detail.UploadedBytes, Detail.WaitedFor,
        new(
            Scene.Objects.Length, _oneSided, Scene.Models.Length, Scene.Models.Count(static model => model.IsPlaceholder), Scene.Textures.Length,
            Scene.Models.Sum(static model => (long)model.EmptyFaces), _after.Uploads - _before.Uploads, _after.State - _before.State));

    /// <summary>Sub-fractals of fewer pixels were drawn as one copy in the last picture.</summary>
    public double PixelSize => Detail.PixelSize;

    /// <summary>Buffers moved to the GPU since the context was opened, and those that were there already.</summary>
    public ChangeCounts Uploads => Context.Resources.Uploads.Counts;

    /// <summary>Bindings and uniforms since the context was opened, and those that held already.</summary>
    public ChangeCounts StateChanges => Context.Resources.State.Changes.Counts;

    internal RenderContext Context { get; }

    /// <summary>The instances that were chosen for the last picture, and what that took.</summary>
    internal SceneDetail Detail => _detail!;

    /// <summary>Takes over what has been prepared since: the same scene with other models. Objects stay where they are. On the context's thread.</summary>
    /// <exception cref="Gl.GlException">The GPU's memory does not suffice.</exception>
    public void Update(DrawableScene scene)
    {
        Context.MakeCurrent();
        _detail?.Dispose();
        _detail = null;
        foreach (var model in _models.Keys.Except(scene.Models).ToArray())
        {
            _models[model].Dispose();
            _models.Remove(model);
        }

        Scene = scene;
        Upload();
        for (var i = 0; i < _maps.Length; i++)
        {
            Detail.Move(i, _maps[i]);
        }
    }

    /// <summary>Where an object is now.</summary>
    /// <param name="index">Its place in the scene, from 0.</param>
    public AffineMap MapOf(int index) => _maps[index];

    /// <summary>Moves an object.</summary>
    /// <param name="index">Its place in the scene, from 0.</param>
    /// <param name="map">From the model's frame to world space.</param>
    public void Move(int index, AffineMap map)
    {
        if (_maps[index] != map)
        {
            _maps[index] = map;
            _boxes[index] = Scene.Objects[index].Model.Bounds.Transform(map);
            Detail.Move(index, map);
            _bounds = Scene.Objects[index].IsMoving ? _bounds : null;
        }
    }

    /// <summary>Chooses the instances that a picture needs, without drawing it. On the context's thread.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Of the picture, pixels.</param>
    /// <param name="height">Of the picture, pixels.</param>
    /// <param name="settings">What is left out.</param>
    public void Choose(View view, int width, int height, RenderSettings settings)
    {
        Context.MakeCurrent();
        Context.Follow(settings);
        var (_, _, shownWidth, shownHeight) = view.Viewport(width, height);
        Choose(view, (shownWidth, shownHeight), view.ShownAspect(width, height), LinesPass.BoundsWith(Bounds, settings), settings);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _detail?.Dispose();
        foreach (var buffers in _models.Values)
        {
            buffers.Dispose();
        }

        foreach (var block in _blocks)
        {
            block.Dispose();
        }

        _balls?.Dispose();
        _textures.Dispose();
        _lights.Dispose();
        _pass.Dispose();
    }

    /// <summary>Draws into the bound framebuffer's viewport.</summary>
    internal void Draw(View view, (int Width, int Height) size, double aspect, BoundingBox bounds, RenderSettings settings, View? next)
    {
        _before = (Uploads, StateChanges);
        Choose(view, size, aspect, bounds, settings);
        if (next is not null && _adapted.Of(settings) is { } ahead)
        {
            Detail.Prepare(SceneDetail.ViewOf(next, size.Width, size.Height, aspect, next.ClipPlanes(bounds)), ahead, next.Zoom);
        }

        _pass.Begin(view, aspect, bounds, settings.Wireframe, settings.Shading);
        _lights.Bind(MeshPass.LightBinding, view.Camera.Position, view.Zoom is { } zoom ? Math.Exp(Math.Min(-zoom.LogUnit, DeepestLight)) : 1);
        _oneSided = 0;
        for (var i = 0; i < _blocks.Length; i++)
        {
            if (Scene.Objects[i].IsMoving && settings.Detail is { SkipsOutside: true } && !view.MaySee(_boxes[i], aspect))
            {
                continue;
            }

            var hidden = settings.Wireframe || !settings.SkipsBacks ? null : HiddenSide(i, view, bounds);
            _oneSided += hidden is null ? 0 : 1;
            _pass.LeaveOut(hidden);
            BindBlock(i, view);
            if (settings.Wireframe)
            {
                _pass.Use(null, Colour.White, FeaturesOf(i, null));
                DrawInstances(i, _models[Scene.Objects[i].Model].Everything);
            }
            else
            {
                DrawBatches(i, areTransparent: false, FeaturesOf(i, hidden));
            }
        }

        if (Balls.Count > 0 && view.Zoom is null)
        {
            _pass.LeaveOut(null);
            _pass.Use(null, Colour.White, MeshFeatures.InWorld);
            (_balls ??= new(Context.Resources)).Draw(Balls, view.Camera.Position, ObjectPalette.ColourOf(BallColour));
        }

        if (!settings.Wireframe)
        {
            DrawTransparent(view);
        }

        _pass.End();
        _after = (Uploads, StateChanges);
    }

    /// <summary>Moves to the GPU what is not there yet.</summary>
    private void Upload()
    {
        _transparent = new([.. Enumerable.Range(0, Scene.Objects.Length).Where(i => Scene.Objects[i].Model.HasTransparentParts)]);
        _textures.Upload(Context.Resources, Scene.Textures);
        foreach (var model in Scene.Models.Where(model => !_models.ContainsKey(model)))
        {
            _models.Add(model, new(Context.Resources, model));
        }

        _detail = new(Context.Resources, Scene, _models);
    }

    private void Choose(View view, (int Width, int Height) size, double aspect, BoundingBox bounds, RenderSettings settings)
    {
        if (_adapted.Of(settings) is { } detail)
        {
            Detail.Update(SceneDetail.ViewOf(view, size.Width, size.Height, aspect, view.ClipPlanes(bounds)), detail, view.Zoom);
        }
    }

    private void BindBlock(int index, View view)
    {
        var (item, map) = (Scene.Objects[index], _maps[index]);
        // Chosen instances are in world axes about the camera already.
        var shifted = Detail.Has(index) ? AffineMap.Translate(view.Camera.Position) : new AffineMap(map.Linear, map * item.Model.Origin);
        _blocks[index].Bind(MeshPass.ObjectBinding, shifted, item.Colour, item.Gradient?.To ?? item.Colour, view.Camera.Position);
    }

    private MeshFeatures FeaturesOf(int index, bool? hiddenSide) =>
        (Detail.Has(index) ? MeshFeatures.InWorld : MeshFeatures.None) | (hiddenSide == false ? MeshFeatures.FrontOnly : MeshFeatures.None);

    private void DrawInstances(int index, DrawableBatch batch)
    {
        if (Detail.Has(index))
        {
            Detail.Draw(index, batch);
        }
        else
        {
            _models[Scene.Objects[index].Model].Draw(batch);
        }
    }

    /// <summary>Draws those materials of an object that are opaque, or those that are not.</summary>
    private void DrawBatches(int index, bool areTransparent, MeshFeatures instances)
    {
        var item = Scene.Objects[index];
        foreach (ref readonly var batch in item.Model.Batches.AsSpan())
        {
            if (batch.IsTransparent == areTransparent)
            {
                _textures.Bind(batch.Material);
                _pass.Use(batch.Material, item.Tint, instances);
                DrawInstances(index, batch);
            }
        }
    }

    /// <summary>
    /// Draws what is transparent, the farthest object first, and of each object first the sides that look away: then the colours of a convex
    /// one mix in the right order. Triangles of one side and instances of a fractal are not sorted.
    /// </summary>
    private void DrawTransparent(View view)
    {
        MeshPass.BeginTransparent();
        foreach (var index in _transparent.FarToNear(view.Camera, _boxes))
        {
            BindBlock(index, view);
            var looksAway = _maps[index].Linear.Determinant() >= 0;
            _pass.LeaveOut(looksAway);
            DrawBatches(index, areTransparent: true, FeaturesOf(index, null));
            _pass.LeaveOut(!looksAway);
            DrawBatches(index, areTransparent: true, FeaturesOf(index, null));
        }

        MeshPass.EndTransparent();
    }

    /// <summary>The side of an object's triangles that certainly is not seen: true for the front, null where both may be.</summary>
    private bool? HiddenSide(int index, View view, BoundingBox bounds)
    {
        var mirror = Math.Sign(_maps[index].Linear.Determinant());
        if (Detail.Has(index))
        {
            var chosen = Detail.SolidSign(index) * mirror;
            return chosen == 0 ? null : chosen < 0;
        }

        var sign = Scene.Objects[index].Model.SolidSign * mirror;
        return sign != 0 && view.IsBeyondNearPlane(_boxes[index], bounds) ? sign < 0 : null;
    }
}
