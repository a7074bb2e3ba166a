using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Numbers of faces that no similarity changes: equal ones look alike with their surroundings.</summary>
/// <remarks>Weisfeiler–Lehman refinement over faces that share edges, with lengths of edges and distances of neighbours.</remarks>
internal static class FaceLabels
{
    // Lengths are compared by their logarithm, in steps of a thousandth. A length at the end of a step costs a candidate at most.
    private const double StepsPerFactor = 1000;
    private const double StepOffset = 0.3719;

    /// <summary>Computes the label of each face.</summary>
    /// <param name="faces">The faces.</param>
    /// <param name="rounds">How many edges away a face still counts.</param>
    /// <param name="isRelative">Whether lengths count as parts of the face's longest edge, so that size does not matter.</param>
    public static ulong[] Compute(FaceSet faces, int rounds, bool isRelative)
    {
        var labels = new ulong[faces.Count];
        var units = new double[faces.Count];
        var edges = new ulong[faces.Corners.Length];
        Array.Fill(units, isRelative ? 0 : 1);
        for (var corner = 0; isRelative && corner < edges.Length; corner++)
        {
            units[faces.FaceAt[corner]] = Math.Max(units[faces.FaceAt[corner]], LengthAt(corner));
        }

        for (var corner = 0; corner < edges.Length; corner++)
        {
            edges[corner] = Step(LengthAt(corner) / units[faces.FaceAt[corner]]);
            labels[faces.FaceAt[corner]] += HashMixing.Mix(edges[corner]);
        }

        for (var round = 0; round < rounds; round++)
        {
            var next = new ulong[labels.Length];
            for (var corner = 0; corner < edges.Length; corner++)
            {
                var face = faces.FaceAt[corner];
                for (var twin = faces.Twins[corner]; twin != corner; twin = faces.Twins[twin])
                {
                    var across = (faces.Centroids[faces.FaceAt[twin]] - faces.Centroids[face]).Length() / units[face];
                    next[face] += HashMixing.Mix(
                        labels[faces.FaceAt[twin]] + (edges[corner] * HashMixing.GoldenGamma) + HashMixing.Mix(Step(across)));
                }
            }

            labels = [.. labels.Zip(next, (label, around) => HashMixing.Mix(label + HashMixing.Mix(around)))];
        }

        return labels;

        double LengthAt(int corner) => (faces.PointOf(corner) - faces.PointOf(faces.After(corner))).Length();
    }

    private static ulong Step(double length) => length > 0 ? (ulong)(long)Math.Floor((StepsPerFactor * Math.Log(length)) + StepOffset) : 0;
}
