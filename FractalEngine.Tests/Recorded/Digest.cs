using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Recorded;

/// <summary>
/// Sums up numbers in their order, each with a weight of its own, so that one that changes or two that change places are seen.
/// </summary>
internal sealed class Digest
{
    // The fractional parts of its multiples lie apart (Weyl).
    private const double Golden = 0.6180339887498949;

    // What is smaller may be rounding of 0.
    private const double Unit = 1e-6;

    private int _count;
    private double _sum;

    /// <summary>Adds a coordinate: its order of magnitude, so that large ones don't hide small ones; those below 1e-6 count less.</summary>
    public Digest Add(double value) =>
        Sum(double.IsFinite(value) ? Math.Asinh(value / Unit) : double.IsNaN(value) ? 0.3 : Math.Sign(value) * 2e3);

    /// <summary>Adds a number of which only 0 is as small as rounding: a bound, or a tolerance.</summary>
    public Digest AddBound(double value) => Sum(value > 0 && double.IsFinite(value) ? Math.Log(value) : value == 0 ? 1e3 : 3e3);

    /// <summary>Adds the components of a vector.</summary>
    public Digest Add(Vector value) => Add(value.X).Add(value.Y).Add(value.Z);

    /// <summary>Adds both corners of a box.</summary>
    public Digest Add(BoundingBox box) => Add(box.Minimum).Add(box.Maximum);

    /// <summary>Adds all entries of a map.</summary>
    public Digest Add(AffineMap map) =>
        Add(map.Translation).Add(map.Linear * Vector.I).Add(map.Linear * Vector.J).Add(map.Linear * Vector.K);

    /// <summary>Adds indices.</summary>
    public Digest Add(ReadOnlySpan<int> indices)
    {
        Add(indices.Length);
        foreach (int index in indices)
        {
            Add(index);
        }

        return this;
    }

    private Digest Sum(double value)
    {
        _count++;
        _sum += (1 + ((_count * Golden) % 1)) * value;
        return this;
    }

    /// <inheritdoc/>
    public override string ToString() => RecordedText.Text(_sum);
}
