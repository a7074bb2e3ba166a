using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Render.Upload;

/// <summary>The textures, meshes and visible instances of a scene on the GPU. Models and textures are uploaded once.</summary>
/// <param name="resources">Resources of the current context.</param>
internal sealed class SceneBuffers(GlResources resources) : IDisposable
{
    private readonly TextureSet _textures = new();
    private readonly Dictionary<DrawableModel, ModelBuffers> _models = [];
    private SceneCuller? _culler;
    private SceneCuller? _shadowCuller;
    private DrawableScene? _scene;

    /// <summary>Culls the instances of the scene and holds the visible ones.</summary>
    public SceneCuller Culler => _culler!;

    /// <summary>Culls the instances for the depth maps of lights, one map after the other. Made anew when models are uploaded.</summary>
    public SceneCuller ShadowCuller => _shadowCuller ??= new(resources, _scene!, _models, isLit: false);

    /// <summary>Uploads what is not on the GPU yet, and deletes the buffers of models that the scene no longer has.</summary>
    /// <exception cref="GlException">The driver refuses something, or the GPU's memory does not suffice: nothing has changed.</exception>
    public void Upload(DrawableScene scene)
    {
        SceneCuller culler;
        try
        {
            _textures.Add(resources, scene.Textures);
            foreach (var model in scene.Models.Where(model => !_models.ContainsKey(model)))
            {
                _models.Add(model, new(resources, model));
            }

            culler = new(resources, scene, _models, isLit: true);
        }
        catch (GlException)
        {
            KeepOnly(_scene);
            throw;
        }

        _culler?.Dispose();
        _culler = culler;
        _shadowCuller?.Dispose();
        _shadowCuller = null;
        _scene = scene;
        KeepOnly(scene);
    }

    /// <summary>Returns the buffers of a model of the scene.</summary>
    public ModelBuffers BuffersOf(DrawableModel model) => _models[model];

    /// <summary>Binds the texture of a material, if it has one.</summary>
    public void BindTexture(DrawableMaterial? material) => _textures.Bind(material);

    /// <summary>Deletes what a scene does not have; everything where there is no scene.</summary>
    private void KeepOnly(DrawableScene? scene)
    {
        foreach (var model in _models.Keys.Except(scene?.Models ?? []).ToArray())
        {
            _models[model].Dispose();
            _models.Remove(model);
        }

        _textures.KeepOnly(scene?.Textures ?? []);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll([_culler, _shadowCuller, .. _models.Values, _textures]);
}
