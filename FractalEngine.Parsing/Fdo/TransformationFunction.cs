using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo;

/// <summary>
/// Transformation function of a fractal file, from vectors to a transformation. Its outputs are resolved to indices of the arguments and
/// numbers of vectors, so that a call needs no names.
/// </summary>
/// <param name="ParameterCount">Number of parameters, 0 to 3.</param>
/// <param name="Position">The position.</param>
/// <param name="Rotation">The rotation in degrees.</param>
/// <param name="Scale">The scale.</param>
internal sealed record TransformationFunction(
    int ParameterCount, FunctionOutput Position, FunctionOutput Rotation, FunctionOutput Scale)
{
    /// <summary>The output with the highest vector number, the first of several.</summary>
    public FunctionOutput Last { get; } = new[] { Position, Rotation, Scale }.MaxBy(static output => output.VectorNumber ?? 0);

    /// <summary>The outputs with what each makes of a vector.</summary>
    public IEnumerable<(FunctionOutput Output, FractalNumberRole Role)> Outputs =>
        [(Position, FractalNumberRole.Position), (Rotation, FractalNumberRole.Rotation), (Scale, FractalNumberRole.Scale)];

    /// <summary>Returns the transformation for a call. Keeps no array.</summary>
    /// <param name="arguments">One a parameter, perhaps with room for more.</param>
    /// <param name="vectors">The vectors that are declared above the call.</param>
    public Transformation Apply(Vector[] arguments, List<Vector> vectors) =>
        new(Position.Apply(arguments, vectors), Rotation.Apply(arguments, vectors), Scale.Apply(arguments, vectors));
}
