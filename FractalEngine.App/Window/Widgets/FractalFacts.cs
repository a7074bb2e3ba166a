using System.Globalization;
using System.Numerics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>What a panel tells about a fractal: its counts, size and dimension.</summary>
internal sealed class FractalFacts
{
    private FractalModel? _measured;
    private double? _dimension;
    private InstanceRange? _range;

    /// <summary>Adds a line for each: counts are exact up to fifteen digits.</summary>
    public void Build(UserInterface ui, FractalModel model)
    {
        if (!ReferenceEquals(model, _measured))
        {
            (_measured, _dimension) = (model, SimilarityDimension.Of(model.Fractal.Description));
            _range = model.Fractal.Description.HasChance ? model.Fractal.CountRange(DistinctInstances.MaxCountedPlaces) : null;
        }

        ui.Heading(model.Name);
        if (_range is { Exact: null } range)
        {
            ui.Fact("instances", $"{Count(range.Least)} to {Count(range.Most)}", $"by chance, about {Count(range.Expected)}");
        }
        else
        {
            ui.Fact("instances", Count(model.DistinctInstanceCount), $"distinct ones, of {Count(model.InstanceCount)} chains of maps");
        }

        ui.Fact("faces", Count(model.DistinctFaceCount));
        var size = model.Bounds.Size;
        ui.Fact("size", size.IsFinite()
            ? $"{PanelWidgets.Number(size.X)} × {PanelWidgets.Number(size.Y)} × {PanelWidgets.Number(size.Z)}" : "no bounds");
        ui.Fact(
            "dimension", _dimension is { } dimension ? PanelWidgets.Number(dimension) : "none",
            "similarity dimension s: the ratios r of all child instances have the sum of r^s = 1, as if the depth had no end");
        ui.Fact("composition", model.Fractal.Description.Composition.ToString().ToLowerInvariant());
    }

    private static string Count(BigInteger? count) => count is not { } number ? "infinite"
        : number < 1_000_000_000_000_000 ? number.ToString("N0", CultureInfo.InvariantCulture)
        : number.ToString("E3", CultureInfo.InvariantCulture);
}
