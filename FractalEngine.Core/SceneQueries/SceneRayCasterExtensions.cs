using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.SceneQueries;

/// <summary>Makes casters of rays at scenes as those at meshes and fractals are made.</summary>
public static class SceneRayCasterExtensions
{
    extension(RayCaster)
    {
        /// <inheritdoc cref="SceneRayCaster(Scene)"/>
        public static SceneRayCaster For(Scene scene) => new(scene);

        /// <inheritdoc cref="SceneRayCaster(LoadedScene)"/>
        public static SceneRayCaster For(LoadedScene scene) => new(scene);
    }
}
