using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>Mountains and valleys: a height field of several octaves of gradient noise, 10 by 10 units. Open below.</summary>
internal static class Terrain
{
    private const double Size = 10;
    private const int Octaves = 7;

    /// <summary>A land of exactly so many faces.</summary>
    /// <param name="seed">Of the land's shape.</param>
    /// <param name="faceCount">At least 2; twice a square number gives an even grid.</param>
    public static Mesh Create(ulong seed, int faceCount)
    {
        var noise = new GradientNoise(new SplitMix64(seed).Next());
        var cells = (int)Math.Sqrt(faceCount / 2.0);
        var corners = new MeshCorner[cells + 1, cells + 1];
        var mesh = new MeshBuilder { SmoothingGroup = 1 };
        for (var row = 0; row <= cells; row++)
        {
            for (var column = 0; column <= cells; column++)
            {
                var (u, v) = ((double)row / cells, (double)column / cells);
                var (x, z) = (Size * (u - 0.5), Size * (v - 0.5));
                corners[row, column] = new(mesh.AddPosition(new(x, Height(noise, x, z), z)), mesh.AddTextureCoordinate(u, v));
            }
        }

        mesh.AddGrid(corners);
        EdgeSplitting.SplitTo(mesh, faceCount);
        return mesh.Build();
    }

    private static double Height(GradientNoise noise, double x, double z)
    {
        // Where the land is low it is smooth, as rivers leave it; ridges stand where it is high. The shift of the place by noise bends
        // both.
        var bend = 0.35 * noise.Octaves(new(0.3 * x, 11.5, 0.3 * z), 2);
        var samplePosition = new Vector(0.32 * x, 0.5 + bend, 0.32 * z);
        var height = Math.Clamp(0.5 + (0.6 * noise.Octaves(samplePosition, 3)), 0, 1.4);
        var ridges = noise.Ridges(new((0.45 * x) + bend, 7.5, (0.45 * z) - bend), Octaves);
        return (0.5 * height) + (0.85 * height * height * ridges) + (0.02 * noise.Octaves(new(3 * x, 3.5, 3 * z), 3));
    }
}
