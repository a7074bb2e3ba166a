namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>How the expansion of a file that a search has written compares with the undamaged model.</summary>
/// <param name="CleanToExpansion">The largest distance of a vertex of the undamaged model to the expansion, in its diagonals.</param>
/// <param name="ExpansionToClean">The largest distance of a vertex of the expansion to the undamaged model, in its diagonals.</param>
/// <param name="DistanceInElements">The larger of both distances, in diagonals of the smallest element.</param>
/// <param name="FoundElements">How many elements have all of their vertices within the tolerance of the expansion.</param>
/// <param name="Recall">The share of elements that are found, from 0 to 1.</param>
/// <param name="Precision">The share of vertices of the expansion within the tolerance of the undamaged model, from 0 to 1.</param>
internal sealed record Grade(
    double CleanToExpansion,
    double ExpansionToClean,
    double DistanceInElements,
    int FoundElements,
    double Recall,
    double Precision)
{
    /// <summary>The larger of both largest distances, in diagonals of the undamaged model: a Hausdorff distance.</summary>
    public double LargestDistance => Math.Max(CleanToExpansion, ExpansionToClean);

    /// <summary>Whether the expansion equals the undamaged model within the tolerance: nothing is missing or foreign.</summary>
    public bool IsFound => Recall == 1 && Precision == 1;
}
