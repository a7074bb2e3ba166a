using FractalEngine.Core.Generation;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Object of a fractal file: a base mesh and the steps applied to it so far (paper §4.2.2).</summary>
/// <param name="BaseFile">Name of the base mesh's file, as written, or one of the <see cref="BaseShapes"/>.</param>
/// <param name="BaseFileNameOffset">Offset of that name in the text.</param>
/// <param name="Steps">Steps applied to the base mesh, outermost first.</param>
internal record DeclaredObject(string BaseFile, int BaseFileNameOffset, DeclaredSteps Steps)
{
    /// <summary>Object that this one was made from; null for a base mesh.</summary>
    public DeclaredObject? Origin { get; init; }

    /// <summary>Returns whether this object is the other one, or was made from it in any number of declarations.</summary>
    public bool IsDerivedFrom(DeclaredObject other)
    {
        for (var origin = this; origin is not null; origin = origin.Origin)
        {
            if (ReferenceEquals(origin, other))
            {
                return true;
            }
        }

        return false;
    }
}
