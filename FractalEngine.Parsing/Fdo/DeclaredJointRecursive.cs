using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Infinite object that calls itself and others, at several places of a sum or each in its own way.</summary>
/// <param name="Parts">The parts of the file.</param>
/// <param name="Recursives">The recursives that call each other.</param>
/// <param name="Index">Index of this one among them.</param>
internal sealed record DeclaredJointRecursive(FractalPartList Parts, ImmutableArray<FractalRecursive> Recursives, int Index)
    : DeclaredRecursion(Parts.AddRecursive(Recursives, Index, null), DeclaredSteps.None)
{
    /// <inheritdoc/>
    public override int CallCount => Recursives.Sum(static recursive => recursive.Calls.Length);

    /// <inheritdoc/>
    public override DeclaredObject WithDepth(int depth) => new(Parts.AddRecursive(Recursives, Index, depth), DeclaredSteps.None);

    /// <inheritdoc/>
    public override (ImmutableArray<FractalRecursive> Recursives, int Index) GetRecursives(FractalPartList parts) => (Recursives, Index);
}
