namespace FractalEngine.Core.Visibility.Frames;

/// <summary>The part of a strip that a box covers at most, and the depth of the box.</summary>
internal readonly struct ScreenFootprint
{
    /// <summary>The footprint of a box that lies outside the strip's frustum.</summary>
    public static ScreenFootprint Outside => new() { IsOutside = true };

    /// <summary>Whether the box is too close for single precision; nothing else is known then.</summary>
    public bool NeedsDouble { get; init; }

    /// <summary>Whether the box lies outside the frustum of the strip.</summary>
    public bool IsOutside { get; init; }

    /// <summary>Whether the whole box lies beyond the near plane; only then are there a rectangle and an inverse depth.</summary>
    public bool IsBeyondNearPlane { get; init; }

    /// <summary>Whether the rectangle contains no sample of any pixel.</summary>
    public bool CoversNoSample { get; init; }

    /// <summary>Whether the box may be visible in other strips as well.</summary>
    public bool IsShared { get; init; }

    /// <summary>Whether the section plane may cut the box.</summary>
    public bool IsSectioned { get; init; }

    /// <summary>Larger side of the rectangle, pixels of the occlusion buffer.</summary>
    public double ProjectedSize { get; init; }

    /// <summary>Largest inverse depth of any point of the box.</summary>
    public float MaxInverseDepth { get; init; }

    /// <summary>First column of the rectangle in the occlusion buffer.</summary>
    public int Left { get; init; }

    /// <summary>Last column of the rectangle.</summary>
    public int Right { get; init; }

    /// <summary>First row of the rectangle.</summary>
    public int Top { get; init; }

    /// <summary>Last row of the rectangle.</summary>
    public int Bottom { get; init; }
}
