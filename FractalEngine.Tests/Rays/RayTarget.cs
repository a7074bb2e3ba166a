using FractalEngine.Tests.Queries.Regions;

namespace FractalEngine.Tests.Rays;

/// <summary>What a ray is aimed at: a face, or two faces with a common edge, of which it may hit either.</summary>
/// <param name="Face">The face. A common edge is that from its first corner to its second.</param>
/// <param name="Neighbour">The other face, with the same first two corners; null for a face alone.</param>
internal readonly record struct RayTarget(ExpandedTriangle Face, ExpandedTriangle? Neighbour)
{
    /// <summary>Finds the distance within which a ray must hit; null where it passes too near the rim for that, or beside it.</summary>
    /// <param name="ray">The ray in exact arithmetic.</param>
    /// <param name="projected">The same ray.</param>
    /// <param name="reach">The largest absolute coordinate of the shape and the ray, which rounding is measured against.</param>
    public double? FindCertainDistance(ExactRay ray, in ProjectedRay projected, double reach)
    {
        var margin = ProjectedRay.DistanceError * reach;
        var (a, b, c) = (Face.A, Face.B, Face.C);
        // In one orientation, the ray passes all edges of what it hits on the left.
        var turn = Math.Sign(ray.Apart(a, b, c));
        var isInside = turn * ray.Side(b, c) > margin && turn * ray.Side(c, a) > margin;
        if (Neighbour is not { C: var d } neighbour)
        {
            return isInside && turn * ray.Side(a, b) > margin
                ? ray.Distance(a, b, c) + projected.DistanceTolerance(Face, reach)
                : null;
        }

        // Where both faces are on one side of the edge, it is a rim.
        if (!(isInside && turn * ray.Side(d, b) > margin && turn * ray.Side(a, d) > margin
            && turn * ray.Apart(a, b, c) > margin && turn * ray.Apart(b, a, d) > margin))
        {
            return null;
        }

        var distance = turn * ray.Side(a, b) >= 0 ? ray.Distance(a, b, c) : ray.Distance(a, b, d);
        return distance + Math.Max(projected.DistanceTolerance(Face, reach), projected.DistanceTolerance(in neighbour, reach));
    }
}
