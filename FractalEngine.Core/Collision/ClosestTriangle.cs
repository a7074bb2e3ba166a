using System.Runtime.Intrinsics;

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

    /// <summary>
    /// Takes the closest of some triangles if it is closer than the one so far. Of equally close ones, the first in the mesh wins.
    /// </summary>
    /// <param name="distancesSquared">Squared distances of the triangles.</param>
    /// <param name="faces">Face indices of the triangles, one to four; lanes beyond them are ignored.</param>
    public void Update(Vector256<double> distancesSquared, ReadOnlySpan<int> faces)
    {
        for (var i = 0; i < faces.Length; i++)
        {
            if (distancesSquared[i] < DistanceSquared || (distancesSquared[i] == DistanceSquared && faces[i] < FaceIndex))
            {
                DistanceSquared = distancesSquared[i];
                FaceIndex = faces[i];
            }
        }
    }
}
