using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>The sky around a scene: what is seen behind everything, and light from all directions.</summary>
public abstract record Sky
{
    /// <summary>The mean radiance just above the horizon, linear light: red, green, blue.</summary>
    public abstract Vector HorizonRadiance { get; }

    /// <summary>The words and numbers that declare the sky in a scene file, in their order.</summary>
    public abstract IReadOnlyList<object> Declaration { get; }

    /// <summary>The sky as a function of directions, for many of them.</summary>
    /// <param name="handedness">How the scene is shown: an image appears as it is in both.</param>
    public abstract SkyRadiance ToRadiance(Handedness handedness);
}
