using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Rays;

/// <summary>
/// The directions of the planes that bound the children of a sub-fractal better than boxes: those of its hull, where the children are
/// scaled copies with the same.
/// </summary>
/// <param name="normals">Unit vectors, no more than lanes.</param>
internal sealed class RayNormals(Vector[] normals)
{
    // Tests of eight children and one plane; more cost more than the planes of each child that a ray visits. No more planes than lanes.
    private const int MaxTests = RayBounds.LaneCount;

    // The squared distance up to which two normals differ by rounding alone.
    private const double MaxDistanceSquared = 1e-20;

    /// <summary>Number of directions; 0 where planes are of no use.</summary>
    public int Count => normals.Length;

    /// <summary>First coordinates of all directions; 0 in lanes that are left over.</summary>
    public Vector256<float> X { get; } = CreateLanes(normals, static normal => normal.X);

    /// <summary>Second coordinates of all directions.</summary>
    public Vector256<float> Y { get; } = CreateLanes(normals, static normal => normal.Y);

    /// <summary>Third coordinates of all directions.</summary>
    public Vector256<float> Z { get; } = CreateLanes(normals, static normal => normal.Z);

    /// <summary>A direction as a unit vector.</summary>
    public Vector this[int index] => normals[index];

    /// <summary>Finds the directions for the children of a sub-fractal; none where they are of no use.</summary>
    /// <param name="subFractal">The sub-fractal.</param>
    /// <param name="children">Its children, or descendants.</param>
    public static RayNormals Of(SubFractal subFractal, RayDescendant[] children)
    {
        var planes = subFractal.Hull?.Planes ?? [];
        var vectorCount = Math.Max(1, (children.Length + RayBounds.LaneCount - 1) / RayBounds.LaneCount);
        var shared = new RayNormals(planes.Count * vectorCount <= MaxTests ? [.. planes.Select(plane => plane.Normal)] : []);
        return children.All(shared.Contain) ? shared : new([]);
    }

    /// <summary>Tells whether the planes of a child's hull have these directions.</summary>
    public bool Contain(RayDescendant child) =>
        child.Target.Hull is { } hull && IsScaling(child.Map.Linear) && hull.Planes.All(plane => Contain(plane.Normal));

    private static bool IsScaling(Matrix m) => m.V1.X > 0 && m == Matrix.Diagonal(m.V1.X * Vector.One);

    private bool Contain(Vector normal) => Array.Exists(normals, other => (other - normal).LengthSquared() < MaxDistanceSquared);

    private static Vector256<float> CreateLanes(Vector[] normals, Func<Vector, double> coordinate)
    {
        var lanes = Vector256<float>.Zero;
        for (var i = 0; i < normals.Length; i++)
        {
            lanes = lanes.WithElement(i, (float)coordinate(normals[i]));
        }

        return lanes;
    }
}
