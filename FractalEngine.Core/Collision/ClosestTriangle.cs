namespace FractalEngine.Core.Collision;

/// <summary>The closest triangle that a search has found so far, and the cost of finding it.</summary>
/// <param name="distanceSquared">Limit of the search, exclusive: squared distances from here on are ignored.</param>
internal struct ClosestTriangle(double distanceSquared)
{
    /// <summary>Squared distance of the closest triangle, or the limit while there is none.</summary>
    public double DistanceSquared = distanceSquared;

    /// <summary>Face index of the closest triangle in its mesh; −1 for none.</summary>
    public int FaceIndex = -1;

    /// <summary>Number of triangles that were tested.</summary>
    public long FaceTests;

    /// <summary>Number of bounding volumes that were tested.</summary>
    public long BoundTests;
}
