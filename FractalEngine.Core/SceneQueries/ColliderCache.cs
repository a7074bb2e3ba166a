using System.Collections.Concurrent;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.SceneQueries;

/// <summary>
/// Keeps the colliders of models, so that worlds that are made one after the other share them: those that are built, and those that are
/// being built. For any number of threads.
/// </summary>
public sealed class ColliderCache
{
    private readonly ConcurrentDictionary<(object Shape, ColliderKind Kind), Lazy<Collider>> _colliders = new();

    /// <summary>Drops the colliders of all models but those of a scene.</summary>
    /// <param name="scene">The scene whose colliders are kept.</param>
    public void Retain(LoadedScene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var shapes = scene.Models.Select(ShapeOf).ToHashSet(ReferenceEqualityComparer.Instance);
        foreach (var key in _colliders.Keys.Where(key => !shapes.Contains(key.Shape)))
        {
            _colliders.TryRemove(key, out _);
        }
    }

    /// <summary>Returns the collider of a model.</summary>
    /// <param name="model">Models with the same mesh share a collider.</param>
    /// <param name="kind">Kind of the collider.</param>
    /// <param name="create">Builds the collider when it is first needed.</param>
    internal Lazy<Collider> GetOrAdd(Model model, ColliderKind kind, Func<Collider> create) =>
        _colliders.GetOrAdd((ShapeOf(model), kind), _ => new Lazy<Collider>(create));

    /// <summary>Returns what a collider is built from. A mesh stays the same object when only its materials change.</summary>
    private static object ShapeOf(Model model) => model is FractalModel { Fractal: var fractal } ? fractal : model.Mesh;
}
