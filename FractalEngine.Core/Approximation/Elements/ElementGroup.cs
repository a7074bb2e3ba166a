using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Elements;

/// <summary>Some elements of a set, within which maps are looked at.</summary>
internal sealed class ElementGroup
{
    private readonly bool[] _contains;

    /// <param name="set">All elements.</param>
    /// <param name="members">Indices of those that belong to the group.</param>
    public ElementGroup(ElementSet set, int[] members)
    {
        Set = set;
        Members = members;
        _contains = new bool[set.Count];
        foreach (var member in members)
        {
            _contains[member] = true;
        }
    }

    /// <summary>All elements, also those outside of the group.</summary>
    public ElementSet Set { get; }

    /// <summary>Indices of the elements of the group.</summary>
    public int[] Members { get; }

    /// <summary>Returns the element of the group that a map takes an element to, or −1.</summary>
    public int Image(AffineMap map, int element) => Set.Match(map, element) is var image && image >= 0 && _contains[image] ? image : -1;

    /// <summary>Whether a map takes all elements of the group to elements of the group.</summary>
    public bool IsClosedUnder(AffineMap map) => Array.TrueForAll(Members, member => Image(map, member) >= 0);
}
