using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>
/// What a <see cref="FractalHierarchy"/> is built from: recursives that call each other, and steps that are applied to one of them.
/// </summary>
/// <remarks>
/// A fractal of one base mesh is a recursive without levels, and all its steps. A recursive that calls only itself is better described by a
/// <see cref="Repetition"/>, which makes no instance twice because of the identity: see <see cref="ChildInstanceBuilder"/>.
/// </remarks>
/// <param name="Recursives">The recursives, which refer to each other by their indices.</param>
/// <param name="Root">Index of the recursive that the steps are applied to.</param>
/// <param name="Levels">Number of levels of that recursive; null for infinitely many.</param>
/// <param name="Steps">What is applied to that recursive, the outermost step first.</param>
internal sealed record HierarchyDescription(
    ImmutableArray<FractalRecursive> Recursives, int Root, long? Levels, ImmutableArray<FractalStep> Steps)
{
    /// <summary>True when all maps are similarities, and a search by similarities may compute in the units of the base meshes.</summary>
    public bool HasOnlySimilarities { get; } = Steps.All(HasOnlySimilarMaps)
        && Recursives.All(static recursive => recursive.Calls.All(static call => call.Map.Linear.IsChainableSimilarity()))
        && !Recursives.Any(static recursive => QueryScale.IsNeeded(QueryScale.Magnitude(recursive.BaseMesh)));

    /// <summary>Describes a fractal in affine composition: one chain of steps on one base mesh.</summary>
    public static HierarchyDescription Of(Mesh baseMesh, ImmutableArray<FractalStep> steps) => new([new(baseMesh, [])], 0, 0, steps);

    /// <summary>Describes recursives that call each other.</summary>
    /// <param name="recursives">The recursives, at least one.</param>
    /// <param name="root">Index of the recursive that is the fractal, or that the steps are applied to.</param>
    /// <param name="levels">Number of its levels; null for infinitely many, which no steps may follow.</param>
    /// <param name="steps">Steps that are applied to it, the outermost first.</param>
    /// <exception cref="ArgumentException">A call leads to no recursive or to no fewer levels, or steps follow an infinite one.</exception>
    public static HierarchyDescription Of(
        ImmutableArray<FractalRecursive> recursives, int root, long? levels, ImmutableArray<FractalStep> steps = default)
    {
        steps = steps.IsDefault ? [] : steps;
        ArgumentOutOfRangeException.ThrowIfNegative(levels ?? 0, nameof(levels));
        ArgumentOutOfRangeException.ThrowIfGreaterThan((uint)root, (uint)recursives.Length - 1, nameof(root));
        if (recursives.SelectMany(static recursive => recursive.Calls)
            .Any(call => (uint)call.Recursive >= (uint)recursives.Length || call.LevelsLess < 1))
        {
            throw new ArgumentException("expected calls of the given recursives, with fewer levels", nameof(recursives));
        }

        if (levels is null && steps.Length > 0)
        {
            throw new ArgumentException("expected no steps after an infinite recursive", nameof(steps));
        }

        // Without levels nothing is called, and only the base mesh counts.
        return levels == 0
            ? new([new(recursives[root].BaseMesh, [])], 0, 0, steps)
            : new(recursives, root, levels, steps);
    }

    private static bool HasOnlySimilarMaps(FractalStep step) => step switch
    {
        Repetition repetition => repetition.Round.All(HasOnlySimilarMaps),
        TransformationSet set => set.Maps.All(static map => map.Linear.IsChainableSimilarity()),
        _ => throw new ArgumentException($"{step.GetType().Name} is no step of a fractal", nameof(step)),
    };
}
