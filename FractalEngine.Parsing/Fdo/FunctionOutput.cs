using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>One vector of what a transformation function returns: an argument of the call, a vector of the file, or '#'.</summary>
/// <param name="Parameter">Index of the parameter, from 0; null where there is none.</param>
/// <param name="VectorNumber">Number of the vector, from 1, which is looked up when the function is called; null for none.</param>
/// <param name="Default">What '#' stands for here.</param>
/// <param name="Start">Place in the file.</param>
internal readonly record struct FunctionOutput(int? Parameter, int? VectorNumber, Vector Default, Cursor Start)
{
    /// <summary>Returns the vector for the given arguments.</summary>
    /// <param name="arguments">The arguments of the call.</param>
    /// <param name="vectors">The vectors that are declared above the call, with that of the number among them.</param>
    public Vector Apply(Vector[] arguments, List<Vector> vectors) => Parameter is { } index ? arguments[index]
        : VectorNumber is { } number ? vectors[number - 1]
        : Default;
}
