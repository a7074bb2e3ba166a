using System.Numerics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.App.Window.Drawing;

/// <summary>Tells how many faces a scene shows.</summary>
internal static class FaceCountText
{
    // So many are counted in no time.
    private const long MaxCountedInstances = 20_000;

    // From here on the number of chains says little about what is seen, since many of them may coincide.
    private static readonly BigInteger LargeCount = 1_000_000_000;

    /// <summary>Returns the number of faces with its unit. Of a fractal whose instances coincide, different ones are counted.</summary>
    public static string Of(LoadedScene scene)
    {
        var faces = scene.Sum(CountFaces);
        return faces == BigInteger.One ? "1 face" : $"{DecimalText.FormatApproximately(faces)} faces";
    }

    private static BigInteger? CountFaces(Model model) =>
        model is FractalModel { Fractal: var fractal } && fractal.InstanceCount > LargeCount
            ? (DistinctInstances.Count(fractal, MaxCountedInstances) ?? fractal.InstanceCount) * fractal.BaseMesh.FaceCount
            : model.FaceCount;
}
