using System.Numerics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.App.Window.Drawing;

/// <summary>Tells how many faces a scene shows, those of distinct instances.</summary>
internal static class FaceCountText
{
    /// <summary>Returns the number of faces with its unit.</summary>
    public static string Of(LoadedScene scene)
    {
        var faces = scene.Sum(static model => model.DistinctFaceCount);
        return faces == BigInteger.One ? "1 face" : $"{DecimalText.FormatApproximately(faces)} faces";
    }
}
