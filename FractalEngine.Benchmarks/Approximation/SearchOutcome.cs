using System.Diagnostics;
using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Parsing.Approximation;

namespace FractalEngine.Benchmarks.Approximation;

/// <summary>What the search found in one mesh, measured on the files as they are read back.</summary>
/// <param name="IsFound">Whether it makes the undamaged model, and saves at least half of what the model repeats.</param>
/// <param name="IsWrong">Whether something was found that makes another model.</param>
/// <param name="Seconds">Time of the search, with reading back and comparing.</param>
/// <param name="MapCount">Maps of all sets.</param>
/// <param name="BaseFaces">Faces of the base meshes.</param>
/// <param name="ModelFaces">Faces of the mesh that was searched.</param>
/// <param name="Description">What the input is, and what was found.</param>
internal sealed record SearchOutcome(
    bool IsFound, bool IsWrong, double Seconds, int MapCount, int BaseFaces, int ModelFaces, string Description)
{
    // Largest difference of vertices, as a part of the diagonal, of what is called exact.
    private const double ExactTolerance = 1e-6;
    private static readonly TimeSpan Limit = TimeSpan.FromSeconds(60);

    /// <summary>Searches, and compares what is read back with the undamaged model.</summary>
    /// <param name="input">A model, damaged.</param>
    /// <param name="damage">What was done to it.</param>
    public static SearchOutcome Measure(UnseenInput input, Damage damage)
    {
        using var limit = new CancellationTokenSource(Limit);
        var watch = Stopwatch.StartNew();
        ApproximationResult? result = null;
        try
        {
            result = MeshApproximator.Find(input.Mesh, null, null, limit.Token);
        }
        catch (OperationCanceledException)
        {
        }

        var seconds = watch.Elapsed.TotalSeconds;
        if (result is null or { Verdict: ApproximationVerdict.NoFractal })
        {
            return new(false, false, seconds, 0, 0, input.Mesh.FaceCount, $"nothing in {input.Description}");
        }

        var grammar = result.Grammar;
        var (maps, faces) = (grammar.MapCount, grammar.FaceCount);
        var grade = damage.Kind == DamageKind.SplitEdges ? Grader.CompareSurfaces(result.Made, input, damage.Tolerance(input))
            // No base is as the undamaged one: maps are judged alone.
            : damage.Kind == DamageKind.Decimated ? GradeMaps(grammar, input)
            : Grader.Compare(
                result.Made, input, damage == Damage.None ? ExactTolerance * input.Clean.Bounds.Diagonal : damage.Tolerance(input));

        // A base that is most of the model explains little.
        var isSmall = faces <= 4 * input.BaseFaces && maps <= 4 * (input.Generators.Length + 8);
        var verdict = !grade.IsFound ? "WRONG" : isSmall ? "found" : "LARGE";
        var steps = string.Join(' ', grammar.Steps.Select(
            step => $"({string.Join('*', step.Sets.Select(set => set.Count))})^{step.Depth}"));
        return new(grade.IsFound && isSmall, !grade.IsFound, seconds, maps, faces, input.Mesh.FaceCount,
            $"{verdict} {result.Verdict} {steps} tree {grammar.Tree?.Maps.Count}^{grammar.Tree?.Depth}, {faces} faces, "
            + $"in {input.Description}");
    }

    private static Grade GradeMaps(MeshGrammar grammar, UnseenInput input)
    {
        var diagonal = input.Clean.Bounds.Diagonal;
        var made = WrittenGrammar.Create(UndamagedBase.Put(grammar, input), diagonal, long.MaxValue).Mesh;
        return Grader.CompareSurfaces(made, input, UndamagedBase.MapTolerance * diagonal);
    }

    /// <summary>One line for the log of the measurement.</summary>
    public override string ToString() => FormattableString.Invariant($"{Seconds:F2} s, {MapCount} maps, {Description}");
}
