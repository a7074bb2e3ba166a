using System.Diagnostics;
using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Approximation;
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
/// <param name="ModelFaces">Faces of the mesh that was searched.</param>
/// <param name="Description">What the input is, and what was found.</param>
internal sealed record SearchOutcome(
    bool IsFound, bool IsWrong, double Seconds, int MapCount, int BaseFaces, int ModelFaces, string Description)
{
    // Largest difference of vertices, as a part of the diagonal, that the search allows itself.
    private const double ExactTolerance = 1e-6;
    private static readonly TimeSpan Limit = TimeSpan.FromSeconds(60);

    /// <summary>Searches, writes, reads back, expands and compares.</summary>
    public static SearchOutcome Measure(UnseenInput input)
    {
        using var limit = new CancellationTokenSource(Limit);
        var watch = Stopwatch.StartNew();
        MeshGrammar? grammar = null;
        try
        {
            grammar = GrammarSearch.FindExact(input.Mesh, limit.Token);
        }
        catch (OperationCanceledException)
        {
        }

        var seconds = watch.Elapsed.TotalSeconds;
        if (grammar is null)
        {
            return new(false, false, seconds, 0, 0, input.Mesh.FaceCount, $"nothing in {input.Description}");
        }

        var (maps, faces) = (grammar.MapCount, grammar.FaceCount);
        var diagonal = input.Clean.Bounds.Diagonal;
        Grade grade;
        try
        {
            grade = Grader.Compare(Expand(grammar, input.Mesh), input, ExactTolerance * diagonal);
        }
        catch (SourceException exception)
        {
            return new(false, true, seconds, maps, faces, input.Mesh.FaceCount,
                $"UNREADABLE {exception.Diagnostic.Message} in {input.Description}");
        }

        // A base that is most of the model explains little.
        var isSmall = faces <= 4 * input.BaseFaces && maps <= 4 * (input.Generators.Length + 8);
        var verdict = !grade.IsFound ? "WRONG" : isSmall ? "found" : "LARGE";
        var steps = string.Join(' ', grammar.Steps.Select(
            step => $"({string.Join('*', step.Sets.Select(set => set.Count))})^{step.Depth}"));
        return new(grade.IsFound && isSmall, !grade.IsFound, seconds, maps, faces, input.Mesh.FaceCount,
            $"{verdict} {steps} tree {grammar.Tree?.Maps.Count}^{grammar.Tree?.Depth} base {faces} in {input.Description}");
    }

    private static Mesh Expand(MeshGrammar grammar, Mesh mesh)
    {
        var folder = Directory.CreateTempSubdirectory("fractalengine");
        try
        {
            var path = Path.Combine(folder.FullName, "found.fdo");
            GrammarFile.Write(path, grammar, mesh.UsedBounds.Diagonal, []);
            return FractalFile.Read(path).Flatten(4L * mesh.FaceCount);
        }
        finally
        {
            folder.Delete(recursive: true);
        }
    }

    /// <summary>One line for the log of the measurement.</summary>
    public override string ToString() => FormattableString.Invariant($"{Seconds:F2} s, {MapCount} maps, {Description}");
}
