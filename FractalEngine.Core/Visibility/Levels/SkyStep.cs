namespace FractalEngine.Core.Visibility.Levels;

/// <summary>A step from a node to one of its children.</summary>
/// <param name="Node">The node.</param>
/// <param name="Levels">Number of levels that it has left.</param>
/// <param name="Child">Index of the child.</param>
internal readonly record struct SkyStep(LodNode Node, long Levels, int Child);
