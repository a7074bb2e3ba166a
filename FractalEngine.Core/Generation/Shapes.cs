using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>Closed meshes of simple solids, and a square: bases for fractals, obstacles and tests.</summary>
/// <remarks>
/// All faces of a solid are front faces from outside: <c>Cross(b − a, c − a)</c> points outwards. In the engine's left-handed world their
/// vertices then appear in clockwise order. Every call makes a new mesh; keep it to share it.
/// </remarks>
public static class Shapes
{
    private const int MaxSphereSubdivisions = 9;

    /// <summary>Makes the unit cube around the origin: 8 vertices, 12 faces.</summary>
    public static Mesh Cube() => Box(new(new(-0.5, -0.5, -0.5), new(0.5, 0.5, 0.5)));

    /// <summary>Makes a cuboid along the axes: 8 vertices, 12 faces.</summary>
    /// <param name="box">Its corners, scene units; not empty.</param>
    /// <exception cref="ArgumentException">The box is empty or not finite.</exception>
    public static Mesh Box(BoundingBox box)
    {
        ArgumentCheck.Require(
            !box.IsEmpty && box.Minimum.IsFinite() && box.Maximum.IsFinite(), "expected a finite box that is not empty", nameof(box));
        var (x1, y1, z1) = box.Minimum;
        var (x2, y2, z2) = box.Maximum;
        return new(
            [x1, y1, z1, x1, y1, z2, x1, y2, z1, x1, y2, z2, x2, y1, z1, x2, y1, z2, x2, y2, z1, x2, y2, z2],
            [4, 6, 7, 4, 7, 5, 1, 3, 2, 1, 2, 0, 2, 3, 7, 2, 7, 6, 1, 0, 4, 1, 4, 5, 5, 7, 3, 5, 3, 1, 0, 2, 6, 0, 6, 4]);
    }

    /// <summary>
    /// Makes a regular tetrahedron around the origin with vertices on the unit sphere, at corners of a cube: 4 vertices, 4 faces, wound
    /// outwards.
    /// </summary>
    /// <remarks>The vertices are (1, 1, 1), (1, −1, −1), (−1, 1, −1) and (−1, −1, 1), each divided by √3.</remarks>
    public static Mesh Tetrahedron()
    {
        var a = Math.Sqrt(1 / 3.0);
        return new([a, a, a, a, -a, -a, -a, a, -a, -a, -a, a], [0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2]);
    }

    /// <summary>Makes a regular octahedron around the origin with vertices at distance 1 on the axes: 6 vertices, 8 faces.</summary>
    public static Mesh Octahedron() => new(
        [1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1],
        [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5]);

    /// <summary>Makes a unit sphere around the origin: an icosahedron whose faces are divided into four.</summary>
    /// <param name="subdivisions">From 0 (20 faces) to 9 (5 million faces); each one makes four times as many.</param>
    public static Mesh Sphere(int subdivisions = 3)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(subdivisions);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(subdivisions, MaxSphereSubdivisions);
        return RoundShapes.Icosphere(20 << (2 * subdivisions));
    }

    /// <summary>Makes a square on the plane y = 0 around the origin, its front upwards: 4 vertices, 2 faces.</summary>
    /// <param name="size">The length of its sides, scene units, positive.</param>
    public static Mesh Square(double size = 1)
    {
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(size);
        var half = 0.5 * size;
        return new([-half, 0, -half, -half, 0, half, half, 0, half, half, 0, -half], [0, 1, 2, 0, 2, 3]);
    }
}
