using FractalEngine.Core.Colliders;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.SceneQueries;

/// <summary>Makes colliders of scenes as those of meshes and fractals are made.</summary>
public static class SceneColliderExtensions
{
    extension(Collider)
    {
        /// <inheritdoc cref="SceneCollider(Scene, ColliderKind)"/>
        public static SceneCollider For(Scene scene, ColliderKind kind = ColliderKind.Exact) => new(scene, kind);

        /// <inheritdoc cref="SceneCollider(LoadedScene, ColliderKind)"/>
        public static SceneCollider For(LoadedScene scene, ColliderKind kind = ColliderKind.Exact) => new(scene, kind);
    }
}
