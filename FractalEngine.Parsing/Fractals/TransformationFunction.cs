using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fractals;

/// <summary>
/// Transformation function of a fractal file, from vectors to a transformation. Its outputs are resolved to indices of the arguments, so
/// that a call needs no names.
/// </summary>
/// <param name="ParameterCount">Number of parameters, 0 to 3.</param>
/// <param name="Position">The position.</param>
/// <param name="Rotation">The rotation in degrees.</param>
/// <param name="Scale">The scale.</param>
internal sealed record TransformationFunction(
    int ParameterCount, FunctionOutput Position, FunctionOutput Rotation, FunctionOutput Scale)
{
    /// <summary>Returns the transformation for the given arguments, one a parameter, perhaps with room for more. Keeps no array.</summary>
    public Transformation Apply(Vector[] arguments) => new(Position.Apply(arguments), Rotation.Apply(arguments), Scale.Apply(arguments));
}
