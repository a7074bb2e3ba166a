using FractalEngine.Tests.Oracles.Graphs.Expansion;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Looks for equal instances in what has no chance and no size in it, which are counted once.</summary>
internal static class PlainParts
{
    // Far more than rounding, so that no rounding decides.
    private const double Same = 1e-7;

    /// <summary>Whether a node, or a largest part of it that has neither, may have equal instances.</summary>
    public static bool HaveEqualInstances(ChanceNode node) => Visit(node, [], []);

    private static bool Visit(ChanceNode node, HashSet<ChanceNode> nodes, HashSet<ChanceGroup> groups)
    {
        if (node is ChanceNode.Call || !nodes.Add(node))
        {
            return false;
        }

        if (node.IsPlain)
        {
            try
            {
                return HasEqual([.. ChanceExpansion.Expand(node)]);
            }
            catch (UnclearModelException)
            {
                // A large one that does not stand anywhere.
                return true;
            }
        }

        return node switch
        {
            ChanceNode.Whole whole => Visit(whole.Inner, nodes, groups),
            ChanceNode.Mapped mapped => Visit(mapped.Inner, nodes, groups),
            ChanceNode.Sum sum => sum.Terms.Any(term => Visit(term, nodes, groups)),
            ChanceNode.Choice choice => choice.Alternatives.Any(one => Visit(one.Node, nodes, groups)),
            ChanceNode.Recursive recursive => groups.Add(recursive.Group)
                && recursive.Group.Bases.Concat(recursive.Group.Bodies).Any(part => Visit(part, nodes, groups)),
            _ => false,
        };
    }

    private static bool HasEqual(PlacedMesh[] instances)
    {
        var images = instances.Select(static instance => (
                instance.Mesh, Corners: instance.Mesh.Vertices.Select(instance.Map.Apply).ToArray()))
            .OrderBy(static image => image.Corners[0].X).ToArray();
        for (var i = 0; i < images.Length; i++)
        {
            var limit = Same * images[i].Corners.Max(TriangleSoup.Largest);
            for (var j = i + 1; j < images.Length && images[j].Corners[0].X <= images[i].Corners[0].X + limit; j++)
            {
                if (ReferenceEquals(images[i].Mesh, images[j].Mesh)
                    && images[i].Corners.Zip(images[j].Corners).All(pair => (pair.First - pair.Second).Length() <= limit))
                {
                    return true;
                }
            }
        }

        return false;
    }
}
