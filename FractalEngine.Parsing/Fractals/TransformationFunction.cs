using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fractals;

/// <summary>
/// Transformation function of a fractal file, from vectors to a transformation. Its outputs are resolved to functions of the arguments,
/// so that a call needs no names.
/// </summary>
/// <param name="ParameterCount">Number of parameters, 0 to 3.</param>
/// <param name="Position">Returns the position for given arguments.</param>
/// <param name="Rotation">Returns the rotation in degrees for given arguments.</param>
/// <param name="Scale">Returns the scale for given arguments.</param>
internal sealed record TransformationFunction(
    int ParameterCount,
    Func<Vector[], Vector> Position,
    Func<Vector[], Vector> Rotation,
    Func<Vector[], Vector> Scale)
{
    /// <summary>Returns the transformation for the given arguments, one a parameter, perhaps with room for more. Keeps no array.</summary>
    public Transformation Apply(Vector[] arguments) =>
        new(Position(arguments), Rotation(arguments), Scale(arguments));
}
