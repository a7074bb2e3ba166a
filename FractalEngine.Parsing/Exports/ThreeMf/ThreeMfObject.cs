using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Exports.ThreeMf;

/// <summary>An object of a 3MF file: a mesh, or components of other objects.</summary>
/// <param name="Part">The part of the scene that has the mesh, and its colours; null for components.</param>
/// <param name="IsMirrored">Whether the mesh is written as its mirror image.</param>
/// <param name="Components">Other objects by their numbers, each with the map to this one.</param>
internal sealed record ThreeMfObject(
    ExportedPart? Part, bool IsMirrored, ImmutableArray<(int Object, AffineMap Map)> Components);
