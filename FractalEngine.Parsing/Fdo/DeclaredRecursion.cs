namespace FractalEngine.Parsing.Fdo;

/// <summary>Infinite object that is repeated over what it begins with. Giving it a depth makes a finite object.</summary>
/// <param name="Part">Index of what the steps are applied to.</param>
/// <param name="Steps">Steps applied to it, outermost first.</param>
internal abstract record DeclaredRecursion(int Part, DeclaredSteps Steps) : DeclaredObject(Part, Steps)
{
    /// <summary>Number of calls that are listed anew for each depth.</summary>
    public abstract int CallCount { get; }

    /// <summary>Returns the recursion to a finite depth. Depth 0 is what it begins with.</summary>
    public abstract DeclaredObject WithDepth(int depth);
}
