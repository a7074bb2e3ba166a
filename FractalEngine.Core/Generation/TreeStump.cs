using FractalEngine.Core.Generation.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>
/// Generates a tree stump: bark with deep ridges, roots that run out over the ground, and a sawn top with growth rings and cracks.
/// </summary>
/// <remarks>
/// It replaces the paper's second model (§5.3), of which only the number of faces is known. The mesh has no faces below.
/// </remarks>
internal sealed class TreeStump
{
    /// <summary>Minimum number of faces that make a stump.</summary>
    public const int MinFaceCount = 300;

    private const double Radius = 0.62;
    private const double Height = 0.95;
    private const double ShareOfTop = 0.36;

    private readonly GradientNoise _noise;
    private readonly (double Angle, double Width, double Reach, double Bend)[] _roots;
    private readonly (double Angle, double Width, double Depth)[] _cracks;
    private readonly double _rings;
    private readonly Vector _tilt;

    private TreeStump(ulong seed)
    {
        var random = new SplitMix64(seed);
        _noise = new(random.Next());
        var roots = 6 + (int)(random.Next() % 3);
        _roots = [.. Enumerable.Range(0, roots).Select(root => (
            2 * Math.PI * (root + random.NextInRange(-0.3, 0.3)) / roots,
            random.NextInRange(0.17, 0.3), random.NextInRange(0.7, 1.7), random.NextInRange(-0.35, 0.35)))];
        _cracks = [.. Enumerable.Range(0, 7).Select(_ => (
            random.NextInRange(0, 2 * Math.PI), random.NextInRange(0.006, 0.016), random.NextInRange(0.02, 0.07)))];
        _rings = random.NextInRange(24, 34);
        _tilt = new(random.NextInRange(-0.06, 0.06), 0, random.NextInRange(-0.06, 0.06));
    }

    /// <summary>Generates a stump with an exact number of faces.</summary>
    /// <param name="seed">Seed of the roots, the bark and the cracks.</param>
    /// <param name="faceCount">Number of faces, at least <see cref="MinFaceCount"/>.</param>
    public static Mesh Create(ulong seed, int faceCount)
    {
        // A grid with about half as many columns again as rows, and a fan around the centre of the top.
        var rows = (int)Math.Sqrt(faceCount / 3.0);
        var columns = faceCount / ((2 * rows) - 1);
        var mesh = new MeshBuilder();
        new TreeStump(seed).AddTo(mesh, rows, columns);
        EdgeSplitting.SplitTo(mesh, faceCount);
        return mesh.Build();
    }

    private void AddTo(MeshBuilder mesh, int rows, int columns)
    {
        var topRows = (int)(ShareOfTop * rows);
        var barkRows = rows - topRows;
        var bark = new MeshCorner[barkRows, columns + 1];
        AddCorners(mesh, bark, row => Math.Pow((double)row / (barkRows - 1), 1.35), Bark);
        mesh.SmoothingGroup = 1;
        mesh.AddGrid(bark);

        // The top shares the rim's positions with the bark, but not its smoothing group.
        var top = new MeshCorner[topRows + 1, columns + 1];
        for (var column = 0; column <= columns; column++)
        {
            top[0, column] = bark[barkRows - 1, column];
        }

        AddCorners(mesh, top, row => 1 - ((double)row / (topRows + 1)), Top, firstRow: 1);
        mesh.SmoothingGroup = 2;
        mesh.AddGrid(top);
        var centre = new MeshCorner(mesh.AddPosition(Top(0, 0)), mesh.AddTextureCoordinate(0.5, 1));
        for (var column = 0; column < columns; column++)
        {
            mesh.AddTriangle(top[topRows, column], top[topRows, column + 1], centre);
        }
    }

    /// <summary>Adds the corners of a surface that is closed around the stump.</summary>
    /// <param name="mesh">Receives the vertices.</param>
    /// <param name="corners">Receives the corners, [rows, columns].</param>
    /// <param name="along">Computes the second coordinate of the surface from the row.</param>
    /// <param name="surface">Computes a position from an angle in radians and the second coordinate.</param>
    /// <param name="firstRow">First row to add.</param>
    private static void AddCorners(
        MeshBuilder mesh, MeshCorner[,] corners, Func<int, double> along, Func<double, double, Vector> surface, int firstRow = 0)
    {
        var columns = corners.GetLength(1) - 1;
        mesh.AddCorners(
            corners, GridClosure.Columns,
            (row, column) => surface(2 * Math.PI * ((double)column / columns), along(row)),
            (row, column) => ((double)column / columns, along(row)),
            firstRow);
    }

