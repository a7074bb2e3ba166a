using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>A sub-fractal that others are made of, or its mirror image, as formats have it that know components of components.</summary>
/// <param name="MeshIndex">Index of the base mesh that it is; null for one that consists of others.</param>
/// <param name="IsMirrored">True for the image under <see cref="LevelGraph.Mirror"/>.</param>
/// <param name="Children">The nodes that it consists of, by their index, each with the map to its own frame: none of them mirrors.</param>
public readonly record struct LevelNode(int? MeshIndex, bool IsMirrored, ImmutableArray<(int Node, AffineMap Map)> Children);
