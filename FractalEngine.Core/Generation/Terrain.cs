using FractalEngine.Core.Generation.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>Generates mountains and valleys: a height field of several octaves of gradient noise, 10 by 10 units.</summary>
/// <remarks>The mesh has a border, and no faces below.</remarks>
internal static class Terrain
{
    private const double Size = 10;
    private const int Octaves = 7;

    /// <summary>Generates a terrain with an exact number of faces.</summary>
    /// <param name="seed">Seed of the shape.</param>
    /// <param name="faceCount">Number of faces, at least 2; twice a square number gives an even grid.</param>
    public static Mesh Create(ulong seed, int faceCount)
    {
        var noise = new GradientNoise(new SplitMix64(seed).Next());
        var cells = (int)Math.Sqrt(faceCount / 2.0);
        var corners = new MeshCorner[cells + 1, cells + 1];
        var mesh = new MeshBuilder { SmoothingGroup = 1 };
        mesh.AddCorners(corners, GridClosure.Open, PositionAt, (row, column) => ((double)row / cells, (double)column / cells));
        mesh.AddGrid(corners);
        EdgeSplitting.SplitTo(mesh, faceCount);
        return mesh.Build();

        Vector PositionAt(int row, int column)
        {
            var x = Size * (((double)row / cells) - 0.5);
            var z = Size * (((double)column / cells) - 0.5);
            return new(x, Height(noise, x, z), z);
        }
    }

    private static double Height(GradientNoise noise, double x, double z)
    {
        // Low land is smooth, as rivers leave it, and high land has ridges. Noise displaces the sample positions, which bends both.
        var bend = 0.35 * noise.Octaves(new(0.3 * x, 11.5, 0.3 * z), 2);
        var samplePosition = new Vector(0.32 * x, 0.5 + bend, 0.32 * z);
        var height = Math.Clamp(0.5 + (0.6 * noise.Octaves(samplePosition, 3)), 0, 1.4);
        var ridges = noise.Ridges(new((0.45 * x) + bend, 7.5, (0.45 * z) - bend), Octaves);
        return (0.5 * height) + (0.85 * height * height * ridges) + (0.02 * noise.Octaves(new(3 * x, 3.5, 3 * z), 3));
    }
}
