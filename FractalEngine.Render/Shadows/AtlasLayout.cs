namespace FractalEngine.Render.Shadows;

/// <summary>Places square maps, whose sides are powers of two, side by side in one texture.</summary>
internal static class AtlasLayout
{
    /// <summary>Places the maps of views, the largest first, in rows.</summary>
    /// <param name="views">Views with their sizes.</param>
    /// <param name="corners">Receives the lower left corner of each map.</param>
    /// <returns>Width and height of the texture.</returns>
    public static (int Width, int Height) Place(IReadOnlyList<ShadowView> views, List<(int X, int Y)> corners)
    {
        corners.Clear();
        var largest = 1;
        var texels = 0L;
        foreach (var view in views)
        {
            corners.Add(default);
            largest = Math.Max(largest, view.Size);
            texels += (long)view.Size * view.Size;
        }

        var width = largest;
        while ((long)width * width < texels)
        {
            width *= 2;
        }

        var (x, y, rowHeight) = (0, 0, 0);
        for (var size = largest; size > 0; size /= 2)
        {
            for (var i = 0; i < views.Count; i++)
            {
                if (views[i].Size != size)
                {
                    continue;
                }

                if (x + size > width)
                {
                    (x, y, rowHeight) = (0, y + rowHeight, 0);
                }

                corners[i] = (x, y);
                x += size;
                rowHeight = Math.Max(rowHeight, size);
            }
        }

        return (width, Math.Max(1, y + rowHeight));
    }
}
