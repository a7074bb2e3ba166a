using FractalEngine.App.Window.Actions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>The gradient of an object in the scene's panel: what it goes by, and its palette or its other colour.</summary>
internal sealed class GradientFields(WindowActions actions)
{
    private static readonly GradientKind[] Kinds = Enum.GetValues<GradientKind>();

    private bool _isOpen;

    /// <summary>Adds the fields of an object.</summary>
    /// <param name="ui">Receives them.</param>
    /// <param name="declared">The object.</param>
    /// <param name="index">Its index in the scene.</param>
    public void Build(UserInterface ui, SceneObject declared, int index)
    {
        if (!ui.Branch("Gradient", ref _isOpen))
        {
            return;
        }

        var gradient = declared.Gradient;
        ui.Row(1, 1, 1);
        foreach (var kind in Kinds)
        {
            if (ui.Selectable(kind.ToString().ToLowerInvariant(), kind == (gradient?.Kind ?? GradientKind.None)))
            {
                Change(present => kind == GradientKind.None ? null
                    : (present ?? Gradient.Of(kind, NamedPalettes.All[0])) with { Kind = kind });
            }
        }

        ui.Tooltip("what colours of a fractal's instances go by: maps, places, or the nearest approach of their path to the centre");
        if (gradient is null)
        {
            return;
        }

        ui.Row(1, 1, 1);
        if (ui.Selectable("two colours", gradient.Palette is null))
        {
            Set(static present => present with { Palette = null });
        }

        foreach (var palette in NamedPalettes.All)
        {
            if (ui.Selectable(palette.Name!, palette.Equals(gradient.Palette)))
            {
                Set(present => present with { Palette = palette });
            }
        }

        if (gradient.Palette is not null)
        {
            BuildSwatches(ui, gradient.Palette);
        }
        else if (ui.Colour(gradient.EndColour) is { } colour)
        {
            Set(present => present with { EndColour = PanelWidgets.Merge(present.EndColour, gradient.EndColour, colour) });
        }

        BuildRange(ui, "roughness", gradient.Roughness, 1, range => Set(present => present with { Roughness = range }));
        BuildRange(ui, "metal", gradient.Metalness, 1, range => Set(present => present with { Metalness = range }));
        BuildRange(ui, "glow", gradient.Glow, 4, range => Set(present => present with { Glow = range }));

        void Set(Func<Gradient, Gradient> change) => Change(present => present is null ? null : change(present));

        void Change(Func<Gradient?, Gradient?> change) =>
            actions.ChangeObject(index, present => present with { Gradient = change(present.Gradient) });
    }

    private static void BuildRange(UserInterface ui, string name, GradientRange? range, double maximum, Action<GradientRange?> change)
    {
        ui.Row(6, 5, 5);
        if (ui.CheckBox(name, range is not null))
        {
            change(range is null ? new(0, 1) : null);
        }

        if (range is var (first, last))
        {
            ui.Scope(name, () =>
            {
                if (ui.Slider("first", ref first, 0, maximum, 0.01) | ui.Slider("last", ref last, 0, maximum, 0.01))
                {
                    change(new(first, last));
                }
            });
        }
    }

    private static void BuildSwatches(UserInterface ui, Palette palette)
    {
        ui.Row(1, 1, 1, 1, 1, 1, 1, 1);
        for (var i = 0; i < 8; i++)
        {
            var (red, green, blue) = palette.ColourAt(i / 7.0);
            ui.Swatch(new Colour(red, green, blue).FromLinear());
        }
    }
}
