using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>Something that a body's centre must keep a distance from.</summary>
/// <param name="Point">The nearest point of a surface, or the centre of another body. World space.</param>
/// <param name="CombinedRadius">The least distance allowed: the radius, or the sum of both radii.</param>
/// <param name="SphereOffset">From the body's position to that of its spheres which touches.</param>
/// <param name="BodyIndex">The number of the other body, −1 for a surface.</param>
/// <param name="IsFlat">True inside of a face: near the point the surface is a plane.</param>
internal readonly record struct Contact(Vector Point, double CombinedRadius, Vector SphereOffset, int BodyIndex, bool IsFlat)
{
    /// <summary>The normal when it was touched.</summary>
    public Vector CachedNormal { get; init; }

    /// <summary>From the point to the touching sphere's centre.</summary>
    public Vector PointToCentre(Vector position) => position + SphereOffset - Point;

    /// <summary>The free distance: 0 when it touches, negative when it overlaps.</summary>
    public double Gap(Vector position) => PointToCentre(position).Length() - CombinedRadius;

    /// <summary>Away from the obstacle, of length 1; zero where the centre is on it.</summary>
    public Vector Normal(Vector position) => PointToCentre(position).UnitVectorOrZero();
}
