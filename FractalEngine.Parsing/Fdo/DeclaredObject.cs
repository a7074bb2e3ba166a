using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Object of a fractal file: a base mesh, a sum or recursives, and the steps applied to it so far (paper §4.2.2).</summary>
/// <param name="Part">Index of what the steps are applied to in the <see cref="FractalPartList"/> of the file.</param>
/// <param name="Steps">Steps applied to it, outermost first.</param>
internal record DeclaredObject(int Part, DeclaredSteps Steps)
{
    /// <summary>True for what is written as a name: one thing, whatever steps it is made by.</summary>
    public bool IsName { get; init; }

    /// <summary>Returns whether this object is the other one, or was made from it in any number of declarations.</summary>
    public bool IsDerivedFrom(DeclaredObject other) => Part == other.Part && Steps.EndWith(other.Steps);
}
