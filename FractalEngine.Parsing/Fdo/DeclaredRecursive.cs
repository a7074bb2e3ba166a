using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Infinite object that repeats its own steps over its base. Giving it a depth makes a finite object.</summary>
/// <param name="Base">Finite object that the recursion starts from.</param>
/// <param name="IterationSteps">Steps that one iteration adds, outermost first.</param>
internal sealed record DeclaredRecursive(DeclaredObject Base, ImmutableArray<FractalStep> IterationSteps)
    : DeclaredObject(Base.BaseFile, Base.BaseFileNameOffset, Base.Steps.Prepend(new Repetition(IterationSteps, null)))
{
    /// <summary>Returns the recursion to a finite depth: Sⁿ after the base. Depth 0 is the base itself.</summary>
    public DeclaredObject WithDepth(int depth) =>
        new(BaseFile, BaseFileNameOffset, Base.Steps.Prepend(new Repetition(IterationSteps, depth))) { Origin = Base };
}
