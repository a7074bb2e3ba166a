using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Queries.Regions;

/// <summary>A triangle of a <see cref="ShapeExpansion"/>.</summary>
/// <param name="Face">Its index in the base mesh.</param>
/// <param name="A">The first corner.</param>
/// <param name="B">The second corner.</param>
/// <param name="C">The third corner.</param>
/// <param name="Reach">The largest absolute coordinate on the way to it, which rounding is measured against.</param>
internal readonly record struct ExpandedTriangle(int Face, Vector A, Vector B, Vector C, double Reach)
{
    public double Distance(Vector position) => Math.Sqrt(TriangleKernel.ClosestPoint(position, A, B, C).DistanceSquared);

    public BoundingBox Box() => new(Vector.Min(A, Vector.Min(B, C)), Vector.Max(A, Vector.Max(B, C)));

    public ExpandedTriangle Transform(AffineMap map) => this with { A = map * A, B = map * B, C = map * C };

    public bool IsNear(ExpandedTriangle other, double tolerance) => Face == other.Face && (A - other.A).MaxAbsComponent() <= tolerance
        && (B - other.B).MaxAbsComponent() <= tolerance && (C - other.C).MaxAbsComponent() <= tolerance;

    /// <summary>Tells whether something of the triangle is left when the sides of a box cut it.</summary>
    public bool Meets(BoundingBox box)
    {
        List<Vector> polygon = [A, B, C];
        foreach (var axis in new[] { Vector.I, Vector.J, Vector.K })
        {
            polygon = Clip(Clip(polygon, axis, Vector.Dot(axis, box.Maximum)), -axis, -Vector.Dot(axis, box.Minimum));
        }

        return polygon.Count > 0;
    }

    private static List<Vector> Clip(List<Vector> polygon, Vector normal, double offset)
    {
        var clipped = new List<Vector>();
        for (var i = 0; i < polygon.Count; i++)
        {
            var (from, to) = (polygon[i], polygon[(i + 1) % polygon.Count]);
            var (height1, height2) = (Vector.Dot(normal, from) - offset, Vector.Dot(normal, to) - offset);
            if (height1 <= 0)
            {
                clipped.Add(from);
            }

            if ((height1 < 0 && height2 > 0) || (height1 > 0 && height2 < 0))
            {
                clipped.Add(from + (height1 / (height1 - height2) * (to - from)));
            }
        }

        return clipped;
    }
}
