using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Reference;

/// <content>The descent into several instances of each level.</content>
public sealed partial class FractalCollider
{
    // Differs from §4.4.3: the paper descends into one instance.
    private bool FindWithBeam(Vector position, double maxDistance, QueryContext context, out ClosestPoint closest)
    {
        var beam = context.DescentBeam;
        var testsBefore = context.Statistics.FaceTests;
        var baseTriangle = TestBaseWithoutLevels(position, context);
        beam.Begin(_beamWidth, new(AffineMap.Identity, position, 1, baseTriangle.DistanceSquared, baseTriangle.FaceIndex, -1));
        foreach (var (set, rounds) in _levels)
        {
            for (var round = 0; round < rounds; round++)
            {
                var hasChildren = false;
                for (var parent = 0; parent < beam.Entries.Count; parent++)
                {
                    hasChildren |= OfferChildren(beam, parent, set, round > 0, position, context);
                }

                RequireAllowedTests(context.Statistics.FaceTests - testsBefore);
                beam.AdvanceLevel(set, _hasOnlySimilarities);
                if (!hasChildren)
                {
                    break;
                }
            }
        }

        if (beam.Entries.Count == 0 || beam.Entries[0].ClosestFace < 0)
        {
            closest = default;
            return false;
        }

        beam.WritePath(context);
        closest = ClosestPointFactory.OnInstance(_baseMesh, beam.Entries[0].ClosestFace, beam.Entries[0].Map, position);
        return closest.Distance <= maxDistance;
    }

    /// <summary>Offers the children of an entry to the beam.</summary>
    /// <returns>False when the entry is too small for children, and is offered itself.</returns>
    private bool OfferChildren(DescentBeam beam, int parent, MapSet set, bool canTerminate, Vector position, QueryContext context)
    {
        var entry = beam.Entries[parent];
        if (canTerminate && BoundingSphere.OperatorNormBound(entry.Map.Linear) < MinScale)
        {
            beam.InsertIfCloser(entry.DistanceSquared, parent, -1, entry.ClosestFace);
            return false;
        }

        for (var childIndex = 0; childIndex < set.Maps.Length; childIndex++)
        {
            var closest = TestChild(
                set, childIndex, position, entry.LocalPosition, entry.Map, entry.ScaleSquared, beam.CutoffSquared, context);
            if (closest.FaceIndex >= 0)
            {
                beam.InsertIfCloser(closest.DistanceSquared, parent, childIndex, closest.FaceIndex);
            }
        }

        return true;
    }
}
