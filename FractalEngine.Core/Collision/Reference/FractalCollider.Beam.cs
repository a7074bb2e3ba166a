using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Reference;

/// <content>The descent that goes on in several copies.</content>
public sealed partial class FractalCollider
{
    // Differs from §4.4.3: the paper goes on in one copy.
    private bool FindWithBeam(Vector position, double maxDistance, QueryContext context, out ClosestPoint closest)
    {
        var (beam, closestFace, distanceSquared, faceTests) = (context.DescentBeam, -1, double.PositiveInfinity, 0L);
        if (_hasNoLevels)
        {
            _baseBvh.TestAllTriangles(position, ref distanceSquared, ref closestFace, ref faceTests);
        }

        beam.Begin(_beamWidth, new(AffineMap.Identity, position, 1, distanceSquared, closestFace, -1));
        foreach (var (set, rounds) in _levels)
        {
            for (var round = 0; round < rounds; round++)
            {
                var hasChildren = false;
                for (var parent = 0; parent < beam.Entries.Count; parent++)
                {
                    hasChildren |= OfferChildren(beam, parent, set, round > 0, position, ref faceTests);
                }

                beam.AdvanceLevel(set, _hasOnlySimilarities);
                if (!hasChildren)
                {
                    break;
                }
            }
        }

        context.FaceTests += faceTests;
        if (beam.Entries.Count == 0 || beam.Entries[0].ClosestFace < 0)
        {
            closest = default;
            return false;
        }

        beam.WritePath(context);
        closest = ClosestPointFactory.Create(_baseMesh, beam.Entries[0].ClosestFace, beam.Entries[0].Map, position);
        return closest.Distance <= maxDistance;
    }

    /// <summary>False when the copy is too small for copies of its own, and goes on as it is.</summary>
    private bool OfferChildren(DescentBeam beam, int parent, MapSet set, bool canTerminate, Vector position, ref long faceTests)
    {
        var entry = beam.Entries[parent];
        if (canTerminate && BoundingSphere.OperatorNormBound(entry.Map.Linear) < MinScale)
        {
            beam.InsertIfCloser(entry.DistanceSquared, parent, -1, entry.ClosestFace);
            return false;
        }

        for (var childIndex = 0; childIndex < set.Maps.Length; childIndex++)
        {
            var (distanceSquared, closestFace) = (beam.CutoffSquared, -1);
            if (_hasOnlySimilarities)
            {
                var scaleSquared = entry.ScaleSquared * set.ScalesSquared[childIndex];
                distanceSquared /= scaleSquared;
                _baseBvh.TestAllTriangles(set.Inverses[childIndex] * entry.LocalPosition, ref distanceSquared, ref closestFace,
                    ref faceTests);
                distanceSquared *= scaleSquared;
            }
            else
            {
                _baseBvh.TestAllTransformedTriangles(position, entry.Map * set.Maps[childIndex], ref distanceSquared, ref closestFace,
                    ref faceTests);
            }

            if (closestFace >= 0)
            {
                beam.InsertIfCloser(distanceSquared, parent, childIndex, closestFace);
            }
        }

        return true;
    }
}
