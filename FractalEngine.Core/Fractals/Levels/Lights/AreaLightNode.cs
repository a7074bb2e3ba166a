using FractalEngine.Core.Bvh.Splitting;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Lights;

/// <summary>
/// A node of the light hierarchy, in one frame: faces of a mesh, child instances of a sub-fractal, objects of a scene, or groups of these.
/// </summary>
internal sealed class AreaLightNode
{
    // Children of a node over faces or objects.
    private const int GroupSize = 16;

    // Cones as wide as that tell their parts hardly apart.
    private const double WideCosine = 0.1;
    private const double SameCosine = 1 - 1e-9;

    /// <summary>Makes a node of its parts.</summary>
    /// <param name="parts">Bounds of the parts, at least one, in the frame of the node.</param>
    /// <param name="items">For each part the index of the face, child or object.</param>
    /// <param name="groups">For each part the node of a group in the same frame, or null.</param>
    public AreaLightNode(AreaLightBounds[] parts, int[] items, AreaLightNode?[] groups)
    {
        (Parts, Items, Groups) = (parts, items, groups);
        Powers = Array.ConvertAll(parts, static part => part.Power);
        Total = AreaLightBounds.Union(parts);
        IsAlike = parts.All(part => Math.Max(part.Cosine, parts[0].Cosine) <= WideCosine || (part.Cosine == parts[0].Cosine
            && Math.Abs(Vector.Dot(part.Axis, parts[0].Axis)) > SameCosine));
        for (var i = 0; i < groups.Length; i++)
        {
            if (groups[i] is { } group)
            {
                (group.Parent, group.Slot) = (this, i);
            }
        }
    }

    /// <summary>Power, ball and cone of each part of the node.</summary>
    public AreaLightBounds[] Parts { get; }

    /// <summary>For each part the index of the face, child or object.</summary>
    public int[] Items { get; }

    /// <summary>For each part the node of a group in the same frame; null for others.</summary>
    public AreaLightNode?[] Groups { get; }

    /// <summary>The powers of the parts alone, for choices from far away.</summary>
    public double[] Powers { get; }

    /// <summary>Power, ball and cone of all parts of the node together.</summary>
    public AreaLightBounds Total { get; }

    /// <summary>True where the parts face about the same directions, so that from afar only their powers matter.</summary>
    public bool IsAlike { get; }

    /// <summary>The node whose part this is in the same frame; null for the outermost.</summary>
    public AreaLightNode? Parent { get; private set; }

    /// <summary>Index among the parts of the parent.</summary>
    public int Slot { get; private set; }

    /// <summary>Number of bytes of the arrays, those of groups included.</summary>
    public long StorageBytes => (92L * Parts.Length) + 240 + Groups.Sum(static group => group?.StorageBytes ?? 0);

    /// <summary>Groups many parts by their places.</summary>
    /// <param name="parts">Their bounds; those without power are left out.</param>
    /// <param name="places">Receives where each part stands, by its index.</param>
    /// <returns>Null where nothing shines.</returns>
    public static AreaLightNode? Build(AreaLightBounds[] parts, Dictionary<int, (AreaLightNode Node, int Slot)> places)
    {
        int[] shining = [.. Enumerable.Range(0, parts.Length).Where(i => parts[i].Power is > 0 and < double.PositiveInfinity)];
        var partition = new BoxPartition(Array.ConvertAll(shining, i => parts[i].Box));
        return shining.Length == 0 ? null : Create(0..shining.Length);

        AreaLightNode Create(Range range)
        {
            if (BoxPartition.CountOf(range) > GroupSize)
            {
                AreaLightNode[] groups = [.. partition.Split(range, GroupSize, GroupSize).Select(Create)];
                return new(Array.ConvertAll(groups, static group => group.Total), new int[groups.Length], groups);
            }

            int[] items = [.. partition.Order[range].ToArray().Select(i => shining[i])];
            var node = new AreaLightNode(Array.ConvertAll(items, i => parts[i]), items, new AreaLightNode?[items.Length]);
            for (var slot = 0; slot < items.Length; slot++)
            {
                places.Add(items[slot], (node, slot));
            }

            return node;
        }
    }
}
