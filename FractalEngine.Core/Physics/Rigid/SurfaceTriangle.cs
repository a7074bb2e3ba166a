using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// A triangle of a body's surface, widened by a radius: a ball is one whose corners are the same point, a capsule is a segment.
/// </summary>
internal readonly struct SurfaceTriangle
{
    /// <summary>Makes a triangle of its corners.</summary>
    /// <param name="corners">In the frame that is meant.</param>
    /// <param name="rounding">Radius in scene units; 0 for a triangle of a mesh.</param>
    public SurfaceTriangle(in (Vector A, Vector B, Vector C) corners, double rounding)
    {
        Corners = corners;
        Rounding = rounding;
        Centre = (corners.A + corners.B + corners.C) / 3;
        var farthest = Math.Max((corners.A - Centre).LengthSquared(), (corners.B - Centre).LengthSquared());
        Radius = Math.Sqrt(Math.Max(farthest, (corners.C - Centre).LengthSquared())) + rounding;
        Normal = Vector.Cross(corners.B - corners.A, corners.C - corners.A).UnitVectorOrZero();
    }

    private SurfaceTriangle(in SurfaceTriangle local, in SurfaceMotion placement)
    {
        var map = placement.Map;
        Corners = (map * local.Corners.A, map * local.Corners.B, map * local.Corners.C);
        Rounding = placement.Scale * local.Rounding;
        Centre = map * local.Centre;
        Radius = placement.Scale * local.Radius;
        Normal = placement.Rotation * local.Normal;
    }

    /// <summary>The corners of the triangle.</summary>
    public (Vector A, Vector B, Vector C) Corners { get; }

    /// <summary>How far the surface is from the triangle, scene units.</summary>
    public double Rounding { get; }

    /// <summary>Unit normal as the corners are wound; zero for a triangle without area.</summary>
    public Vector Normal { get; }

    /// <summary>The mean of the corners.</summary>
    public Vector Centre { get; }

    /// <summary>Radius of a ball about the centre that holds all of it, scene units.</summary>
    public double Radius { get; }

    /// <summary>The triangle where a placement has it.</summary>
    public SurfaceTriangle Place(in SurfaceMotion placement) => new(in this, in placement);

    /// <summary>How far the triangle reaches against an axis: the least product.</summary>
    public double LowestAlong(Vector axis) => Math.Min(
        Vector.Dot(axis, Corners.A), Math.Min(Vector.Dot(axis, Corners.B), Vector.Dot(axis, Corners.C))) - Rounding;
}
