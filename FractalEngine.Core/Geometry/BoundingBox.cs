using System.Globalization;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>An axis-aligned box, closed; <see cref="Empty"/> holds no point.</summary>
/// <param name="Minimum">The corner with the smallest coordinates.</param>
/// <param name="Maximum">The corner with the largest coordinates.</param>
public readonly record struct BoundingBox(Vector Minimum, Vector Maximum)
{
    /// <summary>The box of nothing: neutral for <see cref="Union"/>.</summary>
    public static BoundingBox Empty { get; } = new(
        new(double.PositiveInfinity, double.PositiveInfinity, double.PositiveInfinity),
        new(double.NegativeInfinity, double.NegativeInfinity, double.NegativeInfinity));

    /// <summary>True when the box holds no point.</summary>
    public bool IsEmpty => !(Minimum.X <= Maximum.X && Minimum.Y <= Maximum.Y && Minimum.Z <= Maximum.Z);

    /// <summary>The point in the middle; the origin for an empty box.</summary>
    public Vector Centre => IsEmpty ? Vector.Zero : (0.5 * Minimum) + (0.5 * Maximum);

    /// <summary>The extents along the axes; zero for an empty box.</summary>
    public Vector Size => IsEmpty ? Vector.Zero : Maximum - Minimum;

    /// <summary>The length of the diagonal.</summary>
    public double Diagonal => Size.MaxAbsComponent() switch
    {
        > 0 and < double.PositiveInfinity and var largest => largest * (Size / largest).Length(),
        var largest => largest,
    };

    /// <summary>The smallest box that holds both.</summary>
    public static BoundingBox Union(BoundingBox box1, BoundingBox box2) =>
        new(Vector.Min(box1.Minimum, box2.Minimum), Vector.Max(box1.Maximum, box2.Maximum));

    /// <summary>The smallest box that holds this one and a point.</summary>
    public BoundingBox Including(Vector point) => new(Vector.Min(Minimum, point), Vector.Max(Maximum, point));

    /// <summary>The squared distance of a position: 0 inside, infinite for the empty box.</summary>
    public double DistanceSquared(Vector position) => IsEmpty ? double.PositiveInfinity
        : Vector.Max(Vector.Max(Minimum - position, position - Maximum), Vector.Zero).LengthSquared();

    /// <summary>
    /// The smallest axis-aligned box around the image of this box; larger than the image of what it holds where the map turns.
    /// </summary>
    public BoundingBox Transform(AffineMap map) => IsEmpty ? this : (map * Centre, map.Linear.Absolute() * (0.5 * Size)) switch
    {
        var (centre, half) => new(centre - half, centre + half),
    };

    /// <summary>Both corners, invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"{Minimum}..{Maximum}");
}
