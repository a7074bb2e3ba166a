using System.Globalization;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>An axis-aligned bounding box, closed; <see cref="Empty"/> holds no point.</summary>
/// <param name="Minimum">Corner with the smallest coordinates.</param>
/// <param name="Maximum">Corner with the largest coordinates.</param>
public readonly record struct BoundingBox(Vector Minimum, Vector Maximum)
{
    /// <summary>The box that holds no point; the union with it changes no box.</summary>
    public static BoundingBox Empty { get; } = new(
        new(double.PositiveInfinity, double.PositiveInfinity, double.PositiveInfinity),
        new(double.NegativeInfinity, double.NegativeInfinity, double.NegativeInfinity));

    /// <summary>Whether the box holds no point.</summary>
    public bool IsEmpty => !(Minimum.X <= Maximum.X && Minimum.Y <= Maximum.Y && Minimum.Z <= Maximum.Z);

    /// <summary>Centre of the box; the origin for an empty box.</summary>
    public Vector Centre => IsEmpty ? Vector.Zero : (0.5 * Minimum) + (0.5 * Maximum);

    /// <summary>Extents along the axes; zero for an empty box.</summary>
    public Vector Size => IsEmpty ? Vector.Zero : Maximum - Minimum;

    /// <summary>Length of the diagonal; right for sizes whose squares leave the range of a double.</summary>
    public double Diagonal
    {
        get
        {
            var largest = Size.MaxAbsComponent();
            return largest > 0 && largest < double.PositiveInfinity ? largest * (Size / largest).Length() : largest;
        }
    }

    /// <summary>Returns a corner of the box.</summary>
    /// <param name="index">From 0 to 7: its bits choose the largest instead of the smallest coordinate, that of x is the lowest.</param>
    public Vector Corner(int index) => new(
        (index & 1) == 0 ? Minimum.X : Maximum.X, (index & 2) == 0 ? Minimum.Y : Maximum.Y, (index & 4) == 0 ? Minimum.Z : Maximum.Z);

    /// <summary>Computes the smallest box that holds some points.</summary>
    internal static BoundingBox Around(ReadOnlySpan<Vector> points)
    {
        var box = Empty;
        foreach (var point in points)
        {
            box = box.Including(point);
        }

        return box;
    }

    /// <summary>Computes the smallest box that holds two boxes.</summary>
    public static BoundingBox Union(BoundingBox box1, BoundingBox box2) =>
        new(Vector.Min(box1.Minimum, box2.Minimum), Vector.Max(box1.Maximum, box2.Maximum));

    /// <summary>Computes the box of what two boxes both bound.</summary>
    /// <remarks>
    /// Rounding may leave a gap between them along an axis where they are flat. The box fills it: what it bounds lies beyond neither side
    /// of the gap by more than the rounding of the boxes, and so beyond none of the filled box.
    /// </remarks>
    internal static BoundingBox Intersection(BoundingBox box1, BoundingBox box2)
    {
        if (box1.IsEmpty || box2.IsEmpty)
        {
            return Empty;
        }

        var minimum = Vector.Max(box1.Minimum, box2.Minimum);
        var maximum = Vector.Min(box1.Maximum, box2.Maximum);
        return new(Vector.Min(minimum, maximum), Vector.Max(minimum, maximum));
    }

    /// <summary>Returns the length of the diagonal, or a fallback where it is zero or infinite.</summary>
    public double FiniteDiagonalOr(double fallback) => Diagonal is > 0 and < double.PositiveInfinity and var diagonal ? diagonal : fallback;

    /// <summary>Computes the smallest box that holds this one and a point.</summary>
    public BoundingBox Including(Vector point) => new(Vector.Min(Minimum, point), Vector.Max(Maximum, point));

    /// <summary>Tells whether another box, which must hold a point, lies within this one.</summary>
    internal bool Contains(in BoundingBox other) =>
        other.Minimum.X >= Minimum.X && other.Minimum.Y >= Minimum.Y && other.Minimum.Z >= Minimum.Z
        && other.Maximum.X <= Maximum.X && other.Maximum.Y <= Maximum.Y && other.Maximum.Z <= Maximum.Z;

    /// <summary>Computes the largest absolute coordinate; infinite for the empty box.</summary>
    internal double MaxAbsCoordinate() => Math.Max(Minimum.MaxAbsComponent(), Maximum.MaxAbsComponent());

    /// <summary>Computes the squared distance of a position: 0 inside, infinite for the empty box.</summary>
    public double DistanceSquared(Vector position) => IsEmpty ? double.PositiveInfinity
        : Vector.Max(Vector.Max(Minimum - position, position - Maximum), Vector.Zero).LengthSquared();

    /// <summary>Computes the smallest axis-aligned box around the image of this box.</summary>
    /// <remarks>Where the map rotates, it is larger than the box of the image of what this box holds.</remarks>
    public BoundingBox Transform(AffineMap map)
    {
        if (IsEmpty)
        {
            return this;
        }

        var centre = map * Centre;
        var halfSize = map.Linear.Absolute() * ((0.5 * Maximum) - (0.5 * Minimum));
        return new(centre - halfSize, centre + halfSize);
    }

    /// <summary>Computes the scale and translation from one box to another.</summary>
    /// <remarks>Along an axis where the first box is flat, its size is kept.</remarks>
    internal static AffineMap MapBoxToBox(BoundingBox from, BoundingBox to)
    {
        var (x1, y1, z1) = from.Size;
        var (x2, y2, z2) = to.Size;
        var scale = new Vector(x1 > 0 ? x2 / x1 : 1, y1 > 0 ? y2 / y1 : 1, z1 > 0 ? z2 / z1 : 1);
        return new(Matrix.Diagonal(scale), to.Centre - from.Centre.Stretch(scale));
    }

    /// <summary>Formats both corners in the invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"{Minimum}..{Maximum}");
}
