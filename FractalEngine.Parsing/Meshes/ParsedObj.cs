using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Contents of a parsed OBJ file, with warnings about what was ignored.</summary>
/// <param name="Mesh">Geometry, groups and names of material files.</param>
/// <param name="Warnings">At most one about unknown keywords, and one about normals or texture coordinates that don't exist.</param>
public sealed record ParsedObj(Mesh Mesh, ImmutableArray<Diagnostic> Warnings)
{
    /// <summary>Offsets of the names of the mesh's material files in the text, for messages.</summary>
    public ImmutableArray<int> MaterialLibraryOffsets { get; init; } = [];

    /// <summary>Offset of the first use of each material in the text, for messages.</summary>
    public ImmutableDictionary<string, int> MaterialOffsets { get; init; } = ImmutableDictionary<string, int>.Empty;
}
