using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>A box of any orientation, perhaps sheared, around a part of a body's surface.</summary>
internal readonly struct SurfaceBox
{
    // Relative to the longest: a shorter half axis gives no direction.
    private const double MinAxis = 1e-9;

    /// <summary>Makes the image of a box under a map.</summary>
    /// <param name="box">In the frame of a part of a shape.</param>
    /// <param name="map">From there to the frame of the body.</param>
    /// <param name="rounding">How far the surface is from what the box holds.</param>
    public SurfaceBox(BoundingBox box, in AffineMap map, double rounding)
    {
        Centre = map * box.Centre;
        var half = 0.5 * box.Size;
        HalfAxes = new(half.X * map.Linear.V1, half.Y * map.Linear.V2, half.Z * map.Linear.V3);
        Rounding = rounding;
        // The longest diagonal, whichever the box is sheared to.
        var (h1, h2, h3) = (HalfAxes.V1, HalfAxes.V2, HalfAxes.V3);
        var diagonal = Math.Max(
            Math.Max((h1 + h2 + h3).LengthSquared(), (h1 + h2 - h3).LengthSquared()),
            Math.Max((h1 - h2 + h3).LengthSquared(), (h1 - h2 - h3).LengthSquared()));
        Radius = Math.Sqrt(diagonal) + rounding;
        Normals = new(FaceNormal(h1, h2, h3), FaceNormal(h2, h3, h1), FaceNormal(h3, h1, h2));
    }

    private SurfaceBox(in SurfaceBox local, in SurfaceMotion placement)
    {
        Centre = placement.Map * local.Centre;
        HalfAxes = placement.Map.Linear * local.HalfAxes;
        Normals = placement.Rotation * local.Normals;
        Rounding = placement.Scale * local.Rounding;
        Radius = placement.Scale * local.Radius;
    }

    /// <summary>The middle of the box.</summary>
    public Vector Centre { get; }

    /// <summary>Vectors from the middle to three faces that meet.</summary>
    public Matrix HalfAxes { get; }

    /// <summary>Unit normals of these faces; zero where the box has none.</summary>
    public Matrix Normals { get; }

    /// <summary>How far the surface may reach beyond the box.</summary>
    public double Rounding { get; }

    /// <summary>Radius of a ball about the middle that holds all of it, scene units.</summary>
    public double Radius { get; }

    /// <summary>The box where a placement has it.</summary>
    public SurfaceBox Place(in SurfaceMotion placement) => new(in this, in placement);

    /// <summary>How far the surface reaches from the middle along a unit vector.</summary>
    public double Extent(Vector axis) => Spread(axis) + Rounding;

    /// <summary>The largest product of a vector with those from the middle to the corners.</summary>
    public double Spread(Vector vector) => Math.Abs(Vector.Dot(vector, HalfAxes.V1)) + Math.Abs(Vector.Dot(vector, HalfAxes.V2))
        + Math.Abs(Vector.Dot(vector, HalfAxes.V3));

    /// <summary>The corner that is farthest from a point, where the half axes are at right angles.</summary>
    public Vector FarthestCorner(Vector point)
    {
        var offset = Centre - point;
        return Centre + Outwards(HalfAxes.V1, offset) + Outwards(HalfAxes.V2, offset) + Outwards(HalfAxes.V3, offset);
    }

    private static Vector Outwards(Vector half, Vector offset) => Vector.Dot(half, offset) < 0 ? -half : half;

    private static Vector FaceNormal(Vector half, Vector side1, Vector side2)
    {
        var longest = Math.Max(half.Length(), Math.Max(side1.Length(), side2.Length()));
        var along = half.Length() > MinAxis * longest ? half.UnitVector() : Vector.Zero;
        var across = Vector.Cross(side1, side2);
        var normal = across.Length() > MinAxis * MinAxis * longest * longest ? across.UnitVector() : Vector.Zero;
        // A flat box still has the normal of its plane, and a needle its direction.
        return normal == Vector.Zero ? along : normal;
    }
}
