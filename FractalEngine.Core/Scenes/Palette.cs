using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>Colours by a number from 0 to 1, blended in linear light from each stop to the next, and constant outside of them.</summary>
/// <remarks>Two palettes are equal when their names and stops are. Looking up takes time by the logarithm of the stops.</remarks>
public sealed class Palette : IEquatable<Palette>
{
    // Shorter ranges are one colour: the difference of two integrals would have no digits left.
    private const double MinRange = 1e-9;

    private readonly double[] _positions;
    private readonly Vector[] _colours;

    // The integrals of the colour from 0 to each stop.
    private readonly Vector[] _integrals;

    /// <summary>Makes a palette of stops.</summary>
    /// <param name="stops">At least two, with positions from 0 to 1 that do not decrease. Equal ones make a sharp edge.</param>
    /// <exception cref="ArgumentException">There are fewer stops, or their positions are others.</exception>
    /// <exception cref="ArgumentNullException">The array is the default one.</exception>
    public Palette(ImmutableArray<PaletteStop> stops)
        : this(stops.IsDefault ? throw new ArgumentNullException(nameof(stops)) : stops, null)
    {
    }

    private Palette(ImmutableArray<PaletteStop> stops, string? name)
    {
        _positions = [.. stops.Select(static stop => stop.Position)];
        if (stops.Length < 2 || !(_positions[0] >= 0) || !(_positions[^1] <= 1)
            || _positions.Zip(_positions.Skip(1)).Any(static pair => !(pair.First <= pair.Second)))
        {
            throw new ArgumentException("expected two or more stops at ascending positions from 0 to 1", nameof(stops));
        }

        Name = name;
        Stops = stops;
        _colours = [.. stops.Select(static stop => stop.Colour.ToLinearVector())];
        _integrals = new Vector[stops.Length];
        _integrals[0] = _positions[0] * _colours[0];
        for (var i = 1; i < stops.Length; i++)
        {
            _integrals[i] = _integrals[i - 1] + (0.5 * (_positions[i] - _positions[i - 1]) * (_colours[i - 1] + _colours[i]));
        }
    }

    /// <summary>The name by which scenes call it; null for one that they write out.</summary>
    public string? Name { get; }

    /// <summary>The stops by ascending positions.</summary>
    public ImmutableArray<PaletteStop> Stops { get; }

    /// <summary>True where the stops divide the range from 0 to 1 evenly.</summary>
    public bool IsEven => Stops.Select(static (stop, index) => (stop.Position, Index: index)).All(
        stop => stop.Position.Equals(EvenPosition(stop.Index, Stops.Length)));

    /// <summary>Makes a palette whose stops divide the range from 0 to 1 evenly.</summary>
    /// <param name="colours">Two colours or more.</param>
    /// <exception cref="ArgumentException">There are fewer colours.</exception>
    public static Palette OfEven(params IReadOnlyCollection<Colour> colours) => OfEven(colours, null);

    /// <summary>Makes an even palette that scenes call by a name.</summary>
    internal static Palette OfEven(IReadOnlyCollection<Colour> colours, string? name)
    {
        ArgumentNullException.ThrowIfNull(colours);
        return new([.. colours.Select((colour, index) => new PaletteStop(EvenPosition(index, colours.Count), colour))], name);
    }

    /// <summary>The colour at a position, linear light: red, green, blue.</summary>
    /// <param name="position">From 0 to 1; what lies outside has the colour of the nearest end.</param>
    public Vector ColourAt(double position)
    {
        var next = FindNext(position);
        if (next == 0 || next == _positions.Length)
        {
            return _colours[Math.Min(next, _colours.Length - 1)];
        }

        var part = (position - _positions[next - 1]) / (_positions[next] - _positions[next - 1]);
        return ((1 - part) * _colours[next - 1]) + (part * _colours[next]);
    }

    /// <summary>The mean colour between two positions, linear light, exact but for rounding.</summary>
    /// <param name="from">The lower position.</param>
    /// <param name="to">The upper position; where it is no higher, the colour is that between the two.</param>
    public Vector MeanOver(double from, double to) =>
        to - from > MinRange ? (1 / (to - from)) * (IntegralTo(to) - IntegralTo(from)) : ColourAt(0.5 * (from + to));

    /// <inheritdoc/>
    public bool Equals(Palette? other) => other is not null && Name == other.Name && Stops.AsSpan().SequenceEqual(other.Stops.AsSpan());

    /// <inheritdoc/>
    public override bool Equals(object? obj) => Equals(obj as Palette);

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Name, Stops.Length, Stops[0], Stops[^1]);

    private static double EvenPosition(int index, int count) => (double)index / (count - 1);

    private Vector IntegralTo(double position)
    {
        var last = FindNext(position) - 1;
        return last < 0
            ? position * _colours[0]
            : _integrals[last] + (0.5 * (position - _positions[last]) * (_colours[last] + ColourAt(position)));
    }

    /// <summary>The number of stops at or before a position.</summary>
    private int FindNext(double position)
    {
        var (low, high) = (0, _positions.Length);
        while (low < high)
        {
            var middle = (low + high) / 2;
            (low, high) = _positions[middle] <= position ? (middle + 1, high) : (low, middle);
        }

        return low;
    }
}
