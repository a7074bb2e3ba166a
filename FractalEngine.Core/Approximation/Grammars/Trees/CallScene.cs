using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>The parts among which calls of recursives are looked for: elements of one class.</summary>
internal sealed class CallScene
{
    private const int MaxExamined = 6000;

    private readonly double _smallest;

    /// <param name="group">All elements that are to be explained.</param>
    /// <param name="parts">Those of one class.</param>
    /// <param name="roots">Maps that take the largest part to each one that nothing calls.</param>
    public CallScene(ElementGroup group, IEnumerable<int> parts, IReadOnlyList<AffineMap> roots)
    {
        Group = group;
        Roots = roots;
        BySize = [.. parts.OrderByDescending(SizeOf).ThenBy(part => part)];
        _smallest = SizeOf(BySize[Math.Min(BySize.Length, MaxExamined) - 1]);
        Symmetries = [.. FramesOf(Root).OrderBy(map => (map.Linear - Matrix.Identity).MaxAbsEntry())];
    }

    /// <summary>All elements that are to be explained.</summary>
    public ElementGroup Group { get; }

    /// <summary>The parts by falling size.</summary>
    public int[] BySize { get; }

    /// <summary>The index of the largest element among the parts.</summary>
    public int Root => BySize[0];

    /// <summary>Maps that take the root to each part that nothing calls, the identity first.</summary>
    public IReadOnlyList<AffineMap> Roots { get; }

    /// <summary>The maps that take the root to itself, the identity first.</summary>
    public AffineMap[] Symmetries { get; }

    /// <summary>The root mean square of an element's extent.</summary>
    public double SizeOf(int element) => Group.Set.Elements[element].Shape.Size;

    /// <summary>Whether a part is one of those that are looked at before the others.</summary>
    public bool IsLarge(int part) => SizeOf(part) >= _smallest;

    /// <summary>How many look-ups there were so far.</summary>
    public long LookUps { get; private set; }

    /// <summary>The element of the group that a map takes the root to, or −1.</summary>
    public int Image(AffineMap frame)
    {
        LookUps++;
        return Group.Image(frame, Root);
    }

    /// <summary>The maps that take the root to a part.</summary>
    public IEnumerable<AffineMap> FramesOf(int part) => Group.Set.MapsBetween(Root, part);

    /// <summary>Whether all calls of a recursive lead to parts, if it were called in a frame.</summary>
    public bool HasCalls(CallRule[] rules, int caller, AffineMap frame) =>
        Array.TrueForAll(rules, rule => rule.Caller != caller || Image(frame * rule.Map) >= 0);
}
