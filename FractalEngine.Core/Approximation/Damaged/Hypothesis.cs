using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>Sets of maps whose products are applied to some base elements.</summary>
/// <param name="Sets">
/// Of a product of sets those, outermost first, each with the identity first. Of a tree only one, without the identity.
/// </param>
/// <param name="Depth">Of a tree the largest number of maps in a product; 0 for a product of sets.</param>
/// <param name="Bases">Class and placement of the base elements; possibly none yet.</param>
internal sealed record Hypothesis(
    List<List<AffineMap>> Sets, int Depth, List<(int Class, AffineMap Placement)> Bases)
{
    /// <summary>Number of maps, identities not counted.</summary>
    public int MapCount => Sets.Sum(set => set.Count) - (Depth > 0 ? 0 : Sets.Count);

    /// <summary>Returns all products, each with the sets' maps that it is made of.</summary>
    public List<(AffineMap Map, int[] Letters)> Words()
    {
        var words = new List<(AffineMap, int[])> { (AffineMap.Identity, []) };
        if (Depth == 0)
        {
            foreach (var set in Sets)
            {
                words = [.. words.SelectMany(word => set.Select((map, letter) => (word.Item1 * map, (int[])[.. word.Item2, letter])))];
            }

            return words;
        }

        var first = 0;
        for (var level = 0; level < Depth; level++)
        {
            var end = words.Count;
            for (; first < end; first++)
            {
                // Letters are added in front, so that those behind are a word of the level before.
                var (map, letters) = words[first];
                words.AddRange(Sets[0].Select((outer, letter) => (outer * map, (int[])[letter, .. letters])));
            }
        }

        return words;
    }
}
