using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>One vector of what a transformation function returns.</summary>
/// <param name="Value">The vector, where it is known; what '#' stands for here.</param>
/// <param name="Start">Place in the file.</param>
internal readonly record struct FunctionOutput(Vector Value, Cursor Start)
{
    /// <summary>Index of the parameter, from 0; null where there is none.</summary>
    public int? Parameter { get; init; }

    /// <summary>Number of the vector, from 1, which is looked up when the function is called; null for none.</summary>
    public int? VectorNumber { get; init; }

    /// <summary>True for a vector of expressions with parameters, which is read again for each call.</summary>
    public bool HasParameters => !Value.IsFinite();
}
