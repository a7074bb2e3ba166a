using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Lights;

/// <summary>Some faces that shine from both sides: their power, a ball and a box around them, and a cone of their normals.</summary>
/// <param name="Power">Sum over the faces of area times radiance, in units of the frame; or their number.</param>
/// <param name="Centre">Centre of the ball and of the box.</param>
/// <param name="HalfSize">Half the size of the box.</param>
/// <param name="Radius">Radius of the ball.</param>
/// <param name="Axis">Unit vector in the middle of the cone. Normals have no sign, since both sides shine.</param>
/// <param name="Cosine">Cosine of the largest angle between the axis and a normal: 1 where all are parallel, 0 for any normals.</param>
internal readonly record struct AreaLightBounds(
    double Power, Vector Centre, Vector HalfSize, double Radius, Vector Axis, double Cosine)
{
    // Normals that differ by a millionth of a radian are parallel.
    private const double ParallelCosine = 1 - 1e-12;

    /// <summary>Bounds one triangle of a mesh.</summary>
    /// <param name="radiance">What it sends in each direction; null where its power is 1 whatever its size.</param>
    /// <param name="triangle">The corners.</param>
    public static AreaLightBounds Of((Vector A, Vector B, Vector C) triangle, double? radiance)
    {
        var (a, b, c) = triangle;
        var cross = Vector.Cross(b - a, c - a);
        var length = cross.Length();
        var centre = (a + b + c) / 3;
        var halfSize = Vector.Max((a - centre).Absolute(), Vector.Max((b - centre).Absolute(), (c - centre).Absolute()));
        var radius = Math.Max((a - centre).Length(), Math.Max((b - centre).Length(), (c - centre).Length()));
        return new(length > 0 ? 0.5 * length * radiance ?? 1 : 0, centre, halfSize, radius, cross / length, 1);
    }

    /// <summary>Bounds several groups of faces as one.</summary>
    public static AreaLightBounds Union(ReadOnlySpan<AreaLightBounds> parts)
    {
        var (box, power, axis) = (BoundingBox.Empty, 0.0, Vector.Zero);
        foreach (ref readonly var part in parts)
        {
            box = BoundingBox.Union(box, part.Box);
            power += part.Power;
            axis += (Vector.Dot(axis, part.Axis) < 0 ? -part.Power : part.Power) * part.Axis;
        }

        axis = axis.UnitVector();
        var (radius, angle) = (0.0, 0.0);
        foreach (ref readonly var part in parts)
        {
            radius = Math.Max(radius, (part.Centre - box.Centre).Length() + part.Radius);
            var between = Math.Min(1, Math.Abs(Vector.Dot(axis, part.Axis)));
            angle = Math.Max(angle, (between > ParallelCosine ? 0 : Math.Acos(between)) + Math.Acos(part.Cosine));
        }

        return new(
            power, box.Centre, 0.5 * box.Size, Math.Min(radius, 0.5 * box.Diagonal), axis,
            Math.Max(0, Math.Cos(Math.Min(angle, 0.5 * Math.PI))));
    }

    /// <summary>The box around the faces.</summary>
    public BoundingBox Box => new(Centre - HalfSize, Centre + HalfSize);

    /// <summary>
    /// Bounds the image under a map. The power is exact under similarities, and where all normals are parallel; otherwise it is that of
    /// normals in all directions.
    /// </summary>
    /// <param name="map">The map.</param>
    /// <param name="norm">Upper bound of the factor by which it lengthens vectors.</param>
    /// <param name="keepsPower">True where the power is a number of faces.</param>
    public AreaLightBounds Transform(in AffineMap map, double norm, bool keepsPower)
    {
        var cofactors = map.Linear.Cofactors();
        var axis = cofactors * Axis;
        var factor = keepsPower ? 1 : Cosine == 1 ? axis.Length() : AreaFactor(in cofactors);
        return new(
            factor * Power, map * Centre, Vector.Min(map.Linear.Absolute() * HalfSize, norm * Radius * Vector.One), norm * Radius,
            axis.UnitVector(), Cosine == 1 || map.Linear.IsChainableSimilarity() ? Cosine : 0);
    }

    /// <summary>Bounds the same faces, which are known to lie in another box too.</summary>
    public AreaLightBounds Within(BoundingBox other)
    {
        var box = BoundingBox.Intersection(Box, other);
        return box.IsEmpty ? this : this with
        {
            Centre = box.Centre,
            HalfSize = 0.5 * box.Size,
            Radius = Math.Min(0.5 * box.Diagonal, Radius + (box.Centre - Centre).Length()),
        };
    }

    /// <summary>The factor by which a map enlarges areas: exact for similarities, else the root mean square over all normals.</summary>
    /// <param name="cofactors">Of the linear part.</param>
    public static double AreaFactor(in Matrix cofactors) => Math.Sqrt(
        (cofactors.V1.LengthSquared() + cofactors.V2.LengthSquared() + cofactors.V3.LengthSquared()) / 3);
}
