using System.Collections.Immutable;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.SkyBaking;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Preparation;

/// <summary>
/// Prepares the models of a scene: all at once, or each when one of its objects first comes into view. Until then a placeholder box is
/// shown, no normals are generated and no textures decoded. Each file is prepared once, however many objects show it.
/// </summary>
public sealed class ScenePreparation
{
    // Floats on the GPU, scene units: the square of a pixel's offset underflows below, and the far plane overflows beyond.
    private const double MinSize = 1e-18;
    private const double MaxSize = 8e37;

    private readonly LoadedScene _scene;
    private readonly RenderSettings _settings;
    private readonly ImmutableArray<string>.Builder _notices = ImmutableArray.CreateBuilder<string>();
    private readonly TextureCache _textures;
    private readonly Model[] _models;
    private readonly DrawableModel?[] _prepared;
    private readonly bool _hasAmbientLight;

    /// <summary>Creates the scene with placeholders for all models.</summary>
    /// <param name="scene">Scene with its files loaded.</param>
    /// <param name="settings">Settings with the budgets and the crease angle.</param>
    /// <param name="previous">
    /// A scene that was prepared with the same settings; null for none. Models that both scenes have are prepared already.
    /// </param>
    public ScenePreparation(LoadedScene scene, RenderSettings settings, DrawableScene? previous = null)
    {
        _scene = scene.ByParts();
        _settings = settings;
        _models = [.. _scene.Models];
        _hasAmbientLight = !SceneAmbient.Of(scene.Scene).IsDark;
        _textures = new(_notices, settings.ShareTextures, previous?.Textures ?? []);
        _prepared = new DrawableModel?[_models.Length];
        var lightCount = scene.Scene.Lights.Count(static light => light.ToEmitter() is not null);
        if (lightCount > LightBlock.MaxLights)
        {
            _notices.Add(FormattableString.Invariant(
                $"of {lightCount} lights besides ambient ones, only the first {LightBlock.MaxLights} shine"));
        }

        if (!scene.Bounds.IsEmpty && scene.Bounds.Diagonal is (> 0 and < MinSize) or > MaxSize)
        {
            _notices.Add(FormattableString.Invariant(
                $"the scene is {scene.Bounds.Diagonal:G3} units large, and drawn frames show {MinSize} to {MaxSize}: ")
                + "trace it, or scale it");
        }

        Scene = DrawableScene.CreateWithPlaceholders(scene, _scene, _notices.ToImmutable());
        if (previous is not null)
        {
            TakePrepared(previous);
        }
    }

    /// <summary>Scene as far as it is prepared.</summary>
    public DrawableScene Scene { get; private set; }

    /// <summary>Model that is being prepared on another thread; null for none.</summary>
    public Model? Current { get; private set; }

    /// <summary>True once all models are prepared.</summary>
    public bool IsComplete => Array.TrueForAll(_prepared, static model => model is not null);

    /// <summary>Prepares all models that are not prepared yet.</summary>
    /// <param name="progress">Receives a report before and after each model, on this thread; null for none.</param>
    /// <param name="cancellation">Cancels between two models.</param>
    /// <exception cref="OperationCanceledException">Preparation was cancelled.</exception>
    public void PrepareAll(IProgress<PreparationProgress>? progress, CancellationToken cancellation) =>
        Prepare(static _ => true, progress, cancellation);

    /// <summary>Prepares the models of visible objects that are not prepared yet.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="progress">Receives a report before and after each model, on this thread; null for none.</param>
    /// <param name="cancellation">Cancels between two models.</param>
    /// <returns>True when any model was prepared.</returns>
    /// <exception cref="OperationCanceledException">Preparation was cancelled.</exception>
    public bool PrepareVisible(
        View view, double aspect, IProgress<PreparationProgress>? progress = null, CancellationToken cancellation = default) =>
        Prepare(model => IsVisible(model, view, aspect), progress, cancellation);

    /// <summary>
    /// Whether <see cref="BakeSky"/> has anything to do: light comes from all around, and it is not known which parts of a fractal hide it
    /// from others.
    /// </summary>
    /// <param name="settings">Settings of the frame, which may have no use for it.</param>
    public bool HasUnbakedSky(RenderSettings settings) =>
        _hasAmbientLight && EffectiveCulling.HasSkyVisibility(settings) && Array.Exists(_prepared, NeedsBaking);

    /// <summary>
    /// Computes what the parts of each fractal that is prepared leave of each other's sky. The drawn scene uses it once it is updated.
    /// </summary>
    /// <param name="cancellation">Ends the work early.</param>
    /// <exception cref="OperationCanceledException">The work was cancelled.</exception>
    public void BakeSky(CancellationToken cancellation)
    {
        foreach (var model in _prepared.Where(NeedsBaking))
        {
            SkyMaskBaker.Bake(model!.LodHierarchy!, model.MeshWindingSign, cancellation);
        }
    }

    /// <summary>Returns true when the model of a visible object is not prepared yet.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    public bool HasUnpreparedVisibleModels(View view, double aspect) =>
        _models.Index().Any(model => _prepared[model.Index] is null && IsVisible(model.Item, view, aspect));

    private bool NeedsBaking(DrawableModel? model) =>
        model?.LodHierarchy is { IsSkyBaked: false } && !(_settings.BakeSkipping && model.HasOpenSky);

    private void TakePrepared(DrawableScene previous)
    {
        var prepared = previous.Parts.Models.Zip(previous.Models)
            .Where(static pair => !pair.Second.IsPlaceholder)
            .ToDictionary(static pair => pair.First, static pair => pair.Second);
        for (var i = 0; i < _models.Length; i++)
        {
            if (prepared.TryGetValue(_models[i], out var model))
            {
                _textures.Adopt(model);
                _prepared[i] = model;
                Scene = Scene.WithModel(Scene.Models[i], model, [.. _textures.Textures], _notices.ToImmutable());
            }
        }
    }

    private bool IsVisible(Model model, View view, double aspect) =>
        _scene.Objects.Any(placed => ReferenceEquals(placed.Model, model) && view.MayIntersectFrustum(placed.Bounds, aspect));

    private bool Prepare(Func<Model, bool> isSelected, IProgress<PreparationProgress>? progress, CancellationToken cancellation)
    {
        int[] selectedIndices = [.. Enumerable.Range(0, _models.Length).Where(i => _prepared[i] is null && isSelected(_models[i]))];
        for (var completed = 0; completed < selectedIndices.Length; completed++)
        {
            cancellation.ThrowIfCancellationRequested();
            var index = selectedIndices[completed];
            var name = _models[index].Name;
            Current = _models[index];
            try
            {
                progress?.Report(new(name, (double)completed / selectedIndices.Length));
                var prepared = ModelPreparation.Prepare(_models[index], _settings, _textures, _notices);
                _prepared[index] = prepared;
                Scene = Scene.WithModel(Scene.Models[index], prepared, [.. _textures.Textures], _notices.ToImmutable());
            }
            finally
            {
                Current = null;
            }

            progress?.Report(new(name, (completed + 1.0) / selectedIndices.Length));
        }

        return selectedIndices.Length > 0;
    }
}
