using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Infinite object that repeats its own steps over its base.</summary>
/// <param name="Base">Finite object that the recursion starts from.</param>
/// <param name="IterationSteps">Steps that one iteration adds, outermost first.</param>
internal sealed record DeclaredRecursive(DeclaredObject Base, ImmutableArray<FractalStep> IterationSteps)
    : DeclaredRecursion(Base.Part, Base.Steps.Prepend(new Repetition(IterationSteps, null)))
{
    /// <inheritdoc/>
    public override int CallCount => 0;

    /// <summary>Returns the recursion to a finite depth: Sⁿ after the base. Depth 0 is the base itself.</summary>
    public override DeclaredObject WithDepth(int depth) =>
        new(Part, Base.Steps.Prepend(new Repetition(IterationSteps, depth)));

    /// <inheritdoc/>
    public override (ImmutableArray<FractalRecursive> Recursives, int Index) GetRecursives(FractalPartList parts) => (
        parts.CreateRecursives(
            [parts.AddSteps(Base.Part, Base.Steps.Take(Base.Steps.Count))], [parts.AddSteps(parts.AddCall(0), IterationSteps)]),
        0);
}
