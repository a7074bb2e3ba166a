using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Lights;

/// <summary>
/// The emissive faces of a mesh, or of a fractal of any depth: one node for each level, which bounds its children by their levels. So the
/// light hierarchy of 10²⁰ lamps takes kilobytes.
/// </summary>
/// <remarks>
/// Power, ball and cone of a level follow from those of the levels below. Where chance or size decides what stands at a place, a level has
/// the mean power of its alternatives; a walk may then end where nothing shines. Recursive, so for no more than some thousand levels.
/// </remarks>
internal sealed class AreaLightModel
{
    // The recursion takes some of the stack for each.
    private const int MaxLevels = 2000;

    private readonly FractalHierarchy? _hierarchy;
    private readonly Mesh[] _meshes;
    private readonly bool _isUniform;
    private readonly Dictionary<long, AreaLightNode?> _nodes = [];
    private readonly Dictionary<int, (AreaLightNode Node, int Slot)>[] _places;

    /// <summary>Prepares the emissive faces of a shape.</summary>
    /// <param name="hierarchy">The levels of a fractal; null for a mesh. Beyond some thousand levels there are no nodes.</param>
    /// <param name="meshes">The base meshes, or the mesh.</param>
    /// <param name="radianceOf">The radiance of a face, by the indices of its mesh and of itself; 0 for most.</param>
    /// <param name="isUniform">True to count each face the same.</param>
    public AreaLightModel(FractalHierarchy? hierarchy, Mesh[] meshes, Func<int, int, double> radianceOf, bool isUniform)
    {
        (_hierarchy, _meshes, _isUniform) = (hierarchy, meshes, isUniform);
        _places = Array.ConvertAll(meshes, static _ => new Dictionary<int, (AreaLightNode, int)>());
        for (var mesh = 0; mesh < meshes.Length; mesh++)
        {
            _nodes.Add(mesh, AreaLightNode.Build([.. Enumerable.Range(0, meshes[mesh].FaceCount).Select(face =>
                radianceOf(mesh, face) is > 0 and var radiance
                    ? AreaLightBounds.Of(meshes[mesh].Face(face), isUniform ? null : radiance)
                    : default)], _places[mesh]));
        }

        Root = hierarchy is null ? _nodes[0] : hierarchy.Levels <= MaxLevels && _nodes.Values.Any(static node => node is not null)
            ? NodeAt(hierarchy.Levels)
            : null;
    }

    /// <summary>The node of the whole; null where nothing shines, or the levels are too many.</summary>
    public AreaLightNode? Root { get; }

    /// <summary>Number of bytes of all nodes.</summary>
    public long StorageBytes => _nodes.Values.Sum(static node => node?.StorageBytes ?? 0)
        + _places.Sum(static places => 32L * places.Count);

    /// <summary>Walks from the whole to a face.</summary>
    /// <param name="walk">In the frame of the model; receives the probability.</param>
    /// <param name="chosen">Receives the indices of child instances to a face that is chosen; null to follow one that is known.</param>
    /// <param name="known">The indices of child instances to that one.</param>
    /// <param name="face">Its index, or receives that of the face that is chosen.</param>
    /// <param name="triangle">Receives its corners in world space.</param>
    /// <returns>False where the walk ends at no face, or can't lead to this one.</returns>
    public bool TryWalk(
        ref AreaLightWalk walk, List<int>? chosen, ReadOnlySpan<int> known, ref int face, out (Vector A, Vector B, Vector C) triangle)
    {
        triangle = default;
        chosen?.Clear();
        var (state, subFractal, node) = (_hierarchy?.Start ?? default, _hierarchy?.Root, Root);
        for (var depth = 0; _hierarchy?.IsBase(state.Level) == false; depth++)
        {
            var slot = node is null ? -1
                : chosen is not null ? walk.Choose(node)
                : depth < known.Length ? Array.IndexOf(node.Items, known[depth])
                : -1;
            if (slot < 0)
            {
                return false;
            }

            if (chosen is null)
            {
                walk.Follow(node!, slot);
            }

            chosen?.Add(node!.Items[slot]);

            var child = subFractal!.Children[node!.Items[slot]];
            state = _hierarchy!.Enter(child, in state);
            subFractal = _hierarchy.At(child, state.Level);
            node = node.Groups[slot] ?? _nodes.GetValueOrDefault(state.Level);
            if (child.Group is null)
            {
                walk.Enter(in child.Map, child.OperatorNormBound, node);
            }
        }

        var mesh = subFractal?.BaseIndex ?? 0;
        var place = default((AreaLightNode, int));
        if (node is null || (chosen is null && !_places[mesh].TryGetValue(face, out place)))
        {
            return false;
        }

        if (chosen is null)
        {
            FollowItem(ref walk, place);
        }

        face = chosen is null ? face : ChooseItem(ref walk, node);
        triangle = walk.ToWorld(_meshes[mesh].Face(face));
        return walk.Probability > 0;
    }

