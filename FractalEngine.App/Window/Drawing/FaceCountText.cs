using System.Numerics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.App.Window.Drawing;

/// <summary>Tells how many faces a scene shows, those of distinct instances.</summary>
internal static class FaceCountText
{
    /// <summary>Returns the number of faces with its unit.</summary>
    public static string Of(LoadedScene scene)
    {
        var faces = scene.Sum(static model => model is FractalModel { Fractal: var fractal }
            ? DistinctInstances.CountFacesAtMost(fractal) : model.FaceCount);
        return faces == BigInteger.One ? "1 face" : $"{DecimalText.FormatApproximately(faces)} faces";
    }
}
