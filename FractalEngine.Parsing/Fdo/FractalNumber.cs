using System.Collections.Immutable;
using System.Globalization;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>A number in the text of a fractal file that can be turned.</summary>
/// <param name="Role">What the number means.</param>
/// <param name="Name">
/// The name of the number or vector, the vector's number behind a <c>v</c>, the function that has the vector as an output, the name of
/// the recursive, or the called function with the number of the call in the file.
/// </param>
/// <param name="Component">0, 1 and 2 for x, y and z of a vector; the index of an argument; 0 for a depth.</param>
/// <param name="Offset">Where the number begins in the text, in characters.</param>
/// <param name="Length">Number of characters.</param>
/// <param name="Value">The number as the text has it.</param>
public sealed record FractalNumber(FractalNumberRole Role, string Name, int Component, int Offset, int Length, double Value)
{
    /// <summary>
    /// Where the call of an argument stands: the number of its set in the file and its place in the set, both from 0, and the number of
    /// entries of the set. Null for other numbers.
    /// </summary>
    public (int Set, int Index, int SetSize)? Call { get; init; }

    /// <summary>Number of the vector that a component is of, from 1; null for a vector with a name, and for what is no component.</summary>
    public int? Vector { get; init; }

    /// <summary>True where the number stands for three equal components.</summary>
    public bool IsEven { get; init; }

    /// <summary>Ends that the file gives to the slider of a named number; null for other numbers, and where it gives none.</summary>
    public (double From, double To)? Range { get; init; }

    /// <summary>
    /// Lists the numbers of a fractal in their order: named ones, components of its vectors, the arguments of its calls, and the depths of
    /// its recursives.
    /// </summary>
    /// <param name="source">A text that is a fractal.</param>
    /// <exception cref="SourceException">The text is not a fractal, or has no valid meaning.</exception>
    public static ImmutableArray<FractalNumber> FindAll(SourceText source) => FractalParser.FindNumbers(source);

    /// <summary>Returns the text with another number in the place of this one. All other characters stay.</summary>
    /// <param name="text">The text in which this number was found.</param>
    /// <param name="value">The new number, finite; rounded for a depth and for an argument, which is 1 at least.</param>
    public string Replace(string text, double value)
    {
        ArgumentNullException.ThrowIfNull(text);
        var number = Role is FractalNumberRole.Depth or FractalNumberRole.Argument
            ? Math.Max(Role == FractalNumberRole.Depth ? 0 : 1, Math.Round(value)).ToString("F0", CultureInfo.InvariantCulture)
            : value.ToString("R", CultureInfo.InvariantCulture);
        return string.Concat(text.AsSpan(0, Offset), number, text.AsSpan(Offset + Length));
    }
}
