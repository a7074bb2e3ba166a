using System.Collections.Immutable;

namespace FractalEngine.Parsing.Ply;

/// <summary>What the header of a PLY file declares.</summary>
/// <param name="Format">How numbers are written.</param>
/// <param name="Elements">Lists of elements, in the order in which they follow the header.</param>
/// <param name="Length">Length of the header in bytes.</param>
internal sealed record PlyHeader(PlyFormat Format, ImmutableArray<PlyElement> Elements, int Length);
