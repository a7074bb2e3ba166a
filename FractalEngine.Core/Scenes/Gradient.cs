using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes;

/// <summary>How the instances of a fractal differ in colour: from the object's own colour to another one, or by a palette.</summary>
/// <param name="Kind">What the colour depends on.</param>
/// <param name="EndColour">The colour at the far end of the gradient.</param>
public sealed record Gradient(GradientKind Kind, Colour EndColour)
{
    /// <summary>All colours of the gradient; null where it leads from the object's own colour to the other one.</summary>
    public Palette? Palette { get; init; }

    /// <summary>Roughness of surfaces without a material, as that of one, from 0 to 1; null for matt ones.</summary>
    public GradientRange? Roughness { get; init; }

    /// <summary>Share of metal of surfaces without a material, from 0 to 1; null for none.</summary>
    public GradientRange? Metalness { get; init; }

    /// <summary>Light that surfaces without a material send out, as a multiple of their colour, not negative; null for none.</summary>
    public GradientRange? Glow { get; init; }

    /// <summary>True where surfaces without a material mirror.</summary>
    public bool IsGlossy => Roughness is not null || Metalness is not null;

    /// <summary>True where the gradient decides about more than the colour.</summary>
    public bool HasSurface => IsGlossy || Glow is not null;

    /// <summary>Makes a gradient of a palette, which the object's own colour is no part of.</summary>
    /// <param name="kind">What the colour depends on.</param>
    /// <param name="palette">The colours.</param>
    public static Gradient Of(GradientKind kind, Palette palette)
    {
        ArgumentNullException.ThrowIfNull(palette);
        return new(kind, palette.Stops[^1].Colour) { Palette = palette };
    }

    /// <summary>True where the paths of maps decide alone, and colours of proxies are those at their own place in the gradient.</summary>
    public bool IsPlain => Palette is null && Kind < GradientKind.Height && !HasSurface;
}
