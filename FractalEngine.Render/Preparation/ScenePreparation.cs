using System.Collections.Immutable;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Preparation;

/// <summary>
/// Prepares the models of a scene: all at once, or each when one of its objects is first in sight. Until then a box stands for it, and
/// neither its normals are generated nor its pictures decoded, and nothing of it is on the GPU. Each file is prepared once, however many
/// objects show it.
/// </summary>
public sealed class ScenePreparation
{
    private readonly LoadedScene _scene;
    private readonly RenderSettings _settings;
    private readonly ImmutableArray<string>.Builder _notices = ImmutableArray.CreateBuilder<string>();
    private readonly TextureCache _textures;
    private readonly Model[] _models;
    private readonly DrawableModel?[] _prepared;

    /// <summary>With nothing prepared yet.</summary>
    /// <param name="scene">With its files loaded.</param>
    /// <param name="settings">Budgets and crease angle.</param>
    public ScenePreparation(LoadedScene scene, RenderSettings settings)
    {
        (_scene, _settings, _models) = (scene, settings, [.. scene.Models]);
        (_textures, _prepared, Scene) = (new(_notices, settings.ShareTextures), new DrawableModel?[_models.Length],
            DrawableScene.CreateWithPlaceholders(scene));
    }

    /// <summary>As far as it is prepared.</summary>
    public DrawableScene Scene { get; private set; }

    /// <summary>True when nothing is left to prepare.</summary>
    public bool IsComplete => Array.TrueForAll(_prepared, static model => model is not null);

    /// <summary>Prepares all models that are not yet.</summary>
    /// <param name="progress">Told of each model before and after it is prepared, on this thread.</param>
    /// <param name="cancellation">Looked at between models.</param>
    /// <exception cref="OperationCanceledException">Preparation was cancelled.</exception>
    public void PrepareAll(IProgress<PreparationProgress>? progress, CancellationToken cancellation) =>
        Prepare(static _ => true, progress, cancellation);

    /// <summary>Prepares the models of objects that are in sight and not prepared yet.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the picture.</param>
    /// <param name="progress">Told of each model before and after it is prepared, on this thread.</param>
    /// <param name="cancellation">Looked at between models.</param>
    /// <exception cref="OperationCanceledException">Preparation was cancelled.</exception>
    /// <returns>True when there was any.</returns>
    public bool PrepareVisible(View view, double aspect, IProgress<PreparationProgress>? progress = null,
        CancellationToken cancellation = default) =>
        Prepare(model => IsVisible(model, view, aspect), progress, cancellation);

    /// <summary>True when an object is in sight whose model is not prepared yet.</summary>
    public bool HasUnpreparedVisibleModels(View view, double aspect)
    {
        for (var i = 0; i < _models.Length; i++)
        {
            if (_prepared[i] is null && IsVisible(_models[i], view, aspect))
            {
                return true;
            }
        }

        return false;
    }

    private bool IsVisible(Model model, View view, double aspect)
    {
        foreach (var placed in _scene.Objects)
        {
            if (ReferenceEquals(placed.Model, model) && view.MayIntersectFrustum(placed.Bounds, aspect))
            {
                return true;
            }
        }

        return false;
    }

    private bool Prepare(Func<Model, bool> isSelected, IProgress<PreparationProgress>? progress, CancellationToken cancellation)
    {
        int[] selectedIndices = [.. Enumerable.Range(0, _models.Length).Where(i => _prepared[i] is null && isSelected(_models[i]))];
        for (var completed = 0; completed < selectedIndices.Length; completed++)
        {
            cancellation.ThrowIfCancellationRequested();
            var index = selectedIndices[completed];
            var name = _models[index].Name;
            progress?.Report(new(name, (double)completed / selectedIndices.Length));
            var placeholder = Scene.Models[index];
            var prepared = DrawableScene.PrepareModel(_models[index], _settings, _textures, _notices);
            (_prepared[index], Scene) = (prepared, Scene.WithModel(placeholder, prepared, [.. _textures.Textures], _notices.ToImmutable()));
            progress?.Report(new(name, (completed + 1.0) / selectedIndices.Length));
        }

        return selectedIndices.Length > 0;
    }
}
