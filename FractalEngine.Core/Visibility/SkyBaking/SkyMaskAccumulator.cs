using System.Numerics;
using FractalEngine.Core.Visibility.Sky;

namespace FractalEngine.Core.Visibility.SkyBaking;

/// <summary>Votes of points of one child about the directions that its siblings leave free, for each cell and side.</summary>
internal sealed class SkyMaskAccumulator
{
    // By place, which is a cell and a side, then by direction.
    private readonly int[] _votes = new int[SkyMasks.MaskCount * SkyDirections.Count];

    /// <summary>Adds the vote of a point. Several threads may do so at once, in any order.</summary>
    /// <param name="place">Index of its cell and side.</param>
    /// <param name="above">Directions above the surface, about which it votes.</param>
    /// <param name="free">Those of them that are free.</param>
    public void Add(int place, ulong above, ulong free)
    {
        for (var rest = above; rest != 0; rest &= rest - 1)
        {
            var direction = BitOperations.TrailingZeroCount(rest);
            Interlocked.Add(ref _votes[(place * SkyDirections.Count) + direction], ((free >> direction) & 1) != 0 ? 1 : -1);
        }
    }

    /// <summary>Decides each direction of each mask by its votes, or by those of the closest cell that has some.</summary>
    public ulong[] ToMasks()
    {
        var masks = new ulong[SkyMasks.MaskCount];
        bool[] hasVotes = [.. _votes.Chunk(SkyDirections.Count).Select(static votes => votes.AsSpan().ContainsAnyExcept(0))];
        bool[][] ofSides = [.. Enumerable.Range(0, AmbientCube.Count).Select(side => CellsOf(hasVotes, side, 1))];
        var ofAnySide = CellsOf(hasVotes, 0, AmbientCube.Count);
        for (var place = 0; place < masks.Length; place++)
        {
            var (cell, side) = (place / AmbientCube.Count, place % AmbientCube.Count);
            var sameSide = VotesAt(FindNearestCell(cell, ofSides[side]), side);
            // A side that no surface faces is blended with others, and sees about what they see.
            var nearestCell = FindNearestCell(cell, ofAnySide);
            for (var direction = 0; direction < SkyDirections.Count; direction++)
            {
                var sum = sameSide.IsEmpty ? 0 : sameSide[direction];
                for (var any = 0; sum == 0 && any < AmbientCube.Count && nearestCell >= 0; any++)
                {
                    sum = VotesAt(nearestCell, any)[direction];
                }

                masks[place] |= sum >= 0 ? 1ul << direction : 0;
            }
        }

        return masks;
    }

    private ReadOnlySpan<int> VotesAt(int cell, int side) =>
        cell < 0 ? [] : _votes.AsSpan(((cell * AmbientCube.Count) + side) * SkyDirections.Count, SkyDirections.Count);

    /// <summary>Tells which cells have votes of some sides.</summary>
    private static bool[] CellsOf(bool[] hasVotes, int firstSide, int sideCount) =>
        [.. Enumerable.Range(0, SkyMasks.CellCount)
            .Select(cell => hasVotes.AsSpan((cell * AmbientCube.Count) + firstSide, sideCount).Contains(true))];

    private static int FindNearestCell(int cell, bool[] isMeant)
    {
        var (nearest, nearestDistance) = (-1, int.MaxValue);
        for (var other = 0; other < isMeant.Length; other++)
        {
            if (isMeant[other] && SkyMasks.SquaredDistance(cell, other) is var distance && distance < nearestDistance)
            {
                (nearest, nearestDistance) = (other, distance);
            }
        }

        return nearest;
    }
}
