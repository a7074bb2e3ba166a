namespace FractalEngine.Core.Geometry.Rays;

/// <summary>The state of a search along a ray: what counts as a hit, the nearest one so far, and the cost.</summary>
/// <param name="minDistance">Smallest distance of a hit, but for rounding.</param>
/// <param name="maxDistance">Largest distance of a hit.</param>
/// <param name="stopsAtFirst">True to end at the first hit, whichever it is.</param>
/// <param name="error">Upper bound of how far rounding moves a point of the ray or of a target, in the frame of the query.</param>
/// <param name="footprint">What is smaller need not be told apart.</param>
internal struct RaySearch(double minDistance, double maxDistance, bool stopsAtFirst, double error, RayFootprint footprint)
{
    private readonly double _minDistance = minDistance;

    /// <summary>Smallest distance of a hit.</summary>
    public readonly double MinDistance = minDistance - error;

    /// <summary>Upper bound of how far rounding moves a point of the ray or of a target, in the frame of the query.</summary>
    public readonly double Error = error;

    /// <summary>True to end at the first hit, whichever it is.</summary>
    public readonly bool StopsAtFirst = stopsAtFirst;

    /// <summary>What is smaller need not be told apart.</summary>
    public readonly RayFootprint Footprint = footprint;

    /// <summary>The proxy that was hit last; null where it was a face of the fractal itself.</summary>
    public RayProxy? Proxy;

    /// <summary>Distance of the nearest hit so far, or the largest that counts.</summary>
    public double MaxDistance = maxDistance;

    /// <summary>Face index of the nearest hit; −1 for none.</summary>
    public int Face = -1;

    /// <summary>Index of the mesh of that face, where the shape has several.</summary>
    public int MeshIndex;

    /// <summary>Number of triangles that were tested.</summary>
    public long FaceTests;

    /// <summary>Number of bounding volumes that were tested.</summary>
    public long BoundTests;

    /// <summary>The search for a nearer hit with another rounding, without the cost so far.</summary>
    /// <param name="error">Upper bound of how far rounding moves a point of the ray or of a target, in the frame of the query.</param>
    /// <param name="footprint">Likewise.</param>
    public readonly RaySearch WithError(double error, RayFootprint footprint) =>
        new(_minDistance, MaxDistance, StopsAtFirst, error, footprint);

    /// <summary>Takes over the hit of a search with another rounding, but not its cost.</summary>
    public void Accept(in RaySearch other) =>
        (MaxDistance, Face, MeshIndex, Proxy) = (other.MaxDistance, other.Face, other.MeshIndex, other.Proxy);
}
