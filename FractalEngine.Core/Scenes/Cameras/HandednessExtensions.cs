using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Cameras;

/// <summary>Maps directions between a scene and the left-handed space in which the rotation of every camera is given.</summary>
public static class HandednessExtensions
{
    /// <summary>Mirrors a direction in z if the scene is right-handed. The same mirror leads back.</summary>
    public static Vector Mirror(this Handedness handedness, Vector direction) =>
        handedness == Handedness.Right ? direction with { Z = -direction.Z } : direction;
}
