using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Cuts large islands into slabs with about as many bodies each. Contacts within a slab touch no body of another one, so that threads
/// can solve slabs at the same time; those across a cut come between. The cuts depend on the bodies alone, not on the threads.
/// </summary>
internal sealed class IslandParts
{
    /// <summary>Maximum number of parts that an island is cut into.</summary>
    public const int MaxCount = 8;

    // Smaller parts have too many of their contacts across a cut.
    private const int MinPairsOfPart = 800;

    // Cuts are found to so many places along the slabs.
    private const int BinCount = 256;

    private readonly int[] _bins = new int[BinCount];
    private readonly byte[] _partOfBin = new byte[BinCount];
    private byte[] _partOf = [];

    /// <summary>The part of a body of an island that has been cut.</summary>
    public int PartOf(int body) => _partOf[body];

    /// <summary>Number of parts of an island with so many pairs that touch or may meet.</summary>
    public static int CountFor(int pairCount) => Math.Clamp(pairCount / MinPairsOfPart, 1, MaxCount);

    /// <summary>The part of a pair; that behind the last one for a pair across a cut.</summary>
    public int PartOf(in BodyPair pair, int count) =>
        pair.IsSecondImmovable || _partOf[pair.First] == _partOf[pair.Second] ? _partOf[pair.First] : count;

    /// <summary>Makes room for the bodies of a world.</summary>
    public void Reserve(int bodyCount) => _partOf = new byte[bodyCount];

    /// <summary>Cuts an island across its longest side.</summary>
    /// <param name="island">Indices of its bodies, for which room must have been made.</param>
    /// <param name="count">Number of parts, at most <see cref="MaxCount"/>.</param>
    /// <param name="bodies">The bodies of the world.</param>
    public void Cut(ReadOnlySpan<int> island, int count, ReadOnlySpan<GraphBody> bodies)
    {
        var min = bodies[island[0]].Position;
        var max = min;
        foreach (var index in island)
        {
            min = Vector.Min(min, bodies[index].Position);
            max = Vector.Max(max, bodies[index].Position);
        }

        var extent = max - min;
        var axis = extent.X >= extent.Y && extent.X >= extent.Z ? Vector.I : extent.Z >= extent.Y ? Vector.K : Vector.J;
        var start = Vector.Dot(min, axis);
        var scale = BinCount / Vector.Dot(extent, axis);
        Array.Clear(_bins);
        foreach (var index in island)
        {
            _bins[BinOf(bodies[index].Position, axis, start, scale)]++;
        }

        var before = 0L;
        for (var bin = 0; bin < BinCount; bin++)
        {
            _partOfBin[bin] = (byte)(before * count / island.Length);
            before += _bins[bin];
        }

        foreach (var index in island)
        {
            _partOf[index] = _partOfBin[BinOf(bodies[index].Position, axis, start, scale)];
        }
    }

    private static int BinOf(Vector position, Vector axis, double start, double scale) =>
        (int)Math.Min(scale * (Vector.Dot(position, axis) - start), BinCount - 1);
}
