using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Numbers of faces that no similarity changes: equal ones look alike with their surroundings.</summary>
/// <remarks>Weisfeiler–Lehman refinement over faces that share edges, with lengths of edges and of what stands across them.</remarks>
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
        var edges = new ulong[3 * faces.Count];
        for (var face = 0; face < labels.Length; face++)
        {
            var lengths = Enumerable.Range(3 * face, 3).Select(corner => Length(corner, FaceSet.After(corner))).ToArray();
            units[face] = isRelative ? lengths.Max() : 1;
            for (var side = 0; side < 3; side++)
            {
                edges[(3 * face) + side] = Step(lengths[side] / units[face]);
                labels[face] += HashMixing.Mix(edges[(3 * face) + side]);
            }
        }

        for (var round = 0; round < rounds; round++)
        {
            var next = new ulong[labels.Length];
            for (var corner = 0; corner < edges.Length; corner++)
            {
                for (var twin = faces.Twins[corner]; twin != corner; twin = faces.Twins[twin])
                {
                    var across = Length(FaceSet.After(FaceSet.After(corner)), FaceSet.After(FaceSet.After(twin)));
                    next[corner / 3] += HashMixing.Mix(
                        labels[twin / 3] + (edges[corner] * HashMixing.GoldenGamma) + HashMixing.Mix(Step(across / units[corner / 3])));
                }
            }

            labels = [.. labels.Zip(next, (label, around) => HashMixing.Mix(label + HashMixing.Mix(around)))];
        }

        return labels;

        double Length(int corner1, int corner2) => (faces.Points[faces.Corners[corner1]] - faces.Points[faces.Corners[corner2]]).Length();
    }

    private static ulong Step(double length) => length > 0 ? (ulong)(long)Math.Floor((StepsPerFactor * Math.Log(length)) + StepOffset) : 0;
}
