using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Core.Visibility.Sky;

namespace FractalEngine.Core.Visibility.SkyBaking;

/// <summary>Tests whether <see cref="SkyMasks"/> come closer to the truth than none.</summary>
internal static class SkyMaskTest
{
    // Lines of sight to points at which masks are compared with rays; and how much worse they may be from one side than none.
    private const int TestedLines = 300;
    private const double MaxLoss = 0.05;

    /// <summary>
    /// Compares the masks of a node with rays at some points of its surface: whether they tell more than that siblings hide nothing.
    /// </summary>
    /// <param name="occluder">Casts the rays.</param>
    /// <param name="hierarchy">Hierarchy of the node, with the masks that are tested.</param>
    /// <param name="node">A node with masks.</param>
    /// <param name="levels">Levels that it has left.</param>
    /// <param name="maxErrorRatio">How large errors may be, by those without masks.</param>
    public static bool IsUseful(SkyOccluder occluder, LodHierarchy hierarchy, LodNode node, long levels, double maxErrorRatio)
    {
        var random = new Random(0);
        var path = new SkyPath();
        var sample = new SkySample();
        Span<float> parts = stackalloc float[AmbientCube.Count];
        // By the side that the lines come from: what is right on the whole may be wrong on the one side that an image shows.
        Span<double> gains = stackalloc double[AmbientCube.Count];
        var (error, errorWithout) = (0.0, 0.0);
        for (var i = 0; i < TestedLines; i++)
        {
            if (occluder.TrySample(node, levels, random, sample))
            {
                var (free, _) = occluder.FreeDirections(node, levels, -1, sample.Point, SkyDirections.Above(sample.Normal));
                var truth = SkyDirections.VisiblePart(free, SimdAffineMap.ToVector256(sample.Normal));
                path.Set(sample.Steps);
                path.ComputeParts(hierarchy, sample.Leaf!, sample.Steps.Count, (ulong)i * HashMixing.GoldenGamma, VisibleSides.All, parts);
                var part = AmbientCube.Blend(parts, (sample.FromMesh.Linear.Transpose() * sample.Normal).UnitVector());
                // As far apart as the values of an image are.
                var (shown, shownTruth) = (Math.Sqrt(part), Math.Sqrt(truth));
                error += (shown - shownTruth) * (shown - shownTruth);
                errorWithout += (1 - shownTruth) * (1 - shownTruth);
                gains[AmbientCube.Of(SimdAffineMap.ToVector256(-sample.Direction))] +=
                    ((1 - shownTruth) * (1 - shownTruth)) - ((shown - shownTruth) * (shown - shownTruth));
            }
        }

        return error < maxErrorRatio * maxErrorRatio * errorWithout
            && !gains.ContainsAnyInRange(double.NegativeInfinity, -MaxLoss * errorWithout);
    }
}