    /// <summary>Chooses a face or an object below a node of them.</summary>
    /// <param name="walk">In the frame of the node.</param>
    /// <param name="node">The outermost node.</param>
    public static int ChooseItem(ref AreaLightWalk walk, AreaLightNode node)
    {
        var slot = walk.Choose(node);
        while (node.Groups[slot] is { } group)
        {
            node = group;
            slot = walk.Choose(node);
        }

        return node.Items[slot];
    }

    /// <summary>Follows the groups of faces or objects to one of them, from within, which is the same.</summary>
    /// <param name="walk">In the frame of the nodes.</param>
    /// <param name="place">Where the face or object stands.</param>
    public static void FollowItem(ref AreaLightWalk walk, (AreaLightNode Node, int Slot) place)
    {
        for (var (node, slot) = place; node is not null; (slot, node) = (node.Slot, node.Parent))
        {
            walk.Follow(node, slot);
        }
    }

    private AreaLightNode? NodeAt(long level) => _nodes.TryGetValue(level, out var known) ? known
        : _nodes[level] = _hierarchy!.MapSetAt(level)?.Pick is { } pick ? CreateMean(pick, level)
        : _hierarchy.FindOrNull(level) is { } subFractal ? Create(subFractal, level)
        : null;

    private AreaLightNode? Create(SubFractal subFractal, long level)
    {
        var (parts, items, groups) = (new List<AreaLightBounds>(), new List<int>(), new List<AreaLightNode?>());
        for (var i = 0; i < subFractal.Children.Length; i++)
        {
            var child = subFractal.Children[i];
            var group = child.Group is null ? null : Create(child.Group, level);
            if (!subFractal.IsChildEmpty(i) && (group ?? NodeAt(child.RemainingLevels(level))) is { Total: var total })
            {
                parts.Add(child.Group is null
                    ? total.Transform(child.Map, child.OperatorNormBound, _isUniform).Within(subFractal.ChildBox(i))
                    : total);
                items.Add(i);
                groups.Add(group);
            }
        }

        return parts.Count > 0 ? new([.. parts], [.. items], [.. groups]) : null;
    }

    /// <summary>Bounds all alternatives that may stand at a place, with the mean of their powers. No walk enters the node.</summary>
    private AreaLightNode? CreateMean(LevelPick pick, long level)
    {
        AreaLightBounds[] parts = [.. _hierarchy!.AllLevels.At(level).Edges.Index()
            .Select(edge => (Share: pick.ShareOf(level, edge.Index), Node: NodeAt(edge.Item.RemainingLevels(level))))
            .Where(static one => one is { Share: > 0, Node: not null })
            .Select(static one => one.Node!.Total with { Power = one.Share * one.Node.Total.Power })];
        return parts.Length > 0 ? new(parts, new int[parts.Length], new AreaLightNode?[parts.Length]) : null;
    }
}
