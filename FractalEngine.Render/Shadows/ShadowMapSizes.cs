using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Shadows;

/// <summary>Divides texels among the depth maps of a frame, and moves views to whole texels.</summary>
/// <remarks>
/// Maps of parallel light move by whole texels and change their size in steps, so that edges of shadows stay where they are while a view
/// turns.
/// </remarks>
internal static class ShadowMapSizes
{
    // Side of the smallest and of the largest map, texels.
    private const int MinSize = 512;
    private const int MaxSize = 4096;

    // The side of the largest map, relative to the longer side of the frame.
    private const double TexelsPerPixel = 3;

    // All maps together, texels.
    private const long MaxTexels = 2L * MaxSize * MaxSize;

    // The size of a map of parallel light grows in steps of this factor.
    private const double SizeStep = 1.0905;

    /// <summary>Gives the brightest lights the largest maps, within the limit of all texels.</summary>
    /// <param name="views">Views of all maps, which get their sizes.</param>
    /// <param name="weights">For each view, how much its light matters.</param>
    /// <param name="frameWidth">Width of the frame in pixels.</param>
    /// <param name="frameHeight">Height of the frame in pixels.</param>
    public static void Assign(List<ShadowView> views, List<double> weights, int frameWidth, int frameHeight)
    {
        var largest = MinSize;
        while (largest < MaxSize && largest < TexelsPerPixel * Math.Max(frameWidth, frameHeight))
        {
            largest *= 2;
        }

        var brightest = 0.0;
        foreach (var weight in weights)
        {
            brightest = Math.Max(brightest, weight);
        }

        for (var isWithinLimit = false; !isWithinLimit; largest /= 2)
        {
            var texels = 0L;
            for (var i = 0; i < views.Count; i++)
            {
                var size = Math.Max(MinSize / 2, weights[i] > 0.5 * brightest ? largest : largest / 2);
                views[i] = views[i] with { Size = size };
                texels += views[i].IsIdle ? 0 : (long)size * size;
            }

            isWithinLimit = texels <= MaxTexels || largest <= MinSize;
        }
    }

    /// <summary>Snaps the views of parallel light.</summary>
    public static void Snap(List<ShadowView> views)
    {
        for (var i = 0; i < views.Count; i++)
        {
            views[i] = views[i].IsPerspective ? views[i] : Snap(views[i]);
        }
    }

    /// <summary>Rounds the size of a view up to a step, and moves it to a whole number of texels.</summary>
    private static ShadowView Snap(ShadowView view)
    {
        var halfWidth = RoundUpToStep(view.HalfWidth * (1 + (4.0 / view.Size)));
        var halfHeight = RoundUpToStep(view.HalfHeight * (1 + (4.0 / view.Size)));
        var (texelWidth, texelHeight) = (2 * halfWidth / view.Size, 2 * halfHeight / view.Size);
        var (x, y, z) = view.Axes.Transpose() * view.Position;
        var snapped = new Vector(texelWidth * Math.Round(x / texelWidth), texelHeight * Math.Round(y / texelHeight), z);
        return view with { Position = view.Axes * snapped, HalfWidth = halfWidth, HalfHeight = halfHeight };
    }

    private static double RoundUpToStep(double size) => Math.Pow(SizeStep, Math.Ceiling(Math.Log(size, SizeStep)));
}
