using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Infinite object that is repeated over what it begins with. Giving it a depth makes a finite object.</summary>
/// <param name="Part">Index of what the steps are applied to.</param>
/// <param name="Steps">Steps applied to it, outermost first.</param>
internal abstract record DeclaredRecursion(int Part, DeclaredSteps Steps) : DeclaredObject(Part, Steps)
{
    /// <summary>Number of calls that are listed anew for each depth.</summary>
    public abstract int CallCount { get; }

    /// <summary>The names of the recursives that call each other.</summary>
    public required ImmutableArray<string> Names { get; init; }

    /// <summary>Returns the recursion to a finite depth. Depth 0 is what it begins with.</summary>
    public abstract DeclaredObject WithDepth(int depth);

    /// <summary>Returns the recursives of the recursion, and the index of this one among them.</summary>
    /// <param name="parts">The parts of the file.</param>
    public abstract (ImmutableArray<FractalRecursive> Recursives, int Index) GetRecursives(FractalPartList parts);
}
