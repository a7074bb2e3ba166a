using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>
/// The elements of a damaged mesh as the set that exact searches work on: maps are fitted to many elements, and then exact enough.
/// </summary>
internal sealed class NoisyElements : ElementSet
{
    private const double MaxRelativeTolerance = 0.05;

    private readonly DamagedModel _model;
    private readonly CancellationToken _cancellation;
    private readonly PlacementIndex _index;
    private readonly MapGrowth _growth;
    private (int From, int[] Order) _neighbours = (-1, []);

    /// <param name="model">The elements in their classes.</param>
    /// <param name="tolerance">How far an element may be off, in units of its size.</param>
    /// <param name="cancellation">Ends the work early.</param>
    public NoisyElements(DamagedModel model, double tolerance, CancellationToken cancellation)
    {
        _model = model;
        _cancellation = cancellation;
        _index = model.CreateFullIndex(tolerance);
        _growth = new(model, _index);
        Elements = [.. model.Elements.Select(element => ElementOf(element.Class, element.Placement))];
        RelativeTolerance = Math.Min(MaxRelativeTolerance, 4 * model.Noise / PlacedElement.SizeOf(model.Elements[^1].Placement));
    }

    /// <inheritdoc/>
    protected override double RelativeTolerance { get; }

    /// <inheritdoc/>
    public override IReadOnlyList<AffineMap> SymmetriesOf(int elementClass)
    {
        var largest = _model.Elements.Find(element => element.Class == elementClass)!;
        return [.. SymmetriesAt(elementClass, PlacedElement.SizeOf(largest.Placement))];
    }

    /// <inheritdoc/>
    public override Element FirstOf(int elementClass) => ElementOf(elementClass, AffineMap.Identity);

    /// <inheritdoc/>
    public override int Find(AffineMap placement, int elementClass) => _index.Find(elementClass, placement);

    /// <inheritdoc/>
    public override IEnumerable<AffineMap> MapsBetween(int from, int to)
    {
        var (start, end) = (_model.Elements[from].Placement, _model.Elements[to].Placement);
        var back = start.Inverse();
        return SymmetriesAt(_model.Elements[from].Class, Math.Min(PlacedElement.SizeOf(start), PlacedElement.SizeOf(end)))
            .Select(symmetry => end * symmetry * back)
            .Select(map => (Map: map, Fitted: Fit(map, from))).OrderBy(pair => pair.Map == pair.Fitted).Select(pair => pair.Fitted);
    }

    /// <inheritdoc/>
    public override AffineMap Fit(AffineMap map, int from)
    {
        _cancellation.ThrowIfCancellationRequested();
        if (_neighbours.From != from)
        {
            _neighbours = (from, _growth.NeighboursOf(from));
        }

        return _growth.Extend(map, _neighbours.Order) is { } grown && Match(grown, from) == Match(map, from) ? grown : map;
    }

    private IEnumerable<AffineMap> SymmetriesAt(int elementClass, double size)
    {
        var template = _model.Templates[elementClass];
        return template.Symmetries.Take(template.CountSymmetries(size)).Select(symmetry => new AffineMap(symmetry.Map, Vector.Zero));
    }

    private Element ElementOf(int elementClass, AffineMap placement)
    {
        var template = _model.Templates[elementClass];
        return new(ElementShape.Create([.. template.Vertices.Select(vertex => placement * vertex)])!, template.Corners)
        {
            Class = elementClass,
            Placement = placement,
        };
    }
}
