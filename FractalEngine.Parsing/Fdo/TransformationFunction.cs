using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>
/// Transformation function of a fractal file, from vectors and numbers to a transformation. Its outputs are resolved to indices of the
/// arguments and numbers of vectors, so that a call needs no names.
/// </summary>
/// <param name="Parameters">The parameters, 0 to 3.</param>
/// <param name="Position">The position.</param>
/// <param name="Rotation">The rotation in degrees.</param>
/// <param name="Scale">The scale.</param>
internal sealed record TransformationFunction(
    FractalParameters Parameters, FunctionOutput Position, FunctionOutput Rotation, FunctionOutput Scale)
{
    /// <summary>The one map that the file states as a matrix; null for a position, a rotation and a scale.</summary>
    public AffineMap[]? Matrix { get; init; }

    /// <summary>Where a colour begins that the function mixes in; null for none. It is read again for each call.</summary>
    public Cursor? Colour { get; init; }

    /// <summary>The highest vector number of the outputs; 0 without any.</summary>
    public int LastVectorNumber { get; } =
        Math.Max(Math.Max(Position.VectorNumber ?? 0, Rotation.VectorNumber ?? 0), Scale.VectorNumber ?? 0);

    /// <summary>The output with the highest vector number, the first of several.</summary>
    public FunctionOutput Last => new[] { Position, Rotation, Scale }.MaxBy(static output => output.VectorNumber ?? 0);

    /// <summary>The outputs with what each makes of a vector.</summary>
    public IEnumerable<(FunctionOutput Output, FractalNumberRole Role)> Outputs =>
        [(Position, FractalNumberRole.Position), (Rotation, FractalNumberRole.Rotation), (Scale, FractalNumberRole.Scale)];
}
