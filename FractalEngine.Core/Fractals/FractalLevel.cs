using System.Collections.Immutable;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Fractals;

/// <summary>A level of a fractal: lower levels under maps, or a base mesh, see <see cref="FractalLevels"/>.</summary>
/// <param name="Mesh">Index of the base mesh that stands there; −1 for a level of children.</param>
/// <param name="Box">A box that holds all of the level, in its own frame; empty where there is nothing.</param>
/// <param name="Children">The maps to lower levels; empty for a base mesh.</param>
public sealed record FractalLevel(int Mesh, BoundingBox Box, ImmutableArray<LevelChild> Children)
{
    /// <summary>Decides which one of the children stands at a place; null where all do.</summary>
    public LevelChoice? Choice { get; init; }
}
