using System.Numerics;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Geometry.Triangles;

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
        // NaN never counts as closer. Lanes beyond the faces repeat the last one.
        distancesSquared = Vector256.ConditionalSelect(
            Vector256.Equals(distancesSquared, distancesSquared), distancesSquared, Vector256.Create(double.PositiveInfinity));
        var pair = Vector128.MinNative(distancesSquared.GetLower(), distancesSquared.GetUpper());
        var smallest = Vector128.MinNative(pair, Vector128.Shuffle(pair.AsInt64(), Vector128.Create(1L, 0)).AsDouble())[0];
        if (!(smallest <= DistanceSquared) || smallest == double.PositiveInfinity)
        {
            return;
        }

        var matches = Vector256.Equals(distancesSquared, Vector256.Create(smallest)).ExtractMostSignificantBits();
        var face = smallest < DistanceSquared ? int.MaxValue : FaceIndex;
        for (; matches != 0; matches &= matches - 1)
        {
            face = Math.Min(face, faces[Math.Min(BitOperations.TrailingZeroCount(matches), faces.Length - 1)]);
        }

        DistanceSquared = smallest;
        FaceIndex = face;
    }
}
