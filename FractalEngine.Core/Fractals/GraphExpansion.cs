using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// Expands a graph into one list of instances, from the whole down: each part, and each level of its recursives, is expanded once for all
/// maps that lead to it.
/// </summary>
internal sealed class GraphExpansion(FractalGraph graph, long maxInstances)
{
    // By parts: the maps that lead there, and whether there are instances at all.
    private readonly List<AffineMap>[] _maps =
        [.. Enumerable.Range(0, graph.BaseMeshes.Length + graph.Parts.Length).Select(static _ => new List<AffineMap>())];

    private readonly bool[] _hasInstances = new bool[graph.BaseMeshes.Length + graph.Parts.Length];
    private long _products;

    /// <summary>Expands a graph into its distinct instances, in the order of the base meshes; one without faces has none.</summary>
    /// <param name="graph">The graph, which must be finite.</param>
    /// <param name="maxInstances">Maximum number of distinct instances of a base mesh, and of maps to a state of the graph.</param>
    /// <exception cref="FractalLimitException">The graph has more instances, or takes too long to expand.</exception>
    /// <remarks>Instances are the same when their images of a base mesh differ by rounding only, see <see cref="DistinctMaps"/>.</remarks>
    public static ImmutableArray<MeshInstance> Expand(FractalGraph graph, long maxInstances) =>
        new GraphExpansion(graph, maxInstances).Expand();

    private ImmutableArray<MeshInstance> Expand()
    {
        if (graph.IsInfinite)
        {
            throw LimitError();
        }

        for (var i = 0; i < _maps.Length; i++)
        {
            _hasInstances[i] = i < graph.BaseMeshes.Length
                ? graph.BaseMeshes[i].FaceCount > 0
                : graph.Parts[i - graph.BaseMeshes.Length].EstimateInstances(part => new(_hasInstances[part] ? 1 : 0, 0)).Mantissa > 0;
        }

        Add(_maps.Length - 1, [AffineMap.Identity], AffineMap.Identity);
        for (var i = graph.Parts.Length - 1; i >= 0; i--)
        {
            var maps = _maps[graph.BaseMeshes.Length + i];
            switch (graph.Parts[i])
            {
                case SteppedPart part when maps.Count > 0:
                    ExpandSteps(part, Distinct(maps));
                    break;
                case RecursivePart part when maps.Count > 0:
                    ExpandRecursives(part, maps);
                    break;
            }

            // Of no more use, and perhaps large.
            _maps[graph.BaseMeshes.Length + i] = [];
        }

        return [.. graph.BaseMeshes.SelectMany((mesh, index) =>
        {
            var images = DistinctMaps.Images(mesh.UsedBounds, null, Math.Max(1, _maps[index].Count));
            return _maps[index].All(map => images.TryAdd(map, maxInstances))
                ? images.Items.ToArray().Select(map => new MeshInstance(index, map, Tint.None))
                : throw LimitError();
        })];
    }

    private void ExpandSteps(SteppedPart part, ReadOnlyMemory<AffineMap> maps)
    {
        for (var level = 0L; level < FractalSteps.LevelCount(part.Steps); level++)
        {
            var set = FractalSteps.LevelAt(part.Steps, level).Maps;
            if (set is not [var only] || only != AffineMap.Identity)
            {
                Charge(maps.Length * (long)set.Length);
                maps = Charged(DistinctMaps.Products(maps.Span, set.AsSpan(), null, maxInstances));
            }
        }

        Add(part.Inner, maps.Span, AffineMap.Identity);
    }

    private void ExpandRecursives(RecursivePart part, List<AffineMap> maps)
    {
        if (part.Levels == 0)
        {
            Add(part.Recursives[part.Root].BasePart, maps.ToArray(), AffineMap.Identity);
            return;
        }

        var hasInstances = part.Ascend(index => _hasInstances[index], false, static (any, one) => any || one)
            .Take(part.Levels!.Value + 1).Select(static values => (bool[])values.Clone()).ToArray();
        var turns = new List<AffineMap>[part.MaxLevelsLess + 1, part.Recursives.Length];
        ListOf(part.Levels.Value, part.Root).AddRange(maps);
        for (var levels = part.Levels.Value; levels > 0; levels--)
        {
            foreach (var caller in part.Order.Reverse())
            {
                var outer = ListOf(levels, caller);
                if (outer.Count == 0)
                {
                    continue;
                }

                var distinct = Distinct(outer).Span;
                foreach (var call in part.Recursives[caller].Calls)
                {
                    if (call.LevelsLess is not { } less)
                    {
                        Add(call.Target, distinct, call.Map);
                    }
                    else if (less >= levels)
                    {
                        Add(part.Recursives[call.Target].BasePart, distinct, call.Map);
                    }
                    else if (hasInstances[levels - less][call.Target])
                    {
                        AddProducts(ListOf(levels - less, call.Target), distinct, call.Map);
                    }
                }

                outer.Clear();
            }
        }

        List<AffineMap> ListOf(int levels, int recursive) => turns[levels % (part.MaxLevelsLess + 1), recursive] ??= [];
    }

    private void Add(int part, ReadOnlySpan<AffineMap> outer, AffineMap map)
    {
        if (_hasInstances[part])
        {
            AddProducts(_maps[part], outer, map);
        }
    }

    private void AddProducts(List<AffineMap> products, ReadOnlySpan<AffineMap> outer, AffineMap map)
    {
        Charge(outer.Length);
        foreach (var one in outer)
        {
            products.Add(map == AffineMap.Identity ? one : one * map);
        }
    }

    /// <summary>Removes maps that are the same for whatever comes after them.</summary>
    private ReadOnlyMemory<AffineMap> Distinct(List<AffineMap> maps) => maps.Count == 1
        ? maps.ToArray()
        : Charged(DistinctMaps.Products(maps.ToArray(), [AffineMap.Identity], null, maxInstances));

    private ReadOnlyMemory<AffineMap> Charged(DistinctList<AffineMap>? list)
    {
        Charge((list ?? throw LimitError()).ComparisonCost);
        return list.Items;
    }

    private void Charge(long products)
    {
        _products += products;
        if (_products > FractalLimits.ComparedProducts.Value + (8 * maxInstances))
        {
            throw LimitError();
        }
    }

    private FractalLimitException LimitError() => new(
        $"the fractal has more than the limit of {DecimalText.FormatApproximately(maxInstances)} instances");
}
