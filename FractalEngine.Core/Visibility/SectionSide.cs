namespace FractalEngine.Core.Visibility;

/// <summary>Where a box lies, as seen from a section plane.</summary>
internal enum SectionSide
{
    /// <summary>All of the box is kept.</summary>
    Kept,

    /// <summary>The plane goes through the box, or may do so.</summary>
    Cut,

    /// <summary>The whole box lies beyond the plane.</summary>
    CutAway,
}
