using System.Collections.Immutable;

namespace FractalEngine.Parsing.Ply;

/// <summary>A list of elements of one kind in a PLY file.</summary>
/// <param name="Name">Kind of the elements, as written.</param>
/// <param name="Count">Number of elements.</param>
/// <param name="Position">Offset in bytes of the name in the header, for messages.</param>
/// <param name="Properties">Properties of each element, in their order.</param>
internal sealed record PlyElement(string Name, int Count, int Position, ImmutableArray<PlyProperty> Properties);
