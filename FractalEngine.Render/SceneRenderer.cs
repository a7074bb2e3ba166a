using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Passes;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Render;

/// <summary>
/// A prepared scene on the GPU. Uploaded once; each object is one instanced draw call, whether it shows a mesh or a fractal. Objects can
/// move: then only their own matrix is uploaded again.
/// </summary>
public sealed class SceneRenderer : IDisposable
{
    private readonly MeshPass _pass;
    private readonly LightBlock _lights;
    private readonly Dictionary<DrawableModel, ModelBuffers> _models = [];
    private readonly ObjectBlock[] _blocks;
    private readonly AffineMap[] _maps;
    private readonly BoundingBox[] _boxes;
    private BoundingBox? _bounds;

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
        try
        {
            foreach (var model in scene.Models)
            {
                _models.Add(model, new(context.Resources, model));
            }
        }
        catch
        {
            Dispose();
            throw;
        }
    }

    /// <summary>What is drawn.</summary>
    public DrawableScene Scene { get; }

    /// <summary>A box that holds all objects where they are now, world space.</summary>
    public BoundingBox Bounds => _bounds ??= _boxes.Aggregate(BoundingBox.Empty, BoundingBox.Union);

    internal RenderContext Context { get; }

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
            _bounds = null;
        }
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        foreach (var buffers in _models.Values)
        {
            buffers.Dispose();
        }

        foreach (var block in _blocks)
        {
            block.Dispose();
        }

        _lights.Dispose();
        _pass.Dispose();
    }

    /// <summary>Draws into the bound framebuffer's viewport.</summary>
    internal void Draw(View view, double aspect, BoundingBox bounds, bool wireframe)
    {
        _pass.Begin(view, aspect, bounds, wireframe);
        _lights.Bind(MeshPass.LightBinding, view.Camera.Position);
        for (var i = 0; i < _blocks.Length; i++)
        {
            var item = Scene.Objects[i];
            var map = _maps[i];
            var shifted = new AffineMap(map.Linear, map * item.Model.Origin);
            MeshPass.LeaveOut(wireframe ? null : HiddenSide(i, view, bounds));
            _blocks[i].Bind(MeshPass.ObjectBinding, shifted, item.Colour, view.Camera.Position);
            _models[item.Model].Draw();
        }

        MeshPass.End();
    }

    /// <summary>The side of an object's triangles that certainly is not seen: true for the front, null where both may be.</summary>
    private bool? HiddenSide(int index, View view, BoundingBox bounds)
    {
        var sign = Scene.Objects[index].Model.SolidSign * Math.Sign(_maps[index].Linear.Determinant());
        return sign != 0 && view.IsBeyondNearPlane(_boxes[index], bounds) ? sign < 0 : null;
    }
}
