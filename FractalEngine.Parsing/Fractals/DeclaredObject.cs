using System.Collections.Immutable;
using FractalEngine.Core.Fractals;

namespace FractalEngine.Parsing.Fractals;

/// <summary>An object under a name: a base mesh and the steps applied to it so far (paper §4.2.2).</summary>
/// <param name="BaseFile">As the file names it.</param>
/// <param name="BaseFileNameOffset">Where it does.</param>
/// <param name="Steps">Outermost first.</param>
internal record DeclaredObject(string BaseFile, int BaseFileNameOffset, ImmutableArray<FractalStep> Steps)
{
    /// <summary>The object that this one was made from; null for a base mesh.</summary>
    public DeclaredObject? Origin { get; init; }

    /// <summary>True when this object is <paramref name="other"/>, or was made from it in any number of declarations.</summary>
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

/// <summary>
/// An object without end: its own steps over its base, repeated for ever. Giving it a depth makes a finite object.
/// </summary>
/// <param name="Base">What the recursion starts from.</param>
/// <param name="IterationSteps">The steps that one round adds, outermost first.</param>
internal sealed record DeclaredRecursive(DeclaredObject Base, ImmutableArray<FractalStep> IterationSteps)
    : DeclaredObject(Base.BaseFile, Base.BaseFileNameOffset, Base.Steps.Insert(0, new Repetition(IterationSteps, null)))
{
    /// <summary>The recursion carried out a number of times: Sⁿ after A; depth 0 is the base.</summary>
    public DeclaredObject WithDepth(int depth) =>
        new(BaseFile, BaseFileNameOffset, Base.Steps.Insert(0, new Repetition(IterationSteps, depth))) { Origin = Base };
}
