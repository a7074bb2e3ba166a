using FractalEngine.Core.Maths;


namespace FractalEngine.Core.Physics.Rigid;

/// <summary>Stops each body in a substep where it would come too close to another one, or to an object.</summary>
internal sealed class RigidSweep
{
    // Sweeps of what goes on where others have been stopped.
    private const int MaxRounds = 40;

    private readonly DisjointSets _islands = new();

    /// <summary>Stops what would come too close.</summary>
    public void StopBodies(RigidPairSet pairs, List<RigidSurface> surfaces)
    {
        pairs.FindImpacts();
        for (var round = 0; round < MaxRounds; round++)
        {
            // At first, those have stopped that come to where what they may meet is not known.
            var hasStopped = round == 0 && surfaces.Exists(static surface => surface.Fraction < 1);
            foreach (var pair in pairs.Pairs)
            {
                hasStopped |= pair.Impact < 1 && (pair.First.Stop(pair.Impact) | pair.Second.Stop(pair.Impact));
            }

            if (!hasStopped)
            {
                return;
            }

            pairs.FindLaterImpacts();
        }

        StopIslands(pairs, surfaces);
    }

    /// <summary>Stops all bodies that may meet, directly or through others, when the first one does: up to there all is free.</summary>
    private void StopIslands(RigidPairSet pairs, List<RigidSurface> surfaces)
    {
        _islands.Reset(surfaces.Count);
        foreach (var pair in pairs.Pairs)
        {
            if (pair.Second.Body is not null)
            {
                _islands.Join(pair.FirstIndex, pair.SecondIndex);
            }
        }

        for (var i = surfaces.Count - 1; i >= 0; i--)
        {
            _ = surfaces[_islands.RootOf(i)].Stop(surfaces[i].Fraction);
        }

        for (var i = 0; i < surfaces.Count; i++)
        {
            _ = surfaces[i].Stop(surfaces[_islands.RootOf(i)].Fraction);
        }
    }
}
