using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>What a <see cref="NeighbourGrid"/> must hold.</summary>
/// <param name="Min">Least coordinates of all centres, world space.</param>
/// <param name="Max">Greatest coordinates of all centres.</param>
/// <param name="MaxRadius">The largest radius.</param>
internal readonly record struct GridBounds(Vector Min, Vector Max, double MaxRadius)
{
    /// <summary>That of no bodies.</summary>
    public static GridBounds None { get; } = new(double.PositiveInfinity * Vector.One, double.NegativeInfinity * Vector.One, 0);

    /// <summary>Holds one more body.</summary>
    public GridBounds With(Vector position, double radius) =>
        new(Vector.Min(Min, position), Vector.Max(Max, position), Math.Max(MaxRadius, radius));

    /// <summary>Holds what both hold.</summary>
    public static GridBounds Union(in GridBounds first, in GridBounds second) => new(
        Vector.Min(first.Min, second.Min), Vector.Max(first.Max, second.Max), Math.Max(first.MaxRadius, second.MaxRadius));
}