    /// <summary>Computes a point of the bark.</summary>
    /// <param name="angle">Angle around the trunk, radians.</param>
    /// <param name="along">Height, from the ground at 0 to the rim at 1.</param>
    private Vector Bark(double angle, double along)
    {
        var low = Math.Exp(-along * Height / 0.13);
        var twisted = angle + (0.1 * _noise.At(3 * along, 2 * Math.Cos(angle), 2 * Math.Sin(angle)));
        var reach = 0.0;
        foreach (var (rootAngle, width, rootReach, bend) in _roots)
        {
            var offset = Math.IEEERemainder(twisted - rootAngle - (bend * low), 2 * Math.PI) / width;
            reach += rootReach * Math.Exp(-offset * offset);
        }

        var (s, c) = Math.SinCos(angle);
        var shape = 1 + (0.22 * Math.Exp(-along * Height / 0.3)) + (reach * low) + (0.16 * reach * Math.Exp(-along * Height / 0.5))
            + (0.06 * _noise.Octaves(new(1.3 * c, 0.8 * along, 1.3 * s), 2));
        // Long furrows: the noise is stretched along the trunk, and bent a little.
        var bent = 0.25 * _noise.At(2 * c, 3 * along, 2 * s);
        var furrows = _noise.Ridges(new((5 * c) + bent, 1.1 * along, (5 * s) + bent), 3);
        var grain = _noise.Octaves(new(24 * c, 9 * along, 24 * s), 2);
        var radius = Radius * (shape + (0.075 * (furrows - 0.8)) + (0.008 * grain));
        return new(radius * s, (Height * along) + Rim(radius * s, radius * c, along) - (0.05 * low * reach), radius * c);
    }

    /// <summary>Computes a point of the sawn top.</summary>
    /// <param name="angle">Angle around the trunk, radians.</param>
    /// <param name="outwards">Distance from the centre at 0 to the rim at 1.</param>
    private Vector Top(double angle, double outwards)
    {
        var rim = Bark(angle, 1);
        var (x, z) = (outwards * rim.X, outwards * rim.Z);
        // The rings follow the outline of the stump, but not the furrows of its bark, and waver a little.
        var (s, c) = Math.SinCos(angle);
        var outline = Radius * (1.03 + (0.06 * _noise.Octaves(new(1.3 * c, 0.8, 1.3 * s), 2)));
        var wavering = (Math.Sqrt((x * x) + (z * z)) / outline) + (0.012 * _noise.Octaves(new(3 * x, 0.5, 3 * z), 2));
        var rings = 0.004 * Math.Sin(2 * Math.PI * _rings * wavering) * Math.Min(1, 8 * outwards);
        // A furrow separates bark from wood.
        var furrow = 0.03 * Math.Exp(-Math.Pow((outwards - 0.925) / 0.012, 2));
        var saw = 0.003 * _noise.At(40 * ((0.8 * x) + (0.6 * z)), 2, 3 * ((0.8 * z) - (0.6 * x)));
        var cracks = 0.0;
        foreach (var (crackAngle, width, depth) in _cracks)
        {
            var offset = outwards * Math.IEEERemainder(angle - crackAngle - (0.1 * _noise.At(4 * outwards, crackAngle, 0)), 2 * Math.PI);
            cracks += depth * Math.Exp(-Math.Pow(offset / (width * (0.4 + outwards)), 2)) * Math.Clamp(3 * (outwards - 0.15), 0, 1);
        }

        var inside = Math.Clamp((1 - outwards) * 60, 0, 1);
        return new(x, Height + Rim(x, z, 1) + (inside * (rings + saw - furrow - cracks)), z);
    }

    /// <summary>Computes how far a point of the top is raised, as the saw did not run level.</summary>
    private double Rim(double x, double z, double along) => along * along * ((_tilt.X * x) + (_tilt.Z * z));
}
