namespace FractalEngine.Render.Ui.Overlays;

/// <summary>A rectangle of the user interface, in framebuffer pixels from the upper left corner.</summary>
/// <param name="X">The left edge.</param>
/// <param name="Y">The top edge.</param>
/// <param name="Width">Width in pixels.</param>
/// <param name="Height">Height in pixels.</param>
public readonly record struct UiRect(int X, int Y, int Width, int Height)
{
    /// <summary>A rectangle around all frames.</summary>
    internal static UiRect Everything => new(-(1 << 29), -(1 << 29), 1 << 30, 1 << 30);

    /// <summary>The edge behind the last column.</summary>
    public int Right => X + Width;

    /// <summary>The edge below the last row.</summary>
    public int Bottom => Y + Height;

    /// <summary>Tells whether a point lies in the rectangle.</summary>
    public bool Contains(double x, double y) => x >= X && y >= Y && x < Right && y < Bottom;

    /// <summary>Returns the part that both rectangles have; its size is 0 where they lie apart.</summary>
    public UiRect Intersect(UiRect other)
    {
        var left = Math.Max(X, other.X);
        var top = Math.Max(Y, other.Y);
        return new(left, top, Math.Max(0, Math.Min(Right, other.Right) - left), Math.Max(0, Math.Min(Bottom, other.Bottom) - top));
    }

    /// <summary>Returns the rectangle without a margin on all sides.</summary>
    public UiRect Inset(int margin) =>
        new(X + margin, Y + margin, Math.Max(0, Width - (2 * margin)), Math.Max(0, Height - (2 * margin)));
}
