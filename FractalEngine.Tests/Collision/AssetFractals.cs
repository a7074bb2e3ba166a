using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;

namespace FractalEngine.Tests.Collision;

/// <summary>The fractals that come with the program.</summary>
internal static class AssetFractals
{
    /// <summary>Where they are.</summary>
    public static readonly string Folder = Find();

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
