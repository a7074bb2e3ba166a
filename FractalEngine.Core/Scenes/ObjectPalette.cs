using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes;

/// <summary>Default colours of objects, of similar lightness and different hue.</summary>
public static class ObjectPalette
{
    /// <summary>The colour of an object where its material says none.</summary>
    /// <param name="placed">The object.</param>
    /// <param name="index">Index of the object in the scene, from 0, and that of the mesh added.</param>
    public static Colour ColourOf(PlacedModel placed, int index)
    {
        ArgumentNullException.ThrowIfNull(placed);
        // Colours of vertices are shown as they are, unless the scene gives the object one.
        return placed.Declaration.Colour ?? (placed.Model.Mesh.Colours.IsEmpty ? ColourOf(index) : Colour.White);
    }

    /// <summary>Returns the default colour of an object.</summary>
    /// <param name="index">Index of the object in the scene, from 0. The colours repeat after eight.</param>
    public static Colour ColourOf(int index) => (index & 7) switch
    {
        0 => new(0.91, 0.79, 0.60), // sand
        1 => new(0.42, 0.66, 0.76), // lake
        2 => new(0.86, 0.51, 0.43), // coral
        3 => new(0.58, 0.74, 0.49), // moss
        4 => new(0.68, 0.58, 0.80), // lilac
        5 => new(0.93, 0.70, 0.36), // amber
        6 => new(0.47, 0.75, 0.69), // sea
        _ => new(0.82, 0.62, 0.69), // rose
    };
}
