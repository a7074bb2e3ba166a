using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Sky;

/// <summary>
/// The six sides that a surface may face: towards +x, +y, +z, then −x, −y, −z. Each has a point of the base mesh that stands for it.
/// </summary>
internal sealed class AmbientCube
{
    /// <summary>Number of sides of a box.</summary>
    public const int Count = 6;

    // How far before the surface the points lie, by the size of the mesh: surfaces of siblings in the same plane stay behind.
    private const double Outside = 1e-3;

    private static readonly Vector256<double>[] Axes =
        [.. Enumerable.Range(0, Count).Select(static side => SimdAffineMap.ToVector256(NormalOf(side)))];

    private readonly Vector256<double>[] _points = new Vector256<double>[Count];

    /// <summary>Finds the middle of the surfaces of each side; that of the box's side where there are none.</summary>
    public AmbientCube(Mesh mesh)
    {
        if (mesh.FaceCount == 0)
        {
            return;
        }

        var box = mesh.Bounds;
        var sums = new (Vector Point, double Weight)[Count];
        for (var i = 0; i < mesh.FaceCount; i++)
        {
            var (a, b, c) = mesh.Face(i);
            var normal = Vector.Cross(b - a, c - a);
            var centre = (a + b + c) / 3;
            for (var side = 0; side < Count; side++)
            {
                // Normals of meshes that are wound inwards, or both ways, would count for the wrong side: then the far one is meant.
                var weight = Math.Max(0, Vector.Dot(NormalOf(side), normal));
                sums[side] = (sums[side].Point + (weight * centre), sums[side].Weight + weight);
            }
        }

        for (var side = 0; side < Count; side++)
        {
            var (sum, weight) = sums[side];
            var normal = NormalOf(side);
            var point = weight > 0 ? sum / weight : box.Centre + (0.5 * normal.Stretch(box.Size));
            _points[side] = SimdAffineMap.ToVector256(point + (Outside * box.Diagonal * normal));
        }
    }

    /// <summary>Returns the point that stands for a side: x, y, z, 0.</summary>
    public Vector256<double> this[int side] => _points[side];

    /// <summary>Returns the unit normal of a side.</summary>
    public static Vector NormalOf(int side) =>
        (side < 3 ? 1 : -1) * (side % 3 == 0 ? Vector.I : side % 3 == 1 ? Vector.J : Vector.K);

    /// <summary>Returns the unit normal of a side: x, y, z, 0.</summary>
    public static Vector256<double> AxisOf(int side) => Axes[side];

    /// <summary>Finds the side that a vector points to most.</summary>
    public static int Of(Vector256<double> normal)
    {
        var (x, y, z) = (normal[0], normal[1], normal[2]);
        var (sizeX, sizeY, sizeZ) = (Math.Abs(x), Math.Abs(y), Math.Abs(z));
        return sizeX >= sizeY && sizeX >= sizeZ ? (x >= 0 ? 0 : 3)
            : sizeX < sizeY && sizeY >= sizeZ ? (y >= 0 ? 1 : 4)
            : z >= 0 ? 2 : 5;
    }

    /// <summary>Computes what a surface sees from what the sides see, as the shader does.</summary>
    /// <param name="parts">Parts of the sides.</param>
    /// <param name="normal">Unit normal.</param>
    public static double Blend(ReadOnlySpan<float> parts, Vector normal)
    {
        var (x, y, z) = normal;
        return (x * x * parts[x >= 0 ? 0 : 3]) + (y * y * parts[y >= 0 ? 1 : 4]) + (z * z * parts[z >= 0 ? 2 : 5]);
    }
}
