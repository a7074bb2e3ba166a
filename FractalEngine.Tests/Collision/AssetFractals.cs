using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Collision;

/// <summary>The fractals that come with the program.</summary>
internal static class AssetFractals
{
    /// <summary>Where they are.</summary>
    public static readonly string Folder = Repository.Full("assets/fractals");

    /// <summary>As its file says.</summary>
    public static Fractal Load(string name) =>
        ((FractalModel)AssetLoader.Load(Path.Combine(Folder, name + ".fdo")).Scene.Objects[0].Model).Fractal;

    /// <summary>With another depth of its outermost recursion; null for the infinite fractal.</summary>
    public static Fractal Load(string name, int? depth)
    {
        var fractal = Load(name);
        var recursion = fractal.Description.Steps.OfType<Repetition>().First();
        return new(fractal.Description with { Steps = fractal.Description.Steps.Replace(recursion, recursion.WithCount(depth)) },
            fractal.BaseMesh);
    }
}
