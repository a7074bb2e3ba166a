using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>Loads the fractals that come with the program.</summary>
internal static class AssetFractals
{
    /// <summary>Where they are.</summary>
    public static readonly string Folder = Repository.Full("assets/fractals");

    /// <summary>Loads a fractal with the depth that its file states.</summary>
    /// <param name="name">Name of the file without its extension.</param>
    public static Fractal Load(string name) =>
        ((FractalModel)AssetLoader.Load(Path.Combine(Folder, name + ".fdo")).Scene.Objects[0].Model).Fractal;

    /// <summary>Loads a fractal with another depth of its outermost recursion.</summary>
    /// <param name="name">Name of the file without its extension.</param>
    /// <param name="depth">The depth; null for the infinite fractal.</param>
    public static Fractal Load(string name, int? depth)
    {
        var fractal = Load(name);
        var recursion = fractal.Description.Steps.OfType<Repetition>().First();
        var steps = fractal.Description.Steps.Replace(recursion, recursion.WithCount(depth));
        return new(fractal.Description with { Steps = steps }, fractal.BaseMesh);
    }
}
