namespace FractalEngine.Core.Bvh.Boxes;

/// <summary>Turns search radii into limits for squared distances.</summary>
internal static class DistanceCutoff
{
    /// <summary>The exclusive limit of squared distances for a search with an inclusive radius.</summary>
    /// <param name="maxDistance">Search radius in scene units, not negative; may be infinite.</param>
    /// <returns>
    /// A little more than the square, since squares and roots round. A search compares the distance itself with the radius in the end.
    /// </returns>
    public static double FromRadius(double maxDistance) => (maxDistance * maxDistance * (1 + 1e-15)) + double.Epsilon;
}
