using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Drawables;

/// <summary>Writes affine maps as instances for the GPU: the three rows of a 3×4 matrix in single precision.</summary>
internal static class InstanceRow
{
    /// <summary>Writes the row of one instance.</summary>
    /// <param name="linear">Linear part of the map, by columns.</param>
    /// <param name="translation">Translation of the map.</param>
    /// <param name="target">Receives the rows in its first <see cref="DrawableModel.FloatsPerInstance"/> floats.</param>
    public static void Write(Matrix linear, Vector translation, Span<float> target)
    {
        var (v1, v2, v3) = linear;
        (target[0], target[1], target[2], target[3]) = ((float)v1.X, (float)v2.X, (float)v3.X, (float)translation.X);
        (target[4], target[5], target[6], target[7]) = ((float)v1.Y, (float)v2.Y, (float)v3.Y, (float)translation.Y);
        (target[8], target[9], target[10], target[11]) = ((float)v1.Z, (float)v2.Z, (float)v3.Z, (float)translation.Z);
    }
}
