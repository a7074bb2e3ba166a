using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <content>The descent that goes on in several copies.</content>
public sealed partial class FractalCollider
{
    // Differs from §4.4.3: the paper goes on in one copy.
    private bool FindWithBeam(Vector position, double within, QueryRecord record, out ClosestPoint closest)
    {
        var (beam, face, squared, faceTests) = (record.Beam, -1, double.PositiveInfinity, 0L);
        if (_hasNoLevels)
        {
            _faces.LookAtAll(position, ref squared, ref face, ref faceTests);
        }

        beam.Begin(_width, new(AffineMap.Identity, position, 1, squared, face, -1));
        foreach (var (set, rounds) in _levels)
        {
            for (var round = 0; round < rounds; round++)
            {
                var goesOn = false;
                for (var parent = 0; parent < beam.Entries.Count; parent++)
                {
                    goesOn |= OfferCopies(beam, parent, set, round > 0, position, ref faceTests);
                }

                beam.Descend(set, _isSimilar);
                if (!goesOn)
                {
                    break;
                }
            }
        }

        record.FaceTests += faceTests;
        if (beam.Entries.Count == 0 || beam.Entries[0].Face < 0)
        {
            closest = default;
            return false;
        }

        beam.WritePath(record);
        closest = FaceAnswer.Of(_base, beam.Entries[0].Face, beam.Entries[0].Map, position);
        return closest.Distance <= within;
    }

    /// <summary>False when the copy is too small for copies of its own, and goes on as it is.</summary>
    private bool OfferCopies(DescentBeam beam, int parent, CopySet set, bool mayEnd, Vector position, ref long faceTests)
    {
        var entry = beam.Entries[parent];
        if (mayEnd && BoundingSphere.LengtheningBound(entry.Map.Linear) < Smallest)
        {
            beam.Offer(entry.Squared, parent, -1, entry.Face);
            return false;
        }

        for (var copy = 0; copy < set.Maps.Length; copy++)
        {
            var (nearest, face) = (beam.Limit, -1);
            if (_isSimilar)
            {
                var scale = entry.ScaleSquared * set.ScaleSquared[copy];
                nearest /= scale;
                _faces.LookAtAll(set.Inverses[copy] * entry.Local, ref nearest, ref face, ref faceTests);
                nearest *= scale;
            }
            else
            {
                _faces.LookAtAllImages(position, entry.Map * set.Maps[copy], ref nearest, ref face, ref faceTests);
            }

            if (face >= 0)
            {
                beam.Offer(nearest, parent, copy, face);
            }
        }

        return true;
    }
}
