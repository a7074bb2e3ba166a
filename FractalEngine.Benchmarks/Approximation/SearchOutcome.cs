using System.Diagnostics;
using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Approximation;
using FractalEngine.Core.Approximation.Damaged;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Benchmarks.Approximation;

/// <summary>What the search found in one mesh, measured on the files as they are read back.</summary>
/// <param name="IsFound">Whether it makes the undamaged model, and saves at least half of what the model repeats.</param>
/// <param name="IsWrong">Whether something was found that makes another model.</param>
/// <param name="Seconds">Time of the search alone.</param>
/// <param name="MapCount">Maps of all sets.</param>
/// <param name="BaseFaces">Faces of the base meshes.</param>
/// <param name="Description">What the input is, and what was found.</param>
internal sealed record SearchOutcome(bool IsFound, bool IsWrong, double Seconds, int MapCount, int BaseFaces, string Description)
{
    // Largest difference of vertices, as a part of the diagonal, that the search allows itself.
    private const double ExactTolerance = 1e-6;
    private static readonly TimeSpan Limit = TimeSpan.FromSeconds(60);

    /// <summary>Searches, writes, reads back, expands and compares.</summary>
    /// <param name="input">A model, damaged.</param>
    /// <param name="damage">What was done to it: whole ones are looked for exactly, others as damaged ones.</param>
    public static SearchOutcome Measure(UnseenInput input, Damage damage)
    {
        using var limit = new CancellationTokenSource(Limit);
        var watch = Stopwatch.StartNew();
        MeshGrammar? grammar = null;
        try
        {
            grammar = GrammarSearch.FindExact(input.Mesh, limit.Token);
            grammar ??= damage == Damage.None ? null : DamagedSearch.Find(input.Mesh, new(), limit.Token);
        }
        catch (OperationCanceledException)
        {
        }

        var seconds = watch.Elapsed.TotalSeconds;
        if (grammar is null)
        {
            return new(false, false, seconds, 0, 0, $"nothing in {input.Description}");
        }

        var maps = grammar.Steps.Sum(step => step.Sets.Sum(set => set.Count)) + (grammar.Tree?.Maps.Count ?? 0);
        var faces = grammar.Base.FaceCount + (grammar.Leaf?.FaceCount ?? 0);
        var diagonal = input.Clean.Bounds.Diagonal;
        Grade grade;
        try
        {
            var expansion = Expand(grammar, input);
            grade = damage.Kind is DamageKind.SplitEdges or DamageKind.Decimated
                ? Grader.CompareSurfaces(expansion, input, damage.Tolerance(input))
                : Grader.Compare(expansion, input, damage == Damage.None ? ExactTolerance * diagonal : damage.Tolerance(input));
        }
        catch (SourceException exception)
        {
            return new(false, true, seconds, maps, faces, $"UNREADABLE {exception.Diagnostic.Message} in {input.Description}");
        }

        // A base that is most of the model explains little.
        var isSmall = faces <= 4 * input.BaseFaces && maps <= 4 * (input.Generators.Length + 8);
        var verdict = !grade.IsFound ? "WRONG" : isSmall ? "found" : "LARGE";
        var steps = string.Join(' ', grammar.Steps.Select(
            step => $"({string.Join('*', step.Sets.Select(set => set.Count))})^{step.Depth}"));
        return new(grade.IsFound && isSmall, !grade.IsFound, seconds, maps, faces,
            $"{verdict} {steps} tree {grammar.Tree?.Maps.Count}^{grammar.Tree?.Depth} base {faces} in {input.Description}");
    }

    private static Mesh Expand(MeshGrammar grammar, UnseenInput input)
    {
        var folder = Directory.CreateTempSubdirectory("fractalengine");
        try
        {
            var path = Path.Combine(folder.FullName, "found.fdo");
            GrammarFile.Write(path, grammar, input.Mesh.UsedBounds.Diagonal, []);
            return FractalFile.Read(path).Flatten(4L * Math.Max(input.Mesh.FaceCount, input.Clean.FaceCount));
        }
        finally
        {
            folder.Delete(recursive: true);
        }
    }

    /// <summary>One line for the log of the measurement.</summary>
    public override string ToString() => FormattableString.Invariant($"{Seconds:F2} s, {MapCount} maps, {Description}");
}
