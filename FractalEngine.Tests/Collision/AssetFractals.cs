using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;

namespace FractalEngine.Tests.Collision;

/// <summary>Loads the fractals that come with the program.</summary>
internal static class AssetFractals
{
    /// <summary>The folder of the fractal files.</summary>
    public static readonly string Folder = Find();

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

    private static string Find()
    {
        for (DirectoryInfo? folder = new(AppContext.BaseDirectory); folder is not null; folder = folder.Parent)
        {
            var fractals = Path.Combine(folder.FullName, "assets", "fractals");
            if (Directory.Exists(fractals))
            {
                return fractals;
            }
        }

        throw new DirectoryNotFoundException("expected the folder 'assets/fractals' above the tests");
    }
}
