using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fractals;

/// <summary>One vector of what a transformation function returns: an argument of the call, or always the same.</summary>
/// <param name="Parameter">Index of the parameter, from 0; null where it is always the same.</param>
/// <param name="Constant">The vector where there is no parameter.</param>
internal readonly record struct FunctionOutput(int? Parameter, Vector Constant)
{
    /// <summary>Returns the vector for the given arguments.</summary>
    public Vector Apply(Vector[] arguments) => Parameter is { } index ? arguments[index] : Constant;
}
