using FractalEngine.Core.Geometry.Rays;

namespace FractalEngine.Core.Queries;

/// <summary>Counts of the work that queries did, added up until they are reset.</summary>
public sealed class QueryStatistics
{
    /// <summary>Number of faces that were tested: the paper's collision cost (§5.2.3).</summary>
    /// <remarks>
    /// <c>BoundingBoxCollider</c> also counts twelve faces for each of eight boxes at every level, as the paper does.
    /// </remarks>
    public long FaceTests { get; set; }

    /// <summary>Number of bounding volumes that were tested.</summary>
    public long BoundTests { get; set; }

    /// <summary>Sets both counts to zero.</summary>
    public void Reset()
    {
        FaceTests = 0;
        BoundTests = 0;
    }

    /// <summary>Adds the counts of other queries.</summary>
    public void Add(QueryStatistics other)
    {
        FaceTests += other.FaceTests;
        BoundTests += other.BoundTests;
    }

    /// <summary>Adds the cost of a search along a ray.</summary>
    internal void Add(in RaySearch search)
    {
        FaceTests += search.FaceTests;
        BoundTests += search.BoundTests;
    }
}
