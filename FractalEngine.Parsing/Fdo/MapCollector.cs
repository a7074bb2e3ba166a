using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Collects the maps of a set: as transformations while all are, else as affine maps.</summary>
/// <param name="capacity">Number of maps that are expected.</param>
internal sealed class MapCollector(int capacity)
{
    private readonly ImmutableArray<Transformation>.Builder _transformations = ImmutableArray.CreateBuilder<Transformation>(capacity);
    private ImmutableArray<AffineMap>.Builder? _maps;
    private ImmutableArray<MapColour>.Builder? _colours;

    /// <summary>Number of maps that were added, each power counted.</summary>
    public int Count => _maps?.Count ?? _transformations.Count;

    /// <summary>Adds one transformation, or what powers and products make of some.</summary>
    public void Add(in MapFactor factor)
    {
        if (factor.HasColours || _colours is not null)
        {
            _colours ??= ImmutableArray.CreateBuilder<MapColour>(Count + factor.Count);
            // Maps before the first one with a colour have none.
            while (_colours.Count < Count)
            {
                _colours.Add(default);
            }

            for (var i = 0; i < factor.Count; i++)
            {
                _colours.Add(factor.ColourOf(i));
            }
        }

        if (_maps is null && factor.Transformation is { } transformation)
        {
            _transformations.Add(transformation);
            return;
        }

        if (_maps is null)
        {
            _maps = ImmutableArray.CreateBuilder<AffineMap>(_transformations.Count + factor.Count);
            _maps.AddRange(_transformations.Select(static one => one.ToAffineMap()));
        }

        _maps.AddRange(factor.Maps);
    }

    /// <summary>Makes the set of what was collected, which ends the collection.</summary>
    public TransformationSet ToSet()
    {
        var colours = _colours?.DrainToImmutable() ?? [];
        return _maps is null ? new(_transformations.DrainToImmutable(), colours) : new(_maps.DrainToImmutable(), colours);
    }
}
