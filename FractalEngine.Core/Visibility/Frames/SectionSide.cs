namespace FractalEngine.Core.Visibility.Frames;

/// <summary>Where a box lies, as seen from a section plane.</summary>
internal enum SectionSide
{
    /// <summary>The whole box lies before the plane, where nothing is cut away.</summary>
    Kept,

    /// <summary>The plane goes through the box, or may do so.</summary>
    Cut,

    /// <summary>The whole box lies beyond the plane.</summary>
    CutAway,
}
