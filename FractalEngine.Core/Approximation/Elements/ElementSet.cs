using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Elements;

/// <summary>
/// The elements of a mesh, in classes of those that affine maps take to each other, and the question that all searches ask: which
/// element does a map take an element to?
/// </summary>
internal abstract class ElementSet
{
    /// <summary>The elements, each of them once.</summary>
    public Element[] Elements { get; protected init; } = [];

    /// <summary>Number of elements in the set.</summary>
    public int Count => Elements.Length;

    /// <summary>Sizes that differ by less than that part are equal, and maps are of which no entry differs by more.</summary>
    protected abstract double RelativeTolerance { get; }

    /// <summary>The maps of the first element of a class to itself, the identity among them.</summary>
    public abstract IReadOnlyList<AffineMap> SymmetriesOf(int elementClass);

    /// <summary>The first element of a class, from which placements start.</summary>
    public abstract Element FirstOf(int elementClass);

    /// <summary>Returns the element where a map puts the first element of a class, or −1.</summary>
    public abstract int Find(AffineMap placement, int elementClass);

    /// <summary>Returns the element that a map takes an element to, or −1.</summary>
    public int Match(AffineMap map, int element) => Find(map * Elements[element].Placement, Elements[element].Class);

    /// <summary>Returns all maps that take one element to another of its class.</summary>
    public abstract IEnumerable<AffineMap> MapsBetween(int from, int to);

    /// <summary>Fits a map that is known from an element, and perhaps one other, to more of them, where that is of use.</summary>
    public virtual AffineMap Fit(AffineMap map, int from) => map;

    /// <summary>Whether a map turns and stretches nothing.</summary>
    public bool IsTranslation(AffineMap map) => (map.Linear - Matrix.Identity).MaxAbsEntry() < RelativeTolerance;

    /// <summary>Whether an element is smaller than another one, by more than sizes may be off.</summary>
    public bool IsSmaller(int element, int other) =>
        Elements[element].Shape.Size < (1 - RelativeTolerance) * Elements[other].Shape.Size;
}
