using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// The sub-fractals of finite fractals, each once, as a graph without mirrors: what a map mirrors is an instance of another node, its
/// mirror image. So it grows with the levels and maps, not with the instances.
/// </summary>
/// <param name="fractal">A finite fractal in affine composition.</param>
/// <param name="maxNodes">Maximum number of nodes.</param>
public sealed class LevelGraph(Fractal fractal, int maxNodes)
{
    private readonly FractalHierarchy _hierarchy = Require(fractal).Hierarchy;
    private readonly Dictionary<(LevelState State, bool IsMirrored), int> _indices = [];
    private readonly List<LevelNode> _nodes = [];

    /// <summary>The mirror that twins are images under: z becomes −z.</summary>
    public static AffineMap Mirror { get; } = new(Matrix.Diagonal(new(1, 1, -1)), Vector.Zero);

    /// <summary>The nodes, each behind those that it consists of.</summary>
    public IReadOnlyList<LevelNode> Nodes => _nodes;

    /// <summary>Splits a map into one that does not mirror, and a mirror before it.</summary>
    /// <returns>The map from the frame of the node, mirrored or not, and which of the two.</returns>
    public static (AffineMap Map, bool IsMirrored) Split(AffineMap map) =>
        map.Linear.Determinant() < 0 ? (map * Mirror, true) : (map, false);

    /// <summary>Adds the whole fractal, or its mirror image, with all that it consists of.</summary>
    /// <returns>The index of its node; null where it has no faces.</returns>
    /// <exception cref="FractalLimitException">There are more nodes than allowed, or bounds don't converge.</exception>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    public int? Add(bool isMirrored)
    {
        // A stack of its own: there may be a million levels.
        var root = (_hierarchy.Start, isMirrored);
        var open = new Stack<(LevelState State, bool IsMirrored)>([root]);
        while (open.TryPeek(out var place))
        {
            var missing = _indices.ContainsKey(place) ? [] : ChildrenOf(place)
                .Select(static child => child.Place).Where(child => !_indices.ContainsKey(child)).ToArray();
            Array.ForEach(missing, open.Push);
            if (missing.Length == 0 && _indices.TryAdd(open.Pop(), _nodes.Count))
            {
                var level = _hierarchy.AllLevels.At(place.State.Level);
                _nodes.Add(new(
                    _hierarchy.IsBase(place.State.Level) ? level.BaseIndex : null, place.IsMirrored,
                    [.. ChildrenOf(place).Select(child => (_indices[child.Place], child.Map))]));
            }

            if (_nodes.Count > maxNodes || open.Count > (long)maxNodes * SubFractal.MaxUngroupedChildren)
            {
                throw new FractalLimitException($"the fractal has more than the limit of {maxNodes} different parts");
            }
        }

        return _hierarchy.AllLevels.At(_hierarchy.Start.Level).Box.IsEmpty ? null : _indices[root];
    }

    private static Fractal Require(Fractal fractal)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        ArgumentCheck.Require(
            fractal.Description is { IsInfinite: false, Composition: Composition.Affine },
            "expected a finite fractal in affine composition", nameof(fractal));
        return fractal;
    }

    private IEnumerable<((LevelState State, bool IsMirrored) Place, AffineMap Map)> ChildrenOf((LevelState State, bool IsMirrored) place)
    {
        foreach (var edge in _hierarchy.AllLevels.At(place.State.Level).Edges)
        {
            var state = _hierarchy.Resolve(edge.Enter(place.State));
            if (!_hierarchy.AllLevels.At(state.Level).Box.IsEmpty)
            {
                var (map, isMirrored) = Split(place.IsMirrored ? Mirror * edge.Map : edge.Map);
                yield return ((state, isMirrored), map);
            }
        }
    }
}
