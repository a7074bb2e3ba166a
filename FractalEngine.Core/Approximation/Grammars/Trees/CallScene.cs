using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>The parts among which calls of recursives are looked for: one class of elements, and what always stands beside them.</summary>
internal sealed class CallScene
{
    private const int MaxExamined = 6000;
    private const int MaxCompanions = 24;

    private readonly int[] _companions;
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
        _companions = FindCompanions();
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

    /// <summary>The maps that take the root, and what stands beside it, to itself, the identity first.</summary>
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

    /// <summary>The maps that take the root to a part, and what stands beside the root to what stands beside the part.</summary>
    public IEnumerable<AffineMap> FramesOf(int part) => Group.Set.MapsBetween(Root, part).Where(
        map => Array.TrueForAll(_companions, companion => Group.Image(map, companion) >= 0));

    /// <summary>Whether all calls of a recursive lead to parts, if it were called in a frame.</summary>
    public bool HasCalls(CallRule[] rules, int caller, AffineMap frame) =>
        Array.TrueForAll(rules, rule => rule.Caller != caller || Image(frame * rule.Map) >= 0);

    /// <summary>Marks the elements that are neither parts nor stand beside one.</summary>
    public bool[] FindOthers(CallExpansion expansion)
    {
        var isOther = new bool[Group.Set.Count];
        foreach (var member in Group.Members)
        {
            isOther[member] = !expansion.IsExplained[member];
        }

        foreach (var part in expansion.Parts)
        {
            foreach (var companion in _companions)
            {
                if (Group.Image(part.Frame, companion) is var image && image >= 0)
                {
                    isOther[image] = false;
                }
            }
        }

        return isOther;
    }

    /// <summary>Elements of other classes near the root, of which each part has an equal one.</summary>
    private int[] FindCompanions()
    {
        var elements = Group.Set.Elements;
        var (kind, centre) = (elements[Root].Class, elements[Root].Shape.Centroid);
        var frequent = Group.Members.GroupBy(member => elements[member].Class)
            .Where(members => members.Key != kind && members.Count() >= BySize.Length).Select(members => members.Key).ToHashSet();
        return [.. Group.Members.Where(member => frequent.Contains(elements[member].Class))
            .OrderBy(member => (elements[member].Shape.Centroid - centre).LengthSquared()).ThenBy(member => member).Take(MaxCompanions)
            .Where(member => Array.TrueForAll(
                BySize, part => Group.Set.MapsBetween(Root, part).Any(map => Group.Image(map, member) >= 0)))];
    }
}
